/* What the programs of this folder share: reading files, and ending on a failed call. */
#ifndef BLADESMITH_CONSUMER_COMMON_H
#define BLADESMITH_CONSUMER_COMMON_H

#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program with the library's message if a call failed. */
#define CHECK(call) check((call), #call, __LINE__)

static inline void check(int32_t status, const char *call, int line)
{
    if (status == BLADESMITH_STATUS_OK)
        return;
    fprintf(stderr, "line %d: %s\nstatus %d: %s\n", line, call, (int)status, bladesmith_last_error());
    exit(EXIT_FAILURE);
}

/* Whole file in memory that the caller frees; ends the program if it cannot be read. */
static inline char *read_file(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    long size = -1;
    if (file && fseek(file, 0, SEEK_END) == 0)
        size = ftell(file);
    if (size >= 0 && fseek(file, 0, SEEK_SET) == 0)
        text = malloc((size_t)size + 1);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(EXIT_FAILURE);
    }
    fclose(file);
    *length = (size_t)size;
    return text;
}

static inline bladesmith_part *read_part(const char *path)
{
    bladesmith_part *part = NULL;
    size_t length = 0;
    char *text = read_file(path, &length);
    CHECK(bladesmith_part_read(text, length, path, &part));
    free(text);
    return part;
}

/* Text of the report in memory that the caller frees. */
static inline char *read_report(const bladesmith_morphed *morphed)
{
    size_t length = 0;
    CHECK(bladesmith_morphed_report(morphed, NULL, 0, &length));
    char *json = malloc(length + 1);
    CHECK(bladesmith_morphed_report(morphed, json, length + 1, &length));
    return json;
}

#endif
