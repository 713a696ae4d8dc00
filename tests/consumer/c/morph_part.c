/* Morphs a part: morph_part PART.brep FIELD.frd OUT.brep REPORT.json
 *
 * Takes the field away (factor -1), writes the new part and the report, then cancels a second run.
 */
#include "common.h"

struct follow {
    unsigned calls;
    unsigned cancel_at; /* 0: never */
    double fraction;
    int went_back;
};

static int32_t follow(void *user, const char *stage, double fraction)
{
    struct follow *seen = user;
    seen->calls++;
    seen->went_back |= !(fraction >= seen->fraction && fraction <= 1.0) || stage[0] == '\0';
    seen->fraction = fraction;
    return seen->calls == seen->cancel_at;
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    if (!file || fputs(text, file) == EOF || fclose(file) != 0) {
        fprintf(stderr, "%s cannot be written\n", path);
        exit(EXIT_FAILURE);
    }
}

static void write_part(const bladesmith_part *part, const char *path)
{
    size_t length = 0;
    CHECK(bladesmith_part_write(part, NULL, 0, &length));
    char *text = malloc(length + 1);
    CHECK(bladesmith_part_write(part, text, length + 1, &length));
    write_file(path, text);
    free(text);
}

static void print_nodes(const bladesmith_morphed *morphed)
{
    size_t count = 0;
    CHECK(bladesmith_morphed_nodes(morphed, 0, NULL, NULL, NULL, NULL, NULL, &count));
    int64_t *ids = malloc(count * sizeof *ids);
    double *feet = malloc(3 * count * sizeof *feet), *deviations = malloc(3 * count * sizeof *deviations);
    CHECK(bladesmith_morphed_nodes(morphed, count, ids, NULL, feet, NULL, deviations, &count));
    double worst = -1.0;
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        const double *d = deviations + 3 * i;
        double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (square > worst) {
            worst = square;
            at = i;
        }
    }
    if (count > 0)
        printf("%zu nodes on faces; worst is node %lld at (%g, %g, %g) mm\n", count, (long long)ids[at],
               feet[3 * at], feet[3 * at + 1], feet[3 * at + 2]);
    free(ids);
    free(feet);
    free(deviations);
}

/* A run that is cancelled gives no result; returns whether that is so. */
static int cancels(const bladesmith_part *part, const bladesmith_field *field,
                   const bladesmith_morph_options *options)
{
    struct follow seen = {0, 2, 0.0, 0};
    bladesmith_morphed *none = NULL;
    int32_t status = bladesmith_morph(part, field, options, follow, &seen, &none);
    printf("cancelled at call %u: status %d, %s\n", seen.calls, (int)status, bladesmith_last_error());
    return status == BLADESMITH_STATUS_CANCELLED && !none && seen.calls == seen.cancel_at;
}

int main(int argc, char **argv)
{
    if (argc != 5 || bladesmith_abi_version() != BLADESMITH_ABI_VERSION) {
        fprintf(stderr, "usage: morph_part PART.brep FIELD.frd OUT.brep REPORT.json, with library %s\n",
                bladesmith_version());
        return EXIT_FAILURE;
    }
    bladesmith_field *field = NULL;
    bladesmith_morphed *morphed = NULL;
    bladesmith_part *part = read_part(argv[1]), *cold = NULL;
    CHECK(bladesmith_field_read(argv[2], NULL, 0, &field));

    bladesmith_morph_options options;
    bladesmith_morph_options_init(&options, sizeof options);
    options.factor = -1.0;
    options.solid_name = argv[1];
    struct follow seen = {0, 0, 0.0, 0};
    CHECK(bladesmith_morph(part, field, &options, follow, &seen, &morphed));
    int cancelled = cancels(part, field, &options);
    bladesmith_part_free(part);
    bladesmith_field_free(field);

    CHECK(bladesmith_morphed_part(morphed, &cold));
    char *report = read_report(morphed);
    write_file(argv[4], report);
    write_part(cold, argv[3]);
    print_nodes(morphed);
    printf("%u calls of progress up to %g\n", seen.calls, seen.fraction);
    free(report);
    bladesmith_part_free(cold);
    bladesmith_morphed_free(morphed);
    if (!cancelled || seen.went_back || seen.calls < 2) {
        fprintf(stderr, "progress or cancellation went wrong\n");
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
