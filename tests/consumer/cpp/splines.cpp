// The C++ owners of the kernel at work: splines
//
// Every method gives what its name says, checked against closed forms; wrong sizes are refused.

#include "expect.hpp"

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve, bladesmith::Direction, bladesmith::Error, bladesmith::Surface;

static_assert(!std::is_copy_constructible_v<Curve> && std::is_nothrow_move_constructible_v<Surface>);

static const double PI = std::acos(-1.0);

// A quarter of a circle of radius 2, and its length after each change that keeps it.
static void check_reshaping()
{
    const auto arc = Curve::arc(std::array{0.0, 0.0}, std::array{2.0, 0.0}, std::array{0.0, 2.0}, 0.0, PI / 2);
    const auto length = [](const Curve &curve) {
        const auto knots = curve.knots();
        return curve.lengths(std::array{knots.back()}).front();
    };
    expect(arc.dimension() == 2 && arc.degree() == 2 && arc.rational(), "sizes of an arc");
    expect(arc.poles().size() == 6 && arc.weights().size() == 3, "its arrays");
    const Curve again(2, 2, arc.knots(), arc.poles(), arc.weights());
    expect(again.poles() == arc.poles(), "a curve of the same arrays");
    const auto refined = arc.refined(std::array{0.25, 0.5});
    const auto pieces = refined.bezier_segments();
    expect(pieces.size() == 3, "three segments");
    const auto both = arc.part(0.0, 0.4).joined(arc.part(0.4, 1.0), 1e-9);
    for (const Curve *curve : {&refined, &both})
        expect_near(length(*curve), PI, "the length of the arc");
    expect_near(length(arc.elevated(2)), PI, "the length with a higher degree");
    expect_near(length(arc.elevated().reduced(1e-9).shape), PI, "and with a lower one");
    expect_near(length(refined.without_knot(0.5, 1, 1e-9).shape), PI, "without a knot");
    expect_near(length(arc.over(3.0, 5.0)), PI, "over another domain");
    expect_near(length(arc.reversed().clamped()), PI, "run backwards");
    const auto turned = arc.mapped({0, 0, 3, 1, 1, 0, 0, 0, 0, 1, 0, 0}, 3);
    expect(turned.dimension() == 3 && std::abs(turned.poles()[0] - 1.0) < 1e-15, "into space");
    expect_near(arc.at_lengths(std::array{PI / 2}).front(), 0.5, "the parameter of half the length");
    const auto frames = arc.frames(std::array{0.5});
    expect_near(frames.curvatures[0], 0.5, "the curvature");
    expect_near(frames.axes[2], -std::sqrt(0.5), "the normal");
    expect(arc.evaluate(std::array{0.0, 1.0}, 3, true).size() == 16, "derivatives up to the third");
}

static void check_fits()
{
    const std::vector<double> points{0, 0, 1, 1, 2, 0, 3, -1, 4, 0};
    const auto t = bladesmith::parameters(2, points);
    const auto through = Curve::interpolate(2, 3, t, points);
    expect_near(through.nearest(points).distances[3], 0.0, "the distance of an interpolated point");
    const auto knots = through.knots();
    const Curve::Samples samples{2, 3, knots, t, points};
    expect_near(Curve::fit(samples).evaluate(t)[2], 1.0, "a fit with as many poles as points");
    const auto fixed = Curve::fit({2, 2, std::array<double, 6>{0, 0, 0, 1, 1, 1}, t, points}, std::array{0.0, 1.0});
    expect_near(fixed.evaluate(std::array{0.0})[1], 1.0, "a fixed start");
    const auto smooth = Curve::smooth(samples, 1e6);
    expect(std::abs(smooth.evaluate(t)[2 * 1 + 1] + smooth.evaluate(t)[2 * 3 + 1]) < 1e-6, "nearly a straight line");
    expect_near(Curve::smooth_within(samples, 1e9).frames(std::array{0.5}).curvatures[0], 0.0, "smooth if anything may be");
    const auto conic = Curve::conic(std::array{1.0, 0.0}, std::array{1.0, 1.0}, std::array{0.0, 1.0}, std::sqrt(0.5));
    expect_near(conic.frames(std::array{0.3}).curvatures[0], 1.0, "a circle as a conic");
    const double at = std::sqrt(0.5);
    const auto same = Curve::conic(std::array{1.0, 0.0}, std::array{1.0, 1.0}, std::array{0.0, 1.0}, bladesmith::View<double>(std::array{at, at}));
    expect_near(same.weights()[1], at, "its weight from a point");
    std::vector<Curve> pair;
    pair.push_back(through.part(0.0, 0.5));
    pair.push_back(conic.part(0.0, 0.5));
    const auto alike = Curve::compatible(pair);
    expect(alike.size() == 2 && alike[0].knots() == alike[1].knots() && alike[1].degree() == 3, "compatible curves");
    const auto ties = Curve::arc(std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{0.0, 1.0}, 0.0, 2 * PI).nearest_all(std::array{2.0, 0.0});
    expect(ties.columns == 5 && ties.rows() >= 1, "a table");
    expect_near(ties(0, 4), 1.0, "its distance");
}

static Surface cone()
{
    const Curve line(3, 1, std::array{0.0, 0.0, 1.0, 1.0}, std::array{1.0, 0.0, 0.0, 2.0, 0.0, 1.0});
    return Surface::revolved(line, {0, 0, 0}, {0, 0, 1}, PI);
}

