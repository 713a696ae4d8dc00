/* What the tools of the kernel refuse, that they write nothing then, and what they give: tool_errors */
#include "expect.h"
#include <math.h>

static const double ENDS[4] = {0, 0, 1, 1};

static bladesmith_curve *line(uint32_t dimension, const double *poles)
{
    bladesmith_curve *curve = NULL;
    CHECK(bladesmith_curve_new(dimension, 1, ENDS, 4, poles, NULL, 2, &curve));
    return curve;
}

/* The square [0, 4] x [0, 4] at the height 0, or turned upright at x = 2. */
static bladesmith_surface *square(int upright)
{
    const double flat[12] = {0, 0, 0, 0, 4, 0, 4, 0, 0, 4, 4, 0}, up[12] = {2, 0, -2, 2, 4, -2, 2, 0, 2, 2, 4, 2};
    bladesmith_surface *surface = NULL;
    CHECK(bladesmith_surface_new(1, 1, ENDS, 4, ENDS, 4, upright ? up : flat, NULL, 4, &surface));
    return surface;
}

static size_t rows_of(bladesmith_table *table, size_t columns, double *row)
{
    size_t rows = 0, found = 0;
    CHECK(bladesmith_table_size(table, &rows, &found));
    EXPECT_TRUE(found == columns);
    if (rows == 1)
        CHECK(bladesmith_table_data(table, 1, row));
    bladesmith_table_free(table);
    return rows;
}

static size_t count_of(bladesmith_curves *curves)
{
    size_t count = 0;
    CHECK(bladesmith_curves_count(curves, &count));
    bladesmith_curves_free(curves);
    return count;
}

static void check_fillets(void)
{
    const double along[4] = {0, 0, 10, 0}, up[4] = {0, 0, 0, 10}, space[6] = {0, 0, 0, 1, 1, 1}, bad[2] = {NAN, 0};
    const double near[2] = {-9, -9};
    bladesmith_curve *a = line(2, along), *b = line(2, up), *c = line(3, space);
    bladesmith_curves *curves = NULL;
    bladesmith_table *table = NULL;
    double row[10];
    EXPECT(bladesmith_curve_fillets(NULL, b, 2, 1e-6, &curves, &table), ARGUMENT, "'curve': is NULL");
    EXPECT(bladesmith_curve_fillets(a, NULL, 2, 1e-6, &curves, &table), ARGUMENT, "'other': is NULL");
    EXPECT(bladesmith_curve_fillets(a, c, 2, 1e-6, &curves, &table), ARGUMENT, "'other': has a curve of the other");
    EXPECT(bladesmith_curve_fillets(a, b, NAN, 1e-6, &curves, &table), ARGUMENT, "'radius'");
    EXPECT(bladesmith_curve_fillets(a, b, 2, 3, &curves, &table), ARGUMENT, "'radius'");
    EXPECT(bladesmith_curve_fillets(a, b, 2, 1e-6, NULL, &table), ARGUMENT, "'curves': is NULL");
    EXPECT(bladesmith_curve_fillet(a, b, 2, 1e-6, bad, &curves, &table), ARGUMENT, "'near'");
    EXPECT(bladesmith_curve_fillet(a, b, 2, 1e-6, NULL, &curves, NULL), ARGUMENT, "'fillets': is NULL");
    EXPECT_TRUE(curves == NULL && table == NULL);
    EXPECT(bladesmith_curve_fillet(a, b, 2, 1e-6, NULL, &curves, &table), OK, "");
    EXPECT_TRUE(rows_of(table, 10, row) == 1 && count_of(curves) == 3);
    EXPECT_TRUE(fabs(row[0] - 2) < 1e-9 && fabs(row[1] - 2) < 1e-9 && row[7] == 0 && row[8] == 1 && row[9] == 2);
    EXPECT(bladesmith_curve_fillet(a, b, 2, 1e-6, near, &curves, &table), OK, "");
    EXPECT_TRUE(rows_of(table, 10, row) == 1 && count_of(curves) == 3);
    EXPECT(bladesmith_curve_fillets(a, b, 20, 1e-6, &curves, &table), OK, "");
    EXPECT_TRUE(rows_of(table, 10, row) == 0 && count_of(curves) == 0);
    bladesmith_curve_free(a);
    bladesmith_curve_free(b);
    bladesmith_curve_free(c);
}

