/* A rounded corner, and the trimmed offset of the path that it makes.
 *
 *     offsets
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

/* Says which call failed and why; what is still owned goes with the program. */
static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", what, (int)status, bladesmith_last_error());
        exit(EXIT_FAILURE);
    }
}

static bladesmith_curve *line(double x0, double y0, double x1, double y1)
{
    const double knots[4] = {0, 0, 1, 1}, poles[4] = {x0, y0, x1, y1};
    bladesmith_curve *curve = NULL;
    need(bladesmith_curve_new(2, 1, knots, 4, poles, NULL, 2, &curve), "a line");
    return curve;
}

/* What is left of the first curve, the arc, and what is left of the second, as one. */
static bladesmith_curve *joined(bladesmith_curves *pieces)
{
    bladesmith_curve *path = NULL;
    for (size_t i = 0; i < 3; i++) {
        bladesmith_curve *next = NULL, *longer = NULL;
        need(bladesmith_curves_get(pieces, i, &next), "a piece");
        if (path) {
            need(bladesmith_curve_join(path, next, 1e-9, 1, &longer), "joining");
            bladesmith_curve_free(path);
            bladesmith_curve_free(next);
        }
        path = longer ? longer : next;
    }
    return path;
}

static double length_of(const bladesmith_curve *curve)
{
    const double far = 1e9; /* parameters beyond the domain are taken to its end */
    double length = 0.0;
    need(bladesmith_curve_lengths(curve, 1e-9, &far, 1, &length), "a length");
    return length;
}

int main(void)
{
    bladesmith_curve *first = line(0, 0, 30, 0), *second = line(30, 0, 30, 20);
    bladesmith_curves *pieces = NULL, *offsets = NULL;
    bladesmith_table *fillets = NULL, *sources = NULL;
    double fillet[10];
    size_t found = 0, columns = 0;

    need(bladesmith_curve_fillet(first, second, 4.0, 1e-9, NULL, &pieces, &fillets), "the fillet");
    need(bladesmith_table_size(fillets, &found, &columns), "how many there are");
    if (found == 0) {
        puts("no circle of this radius fits");
        return EXIT_FAILURE;
    }
    need(bladesmith_table_data(fillets, 1, fillet), "the fillet's numbers");
    printf("centre (%.6f, %.6f), angle %.6f rad\n", fillet[0], fillet[1], fillet[6]);

    bladesmith_curve *path = joined(pieces), *offset = NULL;
    printf("rounded path: %.6f mm\n", length_of(path));

    /* To the left of the path the corner's centre is 4 mm away: at 6 mm the lines meet without an arc. */
    const double distances[2] = {2.0, 6.0};
    for (int i = 0; i < 2; i++) {
        need(bladesmith_curve_offset(path, distances[i], 1e-6, 0.0, &offsets, &sources), "the offset");
        need(bladesmith_curves_get(offsets, 0, &offset), "its first curve");
        printf("offset by %.0f mm: %.4f mm\n", distances[i], length_of(offset));
        bladesmith_curve_free(offset);
        bladesmith_curves_free(offsets);
        bladesmith_table_free(sources);
    }
    bladesmith_curve_free(path);
    bladesmith_curve_free(first);
    bladesmith_curve_free(second);
    bladesmith_curves_free(pieces);
    bladesmith_table_free(fillets);
    return EXIT_SUCCESS;
}
