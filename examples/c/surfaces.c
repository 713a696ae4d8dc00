/* A surface through circular sections: points with derivatives, curvatures, and what is nearest.
 *
 *     surfaces
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

enum { SECTIONS = 4 };

/* Says which call failed and why; what is still owned goes with the program. */
static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", what, (int)status, bladesmith_last_error());
        exit(EXIT_FAILURE);
    }
}

int main(void)
{
    bladesmith_curve *sections[SECTIONS] = {NULL};
    double heights[SECTIONS];
    for (int i = 0; i < SECTIONS; i++) {
        const double radius = 10.0 + i, centre[3] = {0, 0, 10.0 * i};
        const double x[3] = {radius, 0, 0}, y[3] = {0, radius, 0};
        need(bladesmith_curve_arc(3, centre, x, y, 0.0, 1.5, &sections[i]), "a section");
        heights[i] = i / (SECTIONS - 1.0);
    }
    bladesmith_surface *surface = NULL;
    need(bladesmith_surface_skin((const bladesmith_curve *const *)sections, heights, SECTIONS, 3, &surface), "the skin");
    for (int i = 0; i < SECTIONS; i++)
        bladesmith_curve_free(sections[i]);

    /* One row for each (u, v): the point, then the derivatives along u and v. */
    const double uv[2][2] = {{0.25, 0.5}, {0.5, 0.5}};
    double jets[2][3][3], curvatures[2][2];
    need(bladesmith_surface_evaluate(surface, uv[0], 2, 1, 0, 0, jets[0][0]), "points");
    need(bladesmith_surface_curvatures(surface, uv[0], 2, NULL, curvatures[0], NULL), "curvatures");
    for (int i = 0; i < 2; i++)
        printf("(%.6f, %.6f, %.6f): along v (%.6f, %.6f, %.6f), curvatures %.6f and %.6f 1/mm\n", jets[i][0][0],
               jets[i][0][1], jets[i][0][2], jets[i][2][0], jets[i][2][1], jets[i][2][2], curvatures[i][0], curvatures[i][1]);

    const double points[2][3] = {{20, 20, 12}, {1, 1, 29}};
    double feet[2][3], distances[2];
    need(bladesmith_surface_nearest(surface, points[0], 2, NULL, feet[0], distances), "nearest points");
    for (int i = 0; i < 2; i++)
        printf("nearest (%.6f, %.6f, %.6f), %.6f mm away\n", feet[i][0], feet[i][1], feet[i][2], distances[i]);

    bladesmith_surface *half = NULL;
    bladesmith_curve *edge = NULL;
    double end = 1.0, length = 0.0;
    need(bladesmith_surface_part(surface, 1, 0.0, 0.5, &half), "the lower half");
    need(bladesmith_surface_isocurve(half, 1, 0.5, &edge), "its upper edge");
    need(bladesmith_curve_lengths(edge, 1e-9, &end, 1, &length), "its length");
    printf("edge of the lower half: %.6f mm\n", length);
    bladesmith_curve_free(edge);
    bladesmith_surface_free(half);
    bladesmith_surface_free(surface);
    return EXIT_SUCCESS;
}