static void check_offsets(void)
{
    const double along[4] = {0, 0, 10, 0}, pieces[10] = {0, 0, 1, 0.75, 1.0, 0, 1, 2, 0, 0.25}, t[2] = {0.25, 0.75};
    bladesmith_curve *curve = line(2, along);
    bladesmith_curves *curves = NULL;
    bladesmith_table *table = NULL;
    double row[5], out[2] = {7, 7};
    EXPECT(bladesmith_curve_offset_raw(curve, 0, 1e-6, 0, &curves, &table), ARGUMENT, "'distance'");
    EXPECT(bladesmith_curve_offset_raw(curve, 1, 1e-6, 0.5, &curves, &table), ARGUMENT, "'corner'");
    EXPECT_TRUE(curves == NULL && table == NULL);
    EXPECT(bladesmith_curve_offset_raw(curve, 1, 1e-6, 0, &curves, &table), OK, "");
    EXPECT_TRUE(rows_of(table, 5, row) == 1 && count_of(curves) == 1);
    EXPECT(bladesmith_curve_offset_map(curve, pieces, 0, t, 2, out), ARGUMENT, "at least one");
    EXPECT(bladesmith_curve_offset_map(curve, NULL, 2, t, 2, out), ARGUMENT, "'pieces': is NULL");
    EXPECT(bladesmith_curve_offset_map(curve, pieces, SIZE_MAX / 2, t, 2, out), ARGUMENT, "'piece_count'");
    EXPECT_TRUE(out[0] == 7);
    EXPECT(bladesmith_curve_offset_map(curve, pieces, 2, t, 2, out), OK, "");
    EXPECT_TRUE(fabs(out[0] - 0.125) < 1e-15 && fabs(out[1] - 0.875) < 1e-15);
    bladesmith_curve_free(curve);
}

static void check_contacts(const bladesmith_section *section)
{
    bladesmith_table *touching = NULL, *overlaps = NULL, *uncertain = NULL;
    double row[9];
    EXPECT(bladesmith_section_contacts(section, &touching, NULL, &uncertain), ARGUMENT, "'overlaps': is NULL");
    EXPECT_TRUE(touching == NULL && uncertain == NULL);
    EXPECT(bladesmith_section_contacts(section, &touching, &overlaps, &uncertain), OK, "");
    EXPECT_TRUE(rows_of(touching, 9, row) == 0 && rows_of(overlaps, 4, row) == 0 && rows_of(uncertain, 2, row) == 0);
}

