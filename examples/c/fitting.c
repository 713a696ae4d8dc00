/* Curves near measured points: through all of them, by least squares with fixed ends, and smoothed.
 *
 *     fitting
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 41, DEGREE = 3, KNOTS = 9 };

/* Says which call failed and why; what is still owned goes with the program. */
static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", what, (int)status, bladesmith_last_error());
        exit(EXIT_FAILURE);
    }
}

/* Largest distance of the points from a curve, and its number of poles. */
static void report(const char *name, bladesmith_curve *curve, const double (*points)[2])
{
    double distances[POINTS], largest = 0.0;
    size_t poles = 0;
    need(bladesmith_curve_nearest(curve, points[0], POINTS, NULL, NULL, distances), "distances");
    need(bladesmith_curve_size(curve, NULL, NULL, &poles, NULL), "size");
    for (int i = 0; i < POINTS; i++)
        largest = distances[i] > largest ? distances[i] : largest;
    printf("%-13s %2d poles, points within %.4f mm\n", name, (int)poles, largest);
    bladesmith_curve_free(curve);
}

int main(void)
{
    /* An arch, as measured: every point is off by up to 0.02 mm. */
    double points[POINTS][2], t[POINTS];
    for (int i = 0; i < POINTS; i++) {
        points[i][0] = i;
        points[i][1] = 0.02 * i * (POINTS - 1 - i) + 0.02 * (i % 3 - 1);
    }
    need(bladesmith_parameters(2, points[0], POINTS, BLADESMITH_SPACING_CHORD, 0.0, t), "parameters");

    bladesmith_curve *curve = NULL;
    need(bladesmith_curve_interpolate(2, DEGREE, t, NULL, points[0], POINTS, NULL, 0, &curve), "interpolation");
    report("interpolated", curve, (const double(*)[2])points);

    /* Few knots even the errors out; first and last point are kept. */
    const double knots[KNOTS] = {0, 0, 0, 0, 0.5, 1, 1, 1, 1};
    need(bladesmith_curve_fit(2, DEGREE, knots, KNOTS, t, points[0], NULL, POINTS, points[0], 1, points[POINTS - 1], 1, &curve),
         "least squares");
    report("least squares", curve, (const double(*)[2])points);

    /* Knots at every parameter, and bending held down until 0.02 mm remain on average. */
    double many[POINTS + DEGREE + 1];
    const double residual = POINTS * 0.02 * 0.02;
    need(bladesmith_averaged_knots(DEGREE, t, POINTS, many), "knots");
    need(bladesmith_curve_smooth_within(2, DEGREE, many, POINTS + DEGREE + 1, t, points[0], NULL, POINTS, residual, NULL, &curve),
         "smoothing");
    report("smoothed", curve, (const double(*)[2])points);
    return EXIT_SUCCESS;
}
