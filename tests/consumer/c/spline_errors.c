/* What calls of the kernel refuse, and that they write nothing then: spline_errors */
#include "expect.h"
#include <math.h>

enum { SPLINE = BLADESMITH_STATUS_SPLINE };

static const double LINE_KNOTS[4] = {0, 0, 1, 1}, LINE_POLES[4] = {0, 0, 3, 4};

static bladesmith_curve *line(void)
{
    bladesmith_curve *curve = NULL;
    CHECK(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, LINE_POLES, NULL, 2, &curve));
    return curve;
}

static void check_new(void)
{
    const double down[4] = {0, 1, 0, 1}, bad[4] = {0, 0, NAN, 4}, zero[2] = {1, 0};
    const double *odd = (const double *)(const void *)((const char *)LINE_POLES + 1);
    bladesmith_curve *curve = NULL;
    EXPECT(bladesmith_curve_new(4, 1, LINE_KNOTS, 4, LINE_POLES, NULL, 2, &curve), ARGUMENT, "'dimension': is 4");
    EXPECT(bladesmith_curve_new(2, 1, NULL, 4, LINE_POLES, NULL, 2, &curve), ARGUMENT, "'knots': is NULL");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, NULL, NULL, 2, &curve), ARGUMENT, "'poles': is NULL");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, odd, NULL, 1, &curve), ARGUMENT, "aligned");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, LINE_POLES, NULL, 2, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, SIZE_MAX / 2, LINE_POLES, NULL, 2, &curve), ARGUMENT, "address space");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, bad, NULL, 2, &curve), ARGUMENT, "'poles': point 2");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, LINE_POLES, zero, 2, &curve), SPLINE, "weight 2 is 0");
    EXPECT(bladesmith_curve_new(2, 1, down, 4, LINE_POLES, NULL, 2, &curve), SPLINE, "knot");
    EXPECT(bladesmith_curve_new(2, 26, LINE_KNOTS, 4, LINE_POLES, NULL, 2, &curve), SPLINE, "degree 26");
    EXPECT(bladesmith_curve_new(2, 1, LINE_KNOTS, 4, LINE_POLES, NULL, 1, &curve), SPLINE, "1 poles");
    EXPECT_TRUE(curve == NULL);
    bladesmith_curve_free(NULL);
    bladesmith_curves_free(NULL);
    bladesmith_surface_free(NULL);
    bladesmith_table_free(NULL);
}