static void check_sections(const bladesmith_surface *flat, const bladesmith_surface *upright)
{
    const double origin[3] = {1, 1, 0}, normal[3] = {1, 0, 0}, none[3] = {0, 0, 0};
    bladesmith_section *section = NULL;
    bladesmith_curves *curves = NULL, *first = NULL, *second = NULL;
    bladesmith_table *branches = NULL;
    double axes[9], row[3];
    EXPECT(bladesmith_surface_section(flat, origin, none, 1e-6, &section), ARGUMENT, "'plane'");
    EXPECT(bladesmith_surface_section(flat, NULL, normal, 1e-6, &section), ARGUMENT, "'origin': is NULL");
    EXPECT(bladesmith_surface_section(flat, origin, normal, 0, &section), ARGUMENT, "'tolerance'");
    EXPECT(bladesmith_surface_intersect(flat, NULL, 1e-6, &section), ARGUMENT, "'other': is NULL");
    EXPECT_TRUE(section == NULL);
    EXPECT(bladesmith_surface_intersect(flat, upright, 1e-6, &section), OK, "");
    EXPECT(bladesmith_section_axes(section, axes), ARGUMENT, "two surfaces");
    check_contacts(section);
    bladesmith_section_free(section);
    bladesmith_section_free(NULL);
    EXPECT(bladesmith_surface_section(flat, origin, normal, 1e-6, &section), OK, "");
    EXPECT(bladesmith_section_axes(section, NULL), ARGUMENT, "'out': is NULL");
    EXPECT(bladesmith_section_axes(section, axes), OK, "");
    EXPECT_TRUE(axes[0] == 1 && fabs(axes[3]) < 1e-15 && fabs(axes[6]) < 1e-15);
    EXPECT(bladesmith_section_branches(NULL, &curves, &first, &second, &branches), ARGUMENT, "'section': is NULL");
    EXPECT(bladesmith_section_branches(section, &curves, &first, &second, NULL), ARGUMENT, "'branches': is NULL");
    EXPECT_TRUE(curves == NULL && branches == NULL);
    EXPECT(bladesmith_section_branches(section, &curves, &first, &second, &branches), OK, "");
    EXPECT_TRUE(count_of(curves) == 1 && count_of(first) == 1 && count_of(second) == 1);
    EXPECT_TRUE(rows_of(branches, 3, row) == 1 && row[0] == 0 && row[1] == 0 && row[2] <= 1e-6);
    bladesmith_section_free(section);
}

static void check_projection(const bladesmith_surface *flat)
{
    const double above[6] = {-1, 1, 1, 3, 2, 2}, plane[4] = {0, 0, 1, 1}, down[3] = {0, 0, -1}, none[3] = {0, 0, 0};
    bladesmith_curve *curve = line(3, above), *other = line(2, plane);
    bladesmith_curves *curves = NULL, *parameters = NULL;
    bladesmith_table *off = NULL;
    double row[1];
    EXPECT(bladesmith_surface_project(flat, other, NULL, 1e-6, &curves, &parameters, &off), ARGUMENT, "other dimension");
    EXPECT(bladesmith_surface_project(flat, curve, none, 1e-6, &curves, &parameters, &off), ARGUMENT, "'direction'");
    EXPECT(bladesmith_surface_project(flat, curve, down, 0, &curves, &parameters, &off), ARGUMENT, "'tolerance'");
    EXPECT(bladesmith_surface_project(flat, curve, down, 1e-6, &curves, NULL, &off), ARGUMENT, "'parameters': is NULL");
    EXPECT_TRUE(curves == NULL && parameters == NULL && off == NULL);
    const double *const directions[2] = {NULL, down};
    for (int i = 0; i < 2; i++) {
        EXPECT(bladesmith_surface_project(flat, curve, directions[i], 1e-6, &curves, &parameters, &off), OK, "");
        EXPECT_TRUE(count_of(curves) == 1 && count_of(parameters) == 1 && rows_of(off, 1, row) == 1 && row[0] <= 1e-6);
    }
    bladesmith_curve_free(curve);
    bladesmith_curve_free(other);
}