static void check_surfaces()
{
    const auto surface = cone();
    expect(surface.degrees() == std::array<std::uint32_t, 2>{1, 2} && surface.rational(), "sizes of a cone");
    expect(surface.pole_counts() == std::array<std::size_t, 2>{2, 5}, "its poles");
    const Surface again(surface.degrees(), surface.knots(Direction::u), surface.knots(Direction::v), surface.poles(), surface.weights());
    const std::vector<double> uv{0.5, 0.25, 0.75, 0.5};
    expect(again.evaluate(uv, 2) == surface.evaluate(uv, 2), "a surface of the same arrays");
    const auto bends = surface.curvatures(uv);
    expect_near(bends.curvatures[0] * bends.curvatures[1], 0.0, "the Gaussian curvature of a cone");
    const auto points = surface.evaluate(uv);
    for (const Surface &same : {surface.refined(Direction::v, std::array{0.3}), surface.elevated(Direction::u),
                                surface.elevated(Direction::u).reduced(Direction::u, 1e-9).shape,
                                surface.refined(Direction::u, std::array{0.3}).without_knot(Direction::u, 0.3, 1, 1e-9).shape,
                                surface.clamped(), surface.swapped().swapped(), surface.part(Direction::v, 0.1, 0.9),
                                surface.reversed(Direction::u).reversed(Direction::u),
                                surface.mapped({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})}) {
        const auto moved = same.evaluate(uv);
        for (std::size_t i = 0; i < points.size(); i++)
            expect_near(moved[i], points[i], "a coordinate after a change that keeps the surface");
    }
    expect_near(surface.isocurve(Direction::u, 0.5).lengths(std::array{1.0}).front(), 1.5 * PI, "the length of a parallel");
    expect_near(surface.nearest(points).distances[1], 0.0, "the distance of a point of it");
    expect(surface.nearest_all({0, 0, -5}).columns == 6, "a table");
}

static void check_making()
{
    const auto line = [](double x, double y, double z, double u, double v, double w) {
        return Curve(3, 1, std::array{0.0, 0.0, 1.0, 1.0}, std::array{x, y, z, u, v, w});
    };
    const auto low = line(0, 0, 0, 1, 0, 0), high = line(0, 1, 0, 1, 1, 1);
    const auto left = line(0, 0, 0, 0, 1, 0), right = line(1, 0, 0, 1, 1, 1);
    const auto patch = Surface::coons({&low, &high}, {&left, &right});
    const auto ruled = Surface::ruled(low, high);
    std::vector<Curve> sections;
    sections.push_back(line(0, 0, 0, 1, 0, 0));
    sections.push_back(line(0, 1, 0, 1, 1, 1));
    const auto skin = Surface::skin(sections, std::array{0.0, 1.0}, 1);
    for (const Surface *surface : {&patch, &ruled, &skin})
        expect_near(surface->evaluate(std::array{0.5, 0.5})[2], 0.25, "the middle of a twisted patch");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "parameters needs 2", [&] { Surface::skin(sections, std::array{0.0}, 1); });
}

static void check_meetings()
{
    const Curve first(2, 1, std::array{0.0, 0.0, 1.0, 1.0}, std::array{0.0, 0.0, 4.0, 4.0});
    const Curve second(2, 1, std::array{0.0, 0.0, 1.0, 1.0}, std::array{0.0, 2.0, 4.0, 2.0});
    const auto met = first.intersect(second, 1e-9);
    expect(met.crossings.rows() == 1 && met.overlaps.rows() == 0, "one crossing");
    expect_near(met.crossings(0, 0), 0.5, "the parameter of a crossing");
    expect(first.self_intersect(1e-9).crossings.rows() == 0, "a line without loops");
    expect_near(first.ray(std::array{3.0, 0.0}, std::array{0.0, 2.0}, 1e-9)(0, 0), 3.0, "the length of a ray");
    const auto offset = second.offset(1.0, 1e-6);
    expect(offset.curves.size() == 1 && offset.pieces.columns == 5, "one offset");
    expect_near(offset.curves[0].evaluate(std::array{offset.pieces(0, 1)})[1], 3.0, "the height of an offset");
    const auto surface = cone();
    const auto hits = surface.ray({0, 0.5, 0.5}, {1, 0, 0}, 1e-9, true);
    expect(hits.rows() == 2 && hits.columns == 10, "a line that meets a cone twice");
    expect(surface.offset(0.1, 1e-4).by <= 1e-4, "an offset within its tolerance");
}

static void check_errors()
{
    const auto surface = cone();
    expect_error(BLADESMITH_STATUS_ARGUMENT, "poles needs 2 numbers a point", [] { Curve(2, 1, std::array{0.0, 1.0}, std::array{1.0}); });
    expect_error(BLADESMITH_STATUS_SPLINE, "degree 0", [] { Curve(2, 0, std::array{0.0, 1.0}, std::array{1.0, 2.0}); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "'order': is 99", [&] { surface.evaluate(std::array{0.0, 0.0}, 99); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "uv needs 2", [&] { surface.evaluate(std::array{0.0}); });
    auto curve = surface.isocurve(Direction::v, 0.5);
    const auto other = std::move(curve);
    expect_error(BLADESMITH_STATUS_ARGUMENT, "'curve': is NULL", [&] { curve.degree(); });
    expect(other.degree() == 1, "a handle moves");
}

int main()
try {
    check_reshaping();
    check_fits();
    check_surfaces();
    check_making();
    check_meetings();
    check_errors();
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