static void check_arrays(const bladesmith_curve *curve)
{
    const double t[2] = {0.5, INFINITY};
    double out[9] = {0}, poles[6] = {0};
    size_t count = 0;
    uint32_t degree = 0;
    out[0] = out[8] = poles[4] = 7.0;
    EXPECT(bladesmith_curve_evaluate(NULL, t, 1, 1, 0, out), ARGUMENT, "'curve': is NULL");
    EXPECT(bladesmith_curve_evaluate(curve, t, 2, 1, 0, out), ARGUMENT, "value 1 of point 2 is inf");
    EXPECT(bladesmith_curve_evaluate(curve, t, 1, 26, 0, out), ARGUMENT, "'order': is 26");
    EXPECT(bladesmith_curve_evaluate(curve, t, 1, 1, 0, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_curve_evaluate(curve, t, SIZE_MAX / 4, 3, 0, out), ARGUMENT, "address space");
    EXPECT(bladesmith_curve_lengths(curve, 0.0, t, 1, out), ARGUMENT, "'tolerance'");
    EXPECT_TRUE(out[0] == 7.0);
    EXPECT(bladesmith_curve_evaluate(curve, t, 1, 3, 0, out), OK, "");
    EXPECT_TRUE(out[0] == 1.5 && out[1] == 2.0 && out[2] == 3.0 && out[3] == 4.0 && out[6] == 0.0 && out[8] == 7.0);
    EXPECT(bladesmith_curve_evaluate(curve, NULL, 0, 0, 0, NULL), OK, "");
    EXPECT(bladesmith_curve_size(curve, NULL, &degree, &count, NULL), OK, "");
    EXPECT_TRUE(degree == 1 && count == 2);
    EXPECT(bladesmith_curve_data(curve, 3, NULL, poles, NULL), ARGUMENT, "'pole_count': is 3");
    EXPECT(bladesmith_curve_data(curve, 2, NULL, poles, NULL), OK, "");
    EXPECT_TRUE(poles[3] == 4.0 && poles[4] == 7.0);
}

static void check_changes(const bladesmith_curve *curve)
{
    const double matrix[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, NAN, 0}, outside = 2.0, point[2] = {0, 0};
    bladesmith_curve *none = NULL;
    bladesmith_table *table = NULL;
    EXPECT(bladesmith_curve_refine(curve, &outside, 1, &none), SPLINE, "knot 2");
    EXPECT(bladesmith_curve_remove_knot(curve, 0.5, 1, 1.0, NULL, &none), SPLINE, "0.5");
    EXPECT(bladesmith_curve_remove_knot(curve, 0.5, 1, -1.0, NULL, &none), ARGUMENT, "'tolerance': is -1");
    EXPECT(bladesmith_curve_elevate(curve, UINT32_MAX, &none), SPLINE, "degree");
    EXPECT(bladesmith_curve_reduce(curve, 1.0, NULL, &none), SPLINE, "degree");
    EXPECT(bladesmith_curve_part(curve, 0.5, 0.5, &none), SPLINE, "0.5");
    EXPECT(bladesmith_curve_over(curve, 1.0, 0.0, &none), SPLINE, "");
    EXPECT(bladesmith_curve_map(curve, matrix, 2, &none), ARGUMENT, "'matrix'");
    EXPECT(bladesmith_curve_join(curve, curve, 1e-6, 0, &none), SPLINE, "");
    EXPECT(bladesmith_curve_arc(2, point, point, point, 0.0, 7.0, &none), ARGUMENT, "full turn");
    EXPECT(bladesmith_curve_nearest_all(curve, point, -1.0, &table), ARGUMENT, "'tie': is -1");
    EXPECT_TRUE(none == NULL && table == NULL);
}

static void check_fits(void)
{
    const double t[3] = {0, 0.5, 0.5}, points[6] = {0, 0, 1, 1, 2, 0}, knots[6] = {0, 0, 0, 1, 1, 1};
    double out[3] = {7, 7, 7};
    bladesmith_curve *none = NULL;
    EXPECT(bladesmith_parameters(2, points, 3, 9, 0.0, out), ARGUMENT, "'spacing': is 9");
    EXPECT(bladesmith_parameters(2, points, 3, BLADESMITH_SPACING_CENTRIPETAL, -1.0, out), ARGUMENT, "'factor'");
    EXPECT(bladesmith_parameters(2, points, 1, BLADESMITH_SPACING_CHORD, 0.0, out), ARGUMENT, "two points");
    EXPECT_TRUE(out[0] == 7);
    EXPECT(bladesmith_curve_interpolate(2, 2, t, NULL, points, 3, NULL, 0, &none), ARGUMENT, "0.5");
    EXPECT(bladesmith_curve_fit(2, 2, knots, 6, t, points, NULL, 1, NULL, 0, NULL, 0, &none), SPLINE, "");
    EXPECT(bladesmith_curve_smooth(2, 2, knots, 6, t, points, NULL, 3, 0.0, &none), ARGUMENT, "smoothing");
    EXPECT_TRUE(none == NULL);
}

static void check_lists(const bladesmith_curve *curve)
{
    const bladesmith_curve *pair[2] = {curve, NULL};
    bladesmith_curves *curves = NULL;
    bladesmith_curve *one = NULL;
    bladesmith_table *table = NULL;
    size_t count = 0, columns = 0;
    double row[5], point[2] = {3, 0};
    EXPECT(bladesmith_curves_compatible(pair, 2, &curves), ARGUMENT, "'curves': is NULL");
    EXPECT(bladesmith_curves_compatible(NULL, 0, &curves), ARGUMENT, "'curves': is empty");
    EXPECT_TRUE(curves == NULL);
    EXPECT(bladesmith_curves_compatible(pair, 1, &curves), OK, "");
    EXPECT(bladesmith_curves_count(curves, &count), OK, "");
    EXPECT(bladesmith_curves_get(curves, count, &one), ARGUMENT, "'index': is 1");
    EXPECT(bladesmith_curves_get(curves, 0, &one), OK, "");
    bladesmith_curves_free(curves);
    EXPECT(bladesmith_curve_nearest_all(one, point, 1e-9, &table), OK, "");
    bladesmith_curve_free(one);
    EXPECT(bladesmith_table_size(table, &count, &columns), OK, "");
    EXPECT_TRUE(count == 1 && columns == 5);
    EXPECT(bladesmith_table_data(table, 0, row), SMALL, "1 are needed");
    EXPECT(bladesmith_table_data(table, 1, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_table_data(table, 1, row), OK, "");
    EXPECT_TRUE(fabs(row[0] - 0.36) < 1e-12 && fabs(row[4] - 2.4) < 1e-12);
    bladesmith_table_free(table);
}

static void check_surfaces(const bladesmith_curve *plane)
{
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 2}, none_axis[3] = {0, 0, 0}, lift[12] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0};
    double uv[2] = {0.5, 0.5}, out[18];
    bladesmith_curve *curve = NULL;
    bladesmith_surface *surface = NULL, *none = NULL;
    CHECK(bladesmith_curve_map(plane, lift, 3, &curve));
    EXPECT(bladesmith_surface_revolved(plane, origin, axis, 1.0, &surface), ARGUMENT, "'curve': has a curve of the other");
    EXPECT(bladesmith_surface_revolved(curve, origin, none_axis, 1.0, &surface), ARGUMENT, "'axis'");
    EXPECT(bladesmith_surface_ruled(curve, NULL, &surface), ARGUMENT, "'second': is NULL");
    EXPECT_TRUE(surface == NULL);
    CHECK(bladesmith_surface_revolved(curve, origin, axis, 1.0, &surface));
    EXPECT(bladesmith_surface_evaluate(surface, uv, 1, 2, 0, 0, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_surface_evaluate(surface, uv, 1, 2, 0, 0, out), OK, "");
    EXPECT(bladesmith_surface_part(surface, 2, 0.0, 0.5, &none), ARGUMENT, "'direction': is 2");
    EXPECT(bladesmith_surface_refine(surface, 1, uv, 2, &none), OK, "");
    bladesmith_surface_free(none);
    none = NULL;
    EXPECT(bladesmith_surface_isocurve(surface, 0, 1.5, &curve), ARGUMENT, "'t': is 1.5");
    EXPECT(bladesmith_surface_data(surface, 1, NULL, NULL, out, NULL), ARGUMENT, "'pole_count': is 1");
    bladesmith_surface_free(surface);
    bladesmith_curve_free(curve);
}

int main(void)
{
    check_new();
    bladesmith_curve *curve = line();
    check_arrays(curve);
    check_changes(curve);
    check_fits();
    check_lists(curve);
    check_surfaces(curve);
    bladesmith_curve_free(curve);
    return ended();
}