static void check_batches(const bladesmith_surface *flat)
{
    const double from[6] = {1, 3, 5, 9, 9, 5}, down[6] = {0, 0, -2, 0, 0, -2}, still[6] = {0, 0, -1, 0, 0, 0};
    const double u[2] = {0.25, 0.5}, v[1] = {0.5}, ends[4] = {2, -1, 2, 9};
    double lengths[2] = {7, 7}, uv[4], points[6], grid[18];
    bladesmith_surfaces *patches = NULL;
    bladesmith_surface *one = NULL;
    size_t count = 0;
    EXPECT(bladesmith_surface_first_hits(flat, from, still, 2, 1e-9, lengths, uv, points), ARGUMENT, "'direction'");
    EXPECT(bladesmith_surface_first_hits(flat, from, NULL, 2, 1e-9, lengths, uv, points), ARGUMENT, "'directions': is NULL");
    EXPECT_TRUE(lengths[0] == 7);
    EXPECT(bladesmith_surface_first_hits(flat, from, down, 2, 1e-9, lengths, uv, NULL), OK, "");
    EXPECT_TRUE(fabs(lengths[0] - 5) < 1e-12 && isnan(lengths[1]) && fabs(uv[1] - 0.75) < 1e-12 && isnan(uv[3]));
    EXPECT(bladesmith_surface_evaluate_grid(flat, u, 2, v, 1, 3, grid), ARGUMENT, "'order': is 3");
    EXPECT(bladesmith_surface_evaluate_grid(flat, u, SIZE_MAX, v, 2, 0, grid), ARGUMENT, "address space");
    EXPECT(bladesmith_surface_evaluate_grid(flat, u, 2, v, 1, 1, grid), OK, "");
    EXPECT_TRUE(grid[0] == 1 && grid[1] == 2 && grid[3] == 4 && grid[9] == 2 && grid[16] == 4);
    EXPECT(bladesmith_surface_bezier(NULL, &patches), ARGUMENT, "'surface': is NULL");
    EXPECT(bladesmith_surface_over(flat, 0, 3, 3, &one), BLADESMITH_STATUS_SPLINE, "");
    EXPECT_TRUE(patches == NULL && one == NULL);
    CHECK(bladesmith_surface_bezier(flat, &patches));
    EXPECT(bladesmith_surfaces_count(patches, &count), OK, "");
    EXPECT(bladesmith_surfaces_get(patches, 1, &one), ARGUMENT, "'index': is 1");
    EXPECT(bladesmith_surfaces_get(patches, 0, &one), OK, "");
    EXPECT_TRUE(count == 1 && one != NULL);
    bladesmith_surfaces_free(patches);
    bladesmith_surfaces_free(NULL);
    bladesmith_surface_free(one);
    bladesmith_curve *curve = line(2, ends);
    EXPECT(bladesmith_curve_first_hits(curve, from, down + 1, 1, 1e-9, lengths, NULL, NULL), OK, "");
    EXPECT_TRUE(isnan(lengths[0]));
    bladesmith_curve_free(curve);
}

static void check_knots(void)
{
    const double t[4] = {0, 1, 2, 4}, back[2] = {1, 0}, breaks[4] = {0, 1, 2, 3}, poles[6] = {0, 0, 2, 0, 1, 2};
    double knots[7] = {7};
    bladesmith_curve *closed = NULL;
    EXPECT(bladesmith_averaged_knots(4, t, 4, knots), BLADESMITH_STATUS_SPLINE, "too few");
    EXPECT(bladesmith_averaged_knots(1, back, 2, knots), BLADESMITH_STATUS_SPLINE, "");
    EXPECT(bladesmith_averaged_knots(2, t, 4, NULL), ARGUMENT, "'out': is NULL");
    EXPECT_TRUE(knots[0] == 7);
    EXPECT(bladesmith_averaged_knots(2, t, 4, knots), OK, "");
    EXPECT_TRUE(knots[2] == 0 && knots[3] == 1.5 && knots[4] == 4);
    EXPECT(bladesmith_curve_periodic(2, 2, breaks, 1, poles, NULL, &closed), BLADESMITH_STATUS_SPLINE, "two breaks");
    EXPECT(bladesmith_curve_periodic(2, 2, breaks, 4, NULL, NULL, &closed), ARGUMENT, "'poles': is NULL");
    EXPECT_TRUE(closed == NULL);
    EXPECT(bladesmith_curve_periodic(2, 2, breaks, 4, poles, NULL, &closed), OK, "");
    double ends[4];
    const double seam[2] = {0, 3};
    CHECK(bladesmith_curve_evaluate(closed, seam, 2, 0, 0, ends));
    EXPECT_TRUE(fabs(ends[0] - ends[2]) < 1e-15 && fabs(ends[1] - ends[3]) < 1e-15);
    bladesmith_curve_free(closed);
}

int main(void)
{
    bladesmith_surface *flat = square(0), *upright = square(1);
    check_fillets();
    check_offsets();
    check_sections(flat, upright);
    check_projection(flat);
    check_batches(flat);
    check_knots();
    bladesmith_surface_free(flat);
    bladesmith_surface_free(upright);
    return ended();
}
