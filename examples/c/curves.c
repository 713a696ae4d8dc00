/* A curve through points: its length, points at equal distances along it, and what is nearest.
 *
 *     curves
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 7, STATIONS = 5, DEGREE = 3 };

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
    const double points[POINTS][2] = {{0, 0}, {8, 5}, {20, 9}, {34, 10}, {48, 7}, {60, 2}, {70, -4}};
    double t[POINTS], stations[STATIONS], at[STATIONS], curvatures[STATIONS], values[STATIONS][2];

    /* Points on their own leave parameters and knots open: here by the square root of distances. */
    bladesmith_curve *curve = NULL;
    need(bladesmith_parameters(2, points[0], POINTS, BLADESMITH_SPACING_CENTRIPETAL, 0.5, t), "parameters");
    need(bladesmith_curve_interpolate(2, DEGREE, t, NULL, points[0], POINTS, NULL, 0, &curve), "interpolation");

    double end = 1.0, length = 0.0;
    need(bladesmith_curve_lengths(curve, 1e-9, &end, 1, &length), "length");
    printf("length %.6f mm\n", length);

    for (int i = 0; i < STATIONS; i++)
        stations[i] = length * i / (STATIONS - 1);
    need(bladesmith_curve_at_lengths(curve, 1e-9, stations, STATIONS, at), "parameters at lengths");
    need(bladesmith_curve_evaluate(curve, at, STATIONS, 0, 0, values[0]), "points");
    need(bladesmith_curve_frames(curve, at, STATIONS, NULL, curvatures, NULL), "curvatures");
    for (int i = 0; i < STATIONS; i++)
        printf("at %6.3f mm: (%.6f, %.6f), curvature %.6f 1/mm\n", stations[i], values[i][0], values[i][1], curvatures[i]);

    const double outside[2][2] = {{30, 20}, {75, 0}};
    double distances[2];
    need(bladesmith_curve_nearest(curve, outside[0], 2, NULL, NULL, distances), "nearest points");
    printf("distances %.6f mm, %.6f mm\n", distances[0], distances[1]);

    /* Results of unknown number come as a list of their own. */
    bladesmith_curves *segments = NULL;
    size_t count = 0;
    need(bladesmith_curve_bezier(curve, &segments), "Bezier segments");
    bladesmith_curve_free(curve);
    need(bladesmith_curves_count(segments, &count), "their number");
    printf("%d Bezier segments\n", (int)count);
    bladesmith_curves_free(segments);
    return EXIT_SUCCESS;
}
