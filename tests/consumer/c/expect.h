/* Expectations of the programs that check what calls return. */
#ifndef BLADESMITH_CONSUMER_EXPECT_H
#define BLADESMITH_CONSUMER_EXPECT_H

#include "common.h"

static int failures = 0;

/* Status of a call, and what its message must contain. */
#define EXPECT(call, status, part) expect((call), (status), (part), #call, __LINE__)

static void expect(int32_t status, int32_t wanted, const char *part, const char *call, int line)
{
    const char *message = bladesmith_last_error();
    int quiet = wanted == BLADESMITH_STATUS_OK && message[0] == '\0';
    if (status == wanted && (quiet || (wanted != BLADESMITH_STATUS_OK && strstr(message, part))))
        return;
    fprintf(stderr, "line %d: %s\n  status %d, expected %d; message '%s' without '%s'\n", line, call,
            (int)status, (int)wanted, message, part);
    failures++;
}

static void expect_true(int holds, const char *what, int line)
{
    if (holds)
        return;
    fprintf(stderr, "line %d: %s does not hold\n", line, what);
    failures++;
}
#define EXPECT_TRUE(what) expect_true((what), #what, __LINE__)

enum { OK = BLADESMITH_STATUS_OK, ARGUMENT = BLADESMITH_STATUS_ARGUMENT };
enum { SMALL = BLADESMITH_STATUS_BUFFER_TOO_SMALL };

/* What main returns. */
static int ended(void)
{
    if (failures > 0)
        fprintf(stderr, "%d expectation(s) failed\n", failures);
    return failures > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

#endif
