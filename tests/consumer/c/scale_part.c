/* Grows a part by a thousandth with a field of its own making: scale_part PART.brep FIELD.frd
 *
 * Takes the feet of a first morph as points on the part, gives them a displacement in arrays, and
 * prints the report of the second morph, whose volume must grow as 1.001 to the third.
 */
#include "common.h"

static const double GROWTH = 1e-3;

/* Feet of the nodes, each once, with numbers and displacements; returns how many. */
static size_t fill(const bladesmith_morphed *morphed, int64_t **ids, double **xyz, double **u)
{
    size_t count = 0, kept = 0;
    CHECK(bladesmith_morphed_nodes(morphed, 0, NULL, NULL, NULL, NULL, NULL, &count));
    *ids = malloc(count * sizeof **ids);
    *xyz = malloc(3 * count * sizeof **xyz);
    *u = malloc(3 * count * sizeof **u);
    CHECK(bladesmith_morphed_nodes(morphed, count, *ids, NULL, *xyz, NULL, NULL, &count));
    for (size_t i = 0; i < count; i++) {
        size_t same = 0;
        while (same < kept && (*ids)[same] != (*ids)[i])
            same++;
        if (same < kept)
            continue;
        (*ids)[kept] = (*ids)[i];
        for (size_t k = 0; k < 3; k++) {
            (*xyz)[3 * kept + k] = (*xyz)[3 * i + k];
            (*u)[3 * kept + k] = GROWTH * (*xyz)[3 * i + k];
        }
        kept++;
    }
    return kept;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: scale_part PART.brep FIELD.frd\n");
        return EXIT_FAILURE;
    }
    bladesmith_field *field = NULL, *growth = NULL;
    bladesmith_morphed *morphed = NULL, *grown = NULL;
    int64_t *ids = NULL;
    double *xyz = NULL, *u = NULL;
    bladesmith_part *part = read_part(argv[1]);
    CHECK(bladesmith_field_read(argv[2], NULL, 0, &field));
    CHECK(bladesmith_morph(part, field, NULL, NULL, NULL, &morphed));
    size_t nodes = fill(morphed, &ids, &xyz, &u);
    CHECK(bladesmith_field_from_arrays("growth", ids, xyz, u, nodes, &growth));
    free(ids);
    free(xyz);
    free(u);
    CHECK(bladesmith_morph(part, growth, NULL, NULL, NULL, &grown));
    char *report = read_report(grown);
    puts(report);
    free(report);
    bladesmith_morphed_free(grown);
    bladesmith_morphed_free(morphed);
    bladesmith_field_free(growth);
    bladesmith_field_free(field);
    bladesmith_part_free(part);
    return EXIT_SUCCESS;
}
