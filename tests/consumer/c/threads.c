/* Several threads use the same handles at once: threads PART.brep FIELD.frd
 *
 * Each evaluates, describes, writes and morphs the one part by the one field, sees its own error
 * text, and must get what a single thread gets. One of them cancels.
 */
#include "common.h"
#include <pthread.h>

enum { THREADS = 4, ROUNDS = 3, POINTS = 50 };

struct shared {
    const bladesmith_part *part;
    const bladesmith_field *field;
    double uv[2 * POINTS], points[3 * POINTS];
    char *cold; /* text of the morphed part */
};

struct job {
    const struct shared *shared;
    int number;
    int wrong;
};

static int32_t stop(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    return fraction > 0.3;
}

static char *cold_text(const bladesmith_part *part, const bladesmith_field *field)
{
    bladesmith_morphed *morphed = NULL;
    bladesmith_part *cold = NULL;
    size_t length = 0;
    CHECK(bladesmith_morph(part, field, NULL, NULL, NULL, &morphed));
    CHECK(bladesmith_morphed_part(morphed, &cold));
    bladesmith_morphed_free(morphed);
    CHECK(bladesmith_part_write(cold, NULL, 0, &length));
    char *text = malloc(length + 1);
    CHECK(bladesmith_part_write(cold, text, length + 1, &length));
    bladesmith_part_free(cold);
    return text;
}

/* Things every thread finds right, whatever the others do. */
static int small_calls(const struct shared *shared, int number)
{
    double points[3 * POINTS];
    size_t length = 0, again = 0;
    char message[64];
    CHECK(bladesmith_part_evaluate(shared->part, 1, shared->uv, POINTS, 0, points));
    CHECK(bladesmith_part_info(shared->part, NULL, 0, &length));
    CHECK(bladesmith_field_info(shared->field, NULL, 0, &again));
    snprintf(message, sizeof message, "is %d", 1000 + number);
    int32_t status = bladesmith_part_evaluate(shared->part, 1000 + number, shared->uv, 1, 0, points);
    return length > 0 && again > 0 && status == BLADESMITH_STATUS_ARGUMENT &&
           strstr(bladesmith_last_error(), message) && memcmp(points, shared->points, sizeof points) == 0;
}

static void *work(void *argument)
{
    struct job *job = argument;
    const struct shared *shared = job->shared;
    for (int round = 0; round < ROUNDS; round++)
        job->wrong += !small_calls(shared, job->number);
    if (job->number == 0) {
        bladesmith_morphed *none = NULL;
        int32_t status = bladesmith_morph(shared->part, shared->field, NULL, stop, NULL, &none);
        job->wrong += status != BLADESMITH_STATUS_CANCELLED || none != NULL;
        return NULL;
    }
    char *cold = cold_text(shared->part, shared->field);
    job->wrong += strcmp(cold, shared->cold) != 0;
    free(cold);
    return NULL;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: threads PART.brep FIELD.frd\n");
        return EXIT_FAILURE;
    }
    bladesmith_part *part = read_part(argv[1]);
    bladesmith_field *field = NULL;
    CHECK(bladesmith_field_read(argv[2], NULL, 0, &field));
    struct shared shared = {part, field, {0}, {0}, cold_text(part, field)};
    for (int i = 0; i < 2 * POINTS; i++)
        shared.uv[i] = 0.01 * i;
    CHECK(bladesmith_part_evaluate(part, 1, shared.uv, POINTS, 0, shared.points));
    pthread_t threads[THREADS];
    struct job jobs[THREADS];
    int wrong = 0;
    for (int i = 0; i < THREADS; i++) {
        jobs[i] = (struct job){&shared, i, 0};
        wrong += pthread_create(&threads[i], NULL, work, &jobs[i]) != 0;
    }
    for (int i = 0; i < THREADS; i++) {
        wrong += pthread_join(threads[i], NULL) != 0 || jobs[i].wrong != 0;
        if (jobs[i].wrong)
            fprintf(stderr, "thread %d found %d thing(s) wrong\n", i, jobs[i].wrong);
    }
    free(shared.cold);
    bladesmith_part_free(part);
    bladesmith_field_free(field);
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
