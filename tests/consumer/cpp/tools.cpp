// The C++ owners of the kernel's tools at work: tools
//
// Fillets, sections, projections, offsets, batches and closed curves against closed forms.

#include "expect.hpp"

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve, bladesmith::Direction, bladesmith::Error, bladesmith::Surface;

static_assert(std::is_nothrow_move_constructible_v<bladesmith::Fillet> && !std::is_copy_constructible_v<bladesmith::Branch>);

static const double PI = std::acos(-1.0);

static Curve line(std::vector<double> poles)
{
    return Curve(static_cast<std::uint32_t>(poles.size() / 2), 1, std::array{0.0, 0.0, 1.0, 1.0}, poles);
}

static Surface pipe()
{
    return Surface::revolved(line({5, 0, 0, 5, 0, 20}), {0, 0, 0}, {0, 0, 1}, 2 * PI);
}

static void check_fillets()
{
    const auto cross = line({-10, 0, 10, 0}), up = line({0, -10, 0, 10});
    const auto all = bladesmith::fillets(cross, up, 2.0, 1e-4);
    expect(all.size() == 4, "a fillet in each quarter");
    for (const auto &one : all) {
        expect_near(std::abs(one.angle), PI / 2, "a quarter of a circle");
        expect_near(one.arc->length(), PI, "its length");
        expect_near(one.first->length() + one.second->length(), 2 * 10 - 2 * 2 + (one.first->length() > 10 ? 4 : 0) + (one.second->length() > 10 ? 4 : 0),
                    "what is left of the lines");
    }
    const auto near = bladesmith::fillet(cross, up, 2.0, 1e-4, {-9, 9});
    expect(near && near->centre[0] < 0 && near->centre[1] > 0, "the nearest fillet");
    const auto corner = bladesmith::fillet(line({0, 0, 10, 0}), line({10, 0, 10, 10}), 3.0, 1e-4);
    expect(corner && corner->first && corner->arc && corner->second, "a rounded corner");
    expect_near(corner->centre[0] + corner->centre[1], 10.0, "its centre");
    expect(!bladesmith::fillet(line({0, 0, 10, 0}), line({10, 0, 10, 10}), 30.0, 1e-4), "no fillet that is too large");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "an end of one must meet", [&] { bladesmith::fillet(cross, up, 2.0, 1e-4); });
}

static void check_curves()
{
    const auto ring = Curve::periodic(2, 3, std::array{0.0, 1.0, 2.0, 3.0, 4.0}, std::array{1.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, -1.0});
    const auto ends = ring.evaluate(std::array{0.0, 4.0}, 2);
    for (std::size_t i = 0; i < 6; i++)
        expect_near(ends[i], ends[6 + i], "a closed curve at its seam");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "poles needs 4", [] { Curve::periodic(2, 1, std::array{0.0, 1.0, 2.0}, std::array{1.0}); });
    const auto knots = bladesmith::averaged_knots(2, std::array{0.0, 1.0, 2.0, 4.0});
    expect(knots == std::vector<double>{0, 0, 0, 1.5, 4, 4, 4}, "averaged knots");
    const auto circle = Curve::arc(std::array{0.0, 0.0}, std::array{2.0, 0.0}, std::array{0.0, 2.0}, 0.0, 2 * PI);
    const auto hits = circle.first_hits(std::array{0.0, 9.0, 9.0, 9.0}, std::array{0.0, -1.0, 0.0, 1.0}, 1e-9);
    expect_near(hits.lengths[0], 7.0, "the length of a ray");
    expect(std::isnan(hits.lengths[1]) && std::isnan(hits.points[3]), "a ray that misses");
    const Curve corner(2, 1, std::array{0.0, 0.0, 1.0, 2.0, 2.0}, std::array{0.0, 0.0, 10.0, 0.0, 10.0, 10.0});
    const auto raw = corner.offset_raw(2.0, 1e-4);
    expect(raw.curves.size() == 2, "an offset that breaks at a corner");
    expect_near(raw.curves[0].length(), 10.0, "its length");
    const auto kept = corner.offset(2.0, 1e-4);
    const auto mapped = corner.offset_map(kept.pieces, std::array{0.0, 1.0, 2.0});
    expect_near(mapped[0], 0.0, "the start of the domain");
    expect_near(mapped[1], 1.2, "its middle, beyond the part that is cut", 1e-4);
    expect_near(mapped[2], 2.0, "its end");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "5 columns", [&] { corner.offset_map({}, std::array{0.0}); });
}

static void check_sections()
{
    const auto tube = pipe();
    const auto cut = tube.section({0, 0, 10}, {0, 0, 1}, 1e-7);
    expect(cut.branches.size() == 1 && cut.axes && cut.touching.rows() == 0 && cut.uncertain.rows() == 0, "a circle");
    expect_near(cut.branches[0].curve.length(), 10 * PI, "its length", 1e-6);
    const auto in_plane = cut.branches[0].parameters[1].evaluate(std::array{3.0});
    const auto in_space = cut.branches[0].curve.evaluate(std::array{3.0});
    for (std::size_t i = 0; i < 3; i++)
        expect_near((*cut.axes)[i] + in_plane[0] * (*cut.axes)[3 + i] + in_plane[1] * (*cut.axes)[6 + i], in_space[i], "a point of the plane", 1e-6);
    const auto sheet = Surface::ruled(line({-9, 3, -9, 9, 3, -9}), line({-9, 3, 29, 9, 3, 29}));
    const auto met = tube.intersect(sheet, 1e-7);
    expect(met.branches.size() == 2 && !met.axes, "two lines");
    for (const auto &branch : met.branches)
        expect_near(branch.curve.length(), 20.0, "their length", 1e-6);
    const auto grazing = tube.section({5, 0, 0}, {1, 0, 0}, 1e-7);
    for (const auto &branch : grazing.branches)
        expect(branch.touching, "a plane that touches");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "plane", [&] { tube.section({0, 0, 0}, {0, 0, 0}, 1e-7); });
}

static void check_surfaces()
{
    const auto tube = pipe();
    const auto shadow = tube.project(line({8, 0, 5, 8, 0, 15}), 1e-7);
    expect(shadow.size() == 1, "one projected part");
    expect_near(shadow[0].curve.length(), 10.0, "its length", 1e-6);
    expect(tube.project(line({-1, 9, 5, 1, 9, 15}), {0, 1, 0}, 1e-7).size() == 2, "both sides along a direction");
    const auto hits = tube.first_hits(std::array{0.0, 0.0, 1.0, 0.0, 0.0, 30.0}, std::array{0.0, 1.0, 0.0, 1.0, 0.0, 0.0}, 1e-9);
    expect_near(hits.lengths[0], 5.0, "the length of a ray");
    expect(std::isnan(hits.parameters[3]), "a ray that misses");
    const auto grid = tube.evaluate_grid(std::array{0.0, 1.0}, std::array{0.0, 0.25, 0.5}, 1);
    const auto same = tube.evaluate(std::array{1.0, 0.25}, 1);
    for (std::size_t i = 0; i < 9; i++)
        expect_near(grid[9 * 4 + i], same[i], "a value on a grid");
    expect(tube.bezier_patches().size() == 4, "four patches");
    expect_near(tube.over(Direction::u, 0.0, 20.0).evaluate(std::array{7.0, 0.0})[2], 7.0, "a height over another domain");
}

int main()
try {
    check_fillets();
    check_curves();
    check_sections();
    check_surfaces();
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
