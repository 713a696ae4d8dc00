/* Where curves cross each other and themselves, and where rays hit them.
 *
 *     intersections
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 8 };

/* Says which call failed and why; what is still owned goes with the program. */
static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", what, (int)status, bladesmith_last_error());
        exit(EXIT_FAILURE);
    }
}

/* A closed polygon or a path as a curve of degree 1. */
static bladesmith_curve *path(const double (*points)[2], size_t count)
{
    double knots[16];
    bladesmith_curve *curve = NULL;
    for (size_t i = 0; i < count + 2; i++)
        knots[i] = i == 0 ? 0.0 : i > count ? (double)(count - 1) : (double)(i - 1);
    need(bladesmith_curve_new(2, 1, knots, count + 2, points[0], NULL, count, &curve), "a path");
    return curve;
}

/* Prints the rows of a table and frees it: t, s, x, y ... of each crossing. */
static void print_crossings(const char *name, bladesmith_table *table)
{
    double rows[MOST][7];
    size_t count = 0, columns = 0;
    need(bladesmith_table_size(table, &count, &columns), "the size of a table");
    need(bladesmith_table_data(table, MOST, rows[0]), "its rows");
    bladesmith_table_free(table);
    for (size_t i = 0; i < count; i++)
        printf("%s at (%.6f, %.6f), t = %.6f, %.6f\n", name, rows[i][2], rows[i][3], rows[i][0], rows[i][1]);
}

int main(void)
{
    const double bow[4][2] = {{0, 0}, {10, 8}, {10, 0}, {0, 8}}, centre[2] = {5, 4}, x[2] = {3, 0}, y[2] = {0, 3};
    const double from[2][2] = {{5, 20}, {20, 20}}, down[2][2] = {{0, -1}, {0, -1}};
    bladesmith_curve *first = path(bow, 4), *circle = NULL;
    bladesmith_table *crossings = NULL, *overlaps = NULL;
    need(bladesmith_curve_arc(2, centre, x, y, 0.0, 6.283185307179586, &circle), "a circle");

    need(bladesmith_curve_intersect(first, circle, 1e-9, &crossings, &overlaps), "crossings");
    print_crossings("crossing", crossings);
    bladesmith_table_free(overlaps);

    need(bladesmith_curve_self_intersect(first, 1e-9, &crossings, &overlaps), "its own crossings");
    print_crossings("itself", crossings);
    bladesmith_table_free(overlaps);

    /* Many rays at once; where one misses the curve its numbers are NaN. */
    double lengths[2];
    need(bladesmith_curve_first_hits(circle, from[0], down[0], 2, 1e-9, lengths, NULL, NULL), "rays");
    for (int i = 0; i < 2; i++) {
        if (lengths[i] == lengths[i])
            printf("ray %d hits the circle after %.6f mm\n", i + 1, lengths[i]);
        else
            printf("ray %d misses the circle\n", i + 1);
    }
    bladesmith_curve_free(first);
    bladesmith_curve_free(circle);
    return EXIT_SUCCESS;
}
