/* Calls every entry with NULL, bad arguments and small buffers: abi_errors PART.brep FIELD.frd
 *
 * Each must return the documented status with a message that names the argument, and must leave
 * its outputs alone.
 */
#include "expect.h"
#include <math.h>

enum { IO = BLADESMITH_STATUS_IO, BREP = BLADESMITH_STATUS_BREP, FIELD = BLADESMITH_STATUS_FIELD };

typedef int32_t (*text_getter)(const void *handle, char *buffer, size_t capacity, size_t *length);

static int32_t field_info(const void *handle, char *buffer, size_t capacity, size_t *length)
{
    return bladesmith_field_info(handle, buffer, capacity, length);
}

static int32_t part_info(const void *handle, char *buffer, size_t capacity, size_t *length)
{
    return bladesmith_part_info(handle, buffer, capacity, length);
}

static int32_t morphed_report(const void *handle, char *buffer, size_t capacity, size_t *length)
{
    return bladesmith_morphed_report(handle, buffer, capacity, length);
}

static int32_t part_write(const void *handle, char *buffer, size_t capacity, size_t *length)
{
    return bladesmith_part_write(handle, buffer, capacity, length);
}

/* What holds for every function that gives a text. */
static void check_text(text_getter get, const void *handle, const char *name)
{
    size_t length = 0, again = 0;
    EXPECT(get(NULL, NULL, 0, &length), ARGUMENT, name);
    EXPECT(get(handle, NULL, 0, NULL), ARGUMENT, "'length': is NULL");
    EXPECT(get(handle, NULL, 5, &length), ARGUMENT, "'buffer': is NULL");
    EXPECT(get(handle, NULL, 0, &length), OK, "");
    EXPECT_TRUE(length > 1);
    char *buffer = malloc(length + 1);
    memset(buffer, '#', length + 1);
    EXPECT(get(handle, buffer, length, &again), SMALL, "enlarge");
    EXPECT_TRUE(again == length && buffer[0] == '#' && buffer[length - 1] == '#');
    EXPECT(get(handle, buffer, length + 1, &again), OK, "");
    EXPECT_TRUE(again == length && strlen(buffer) == length);
    free(buffer);
}

static void check_library(void)
{
    EXPECT_TRUE(bladesmith_abi_version() == BLADESMITH_ABI_VERSION);
    EXPECT_TRUE(strchr(bladesmith_version(), '.') != NULL);
    EXPECT_TRUE(bladesmith_last_error()[0] == '\0');
}

static void check_field_read(const char *path, const char *part_path)
{
    bladesmith_field *field = NULL;
    EXPECT(bladesmith_field_read(NULL, NULL, 0, &field), ARGUMENT, "'path': is NULL");
    EXPECT(bladesmith_field_read("", NULL, 0, &field), ARGUMENT, "'path': is empty");
    EXPECT(bladesmith_field_read(path, NULL, 0, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_field_read("no/such.frd", NULL, 0, &field), IO, "no/such.frd");
    EXPECT(bladesmith_field_read(path, "no/such.inp", 0, &field), IO, "no/such.inp");
    EXPECT(bladesmith_field_read(part_path, NULL, 0, &field), FIELD, part_path);
    EXPECT(bladesmith_field_read(path, NULL, 7, &field), FIELD, "7");
    EXPECT_TRUE(field == NULL);
    bladesmith_field_free(NULL);
}

static void check_field_arrays(void)
{
    int64_t ids[3] = {30, 10, 20}, twice[3] = {30, 10, 30};
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, u[9] = {0}, bad[9] = {0, 0, 0, 0, NAN, 0, 0, 0, 0};
    const double *odd = (const double *)(const void *)((const char *)xyz + 1);
    bladesmith_field *field = NULL;
    EXPECT(bladesmith_field_from_arrays("a", NULL, xyz, u, 3, &field), ARGUMENT, "'ids': is NULL");
    EXPECT(bladesmith_field_from_arrays("a", ids, NULL, u, 3, &field), ARGUMENT, "'xyz': is NULL");
    EXPECT(bladesmith_field_from_arrays("a", ids, xyz, NULL, 3, &field), ARGUMENT, "'u': is NULL");
    EXPECT(bladesmith_field_from_arrays("a", ids, xyz, u, 3, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_field_from_arrays("\xff", ids, xyz, u, 3, &field), ARGUMENT, "UTF-8");
    EXPECT(bladesmith_field_from_arrays("a", ids, odd, u, 1, &field), ARGUMENT, "aligned");
    EXPECT(bladesmith_field_from_arrays("a", ids, xyz, u, SIZE_MAX / 2, &field), ARGUMENT, "address space");
    EXPECT(bladesmith_field_from_arrays("a", ids, xyz, u, SIZE_MAX / 16, &field), ARGUMENT, "address space");
    EXPECT(bladesmith_field_from_arrays("a", NULL, NULL, NULL, 0, &field), FIELD, "a: no nodes");
    EXPECT(bladesmith_field_from_arrays("a", ids, bad, u, 3, &field), ARGUMENT, "'xyz': value 2 of point 2");
    EXPECT(bladesmith_field_from_arrays("a", ids, xyz, bad, 3, &field), ARGUMENT, "'u': value 2 of point 2");
    EXPECT(bladesmith_field_from_arrays("a", twice, xyz, u, 3, &field), FIELD, "30");
    EXPECT_TRUE(field == NULL);
    EXPECT(bladesmith_field_from_arrays(NULL, ids, xyz, u, 3, &field), OK, "");
    check_text(field_info, field, "'field': is NULL");
    bladesmith_field_free(field);
}

static void check_part(const bladesmith_part *part)
{
    bladesmith_part *none = NULL;
    EXPECT(bladesmith_part_read(NULL, 3, "p", &none), ARGUMENT, "'text': is NULL");
    EXPECT(bladesmith_part_read("abc", 3, "p", NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_part_read("abc", 3, "\xff", &none), ARGUMENT, "'name': is not UTF-8");
    EXPECT(bladesmith_part_read("abc", SIZE_MAX, "p", &none), ARGUMENT, "address space");
    EXPECT(bladesmith_part_read(NULL, 0, "p", &none), BREP, "p, line 1");
    EXPECT(bladesmith_part_read("solid x", 7, "p", &none), BREP, "p, line 1");
    EXPECT(bladesmith_part_read("\n\n\xff", 3, NULL, &none), BREP, "B-rep, line 3");
    EXPECT_TRUE(none == NULL);
    bladesmith_part_free(NULL);
    check_text(part_info, part, "'part': is NULL");
    check_text(part_write, part, "'part': is NULL");
}

static void check_evaluate(const bladesmith_part *part)
{
    double uv[4] = {0.5, 0.5, 0.25, 0.5}, bad[4] = {0.5, 0.5, 0.5, INFINITY};
    double out[37];
    out[0] = out[36] = 7.0;
    EXPECT(bladesmith_part_evaluate(NULL, 1, uv, 2, 2, out), ARGUMENT, "'part': is NULL");
    EXPECT(bladesmith_part_evaluate(part, 0, uv, 2, 2, out), ARGUMENT, "'face': is 0");
    EXPECT(bladesmith_part_evaluate(part, 1000, uv, 2, 2, out), ARGUMENT, "'face': is 1000");
    EXPECT(bladesmith_part_evaluate(part, 1, NULL, 2, 2, out), ARGUMENT, "'uv': is NULL");
    EXPECT(bladesmith_part_evaluate(part, 1, uv, 2, 3, out), ARGUMENT, "'order': is 3");
    EXPECT(bladesmith_part_evaluate(part, 1, uv, 2, 2, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_part_evaluate(part, 1, bad, 2, 2, out), ARGUMENT, "value 2 of point 2");
    EXPECT(bladesmith_part_evaluate(part, 1, uv, SIZE_MAX / 4, 2, out), ARGUMENT, "address space");
    EXPECT_TRUE(out[0] == 7.0);
    EXPECT(bladesmith_part_evaluate(part, 1, NULL, 0, 2, NULL), OK, "");
    EXPECT(bladesmith_part_evaluate(part, 1, uv, 2, 2, out), OK, "");
    EXPECT_TRUE(out[36] == 7.0);
    double points[6];
    EXPECT(bladesmith_part_evaluate(part, 1, uv, 2, 0, points), OK, "");
    EXPECT_TRUE(memcmp(points, out, 3 * sizeof(double)) == 0);
    EXPECT_TRUE(memcmp(points + 3, out + 18, 3 * sizeof(double)) == 0);
}

static void check_morph(const bladesmith_part *part, const bladesmith_field *field)
{
    bladesmith_morphed *none = NULL;
    uint32_t faces[2] = {1, 0};
    bladesmith_morph_options options, filled;
    bladesmith_morph_options_init(NULL, sizeof options);
    bladesmith_morph_options_init(&options, 8);
    EXPECT(bladesmith_morph(part, field, &options, NULL, NULL, &none), ARGUMENT, "'options': its size is");
    bladesmith_morph_options_init(&filled, sizeof filled);
    EXPECT(bladesmith_morph(NULL, field, &filled, NULL, NULL, &none), ARGUMENT, "'part': is NULL");
    EXPECT(bladesmith_morph(part, NULL, &filled, NULL, NULL, &none), ARGUMENT, "'field': is NULL");
    EXPECT(bladesmith_morph(part, field, &filled, NULL, NULL, NULL), ARGUMENT, "'out': is NULL");
    options = filled;
    options.size = sizeof options + 4096;
    EXPECT(bladesmith_morph(part, field, &options, NULL, NULL, &none), ARGUMENT, "'options': its size is");
    options = filled;
    options.factor = NAN;
    EXPECT(bladesmith_morph(part, field, &options, NULL, NULL, &none), ARGUMENT, "'factor'");
    options = filled;
    options.moving_faces = faces;
    options.moving_count = 2;
    EXPECT(bladesmith_morph(part, field, &options, NULL, NULL, &none), ARGUMENT, "'moving_faces': entry 2");
    options = filled;
    options.fixed_count = 1;
    EXPECT(bladesmith_morph(part, field, &options, NULL, NULL, &none), ARGUMENT, "'fixed_faces': is NULL");
    EXPECT_TRUE(none == NULL);
}

static void check_check(const bladesmith_part *part, const bladesmith_field *field)
{
    size_t length = 0, again = 0;
    char tiny[8] = "#######";
    EXPECT(bladesmith_check(NULL, field, NULL, NULL, NULL, NULL, 0, &length), ARGUMENT, "'part': is NULL");
    EXPECT(bladesmith_check(part, NULL, NULL, NULL, NULL, NULL, 0, &length), ARGUMENT, "'field': is NULL");
    EXPECT(bladesmith_check(part, field, NULL, NULL, NULL, NULL, 0, NULL), ARGUMENT, "'length': is NULL");
    EXPECT(bladesmith_check(part, field, NULL, NULL, NULL, NULL, 8, &length), ARGUMENT, "'buffer': is NULL");
    EXPECT(bladesmith_check(part, field, NULL, NULL, NULL, tiny, sizeof tiny, &length), SMALL, "enlarge");
    EXPECT_TRUE(length > sizeof tiny && strcmp(tiny, "#######") == 0);
    char *json = malloc(length + 1);
    EXPECT(bladesmith_check(part, field, NULL, NULL, NULL, json, length + 1, &again), OK, "");
    EXPECT_TRUE(again == length && strlen(json) == length && strstr(json, "\"nodes_on_faces\""));
    free(json);
}

static void check_nodes(const bladesmith_morphed *morphed)
{
    size_t count = 0, again = 0;
    EXPECT(bladesmith_morphed_nodes(morphed, 0, NULL, NULL, NULL, NULL, NULL, NULL), ARGUMENT, "'count': is NULL");
    EXPECT(bladesmith_morphed_nodes(morphed, 0, NULL, NULL, NULL, NULL, NULL, &count), OK, "");
    EXPECT_TRUE(count > 1);
    int64_t *ids = malloc(count * sizeof *ids);
    double *feet = malloc(3 * count * sizeof *feet);
    double *odd = (double *)(void *)((char *)feet + 1);
    ids[0] = ids[count - 2] = -7;
    EXPECT(bladesmith_morphed_nodes(morphed, 1, ids, NULL, NULL, NULL, NULL, &again), SMALL, "enlarge");
    EXPECT_TRUE(again == count && ids[0] == -7);
    EXPECT(bladesmith_morphed_nodes(morphed, count - 1, ids, NULL, feet, NULL, NULL, &again), SMALL, "enlarge");
    EXPECT_TRUE(again == count && ids[0] == -7 && ids[count - 2] == -7);
    EXPECT(bladesmith_morphed_nodes(morphed, count, ids, NULL, odd, NULL, NULL, &again), ARGUMENT, "'feet': is not aligned");
    EXPECT(bladesmith_morphed_nodes(morphed, SIZE_MAX / 2, ids, NULL, feet, NULL, NULL, &again), ARGUMENT, "address space");
    EXPECT_TRUE(ids[0] == -7);
    EXPECT(bladesmith_morphed_nodes(morphed, count, ids, NULL, feet, NULL, NULL, &again), OK, "");
    EXPECT_TRUE(again == count && ids[0] != -7);
    free(ids);
    free(feet);
}

static void check_morphed(const bladesmith_part *part, const bladesmith_field *field)
{
    bladesmith_part *none = NULL;
    bladesmith_morphed *morphed = NULL;
    size_t count = 7;
    EXPECT(bladesmith_morphed_part(NULL, &none), ARGUMENT, "'morphed': is NULL");
    EXPECT(bladesmith_morphed_nodes(NULL, 0, NULL, NULL, NULL, NULL, NULL, &count), ARGUMENT, "'morphed'");
    EXPECT_TRUE(none == NULL && count == 7);
    bladesmith_morphed_free(NULL);
    EXPECT_TRUE(strstr(bladesmith_last_error(), "'morphed'") != NULL);
    EXPECT(bladesmith_morph(part, field, NULL, NULL, NULL, &morphed), OK, "");
    EXPECT(bladesmith_morphed_part(morphed, NULL), ARGUMENT, "'out': is NULL");
    check_text(morphed_report, morphed, "'morphed': is NULL");
    check_nodes(morphed);
    bladesmith_morphed_free(morphed);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: abi_errors PART.brep FIELD.frd\n");
        return EXIT_FAILURE;
    }
    check_library();
    check_field_read(argv[2], argv[1]);
    check_field_arrays();
    bladesmith_part *part = read_part(argv[1]);
    bladesmith_field *field = NULL;
    CHECK(bladesmith_field_read(argv[2], NULL, 0, &field));
    check_part(part);
    check_evaluate(part);
    check_text(field_info, field, "'field': is NULL");
    check_morph(part, field);
    check_check(part, field);
    check_morphed(part, field);
    bladesmith_part_free(part);
    bladesmith_field_free(field);
    return ended();
}
