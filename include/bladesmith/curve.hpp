/**
 * NURBS curves for C++17: owners for the kernel's handles. Included by bladesmith.hpp.
 *
 * Arrays are flat: n points are 2 n or 3 n numbers, poles of surfaces run along v first, and a
 * knot vector holds every knot as often as it stands there. Units, shapes and what each function
 * throws are those of bladesmith.h. Curves and surfaces never change: what reshapes gives a new one.
 */
#ifndef BLADESMITH_CURVE_HPP
#define BLADESMITH_CURVE_HPP

#include <bladesmith/results.hpp>

#include <array>

namespace bladesmith {

class Curve;

/** An offset: its curves, and rows curve, from, to, source_from, source_to of their pieces. */
struct CurveOffset {
    std::vector<Curve> curves;
    Table pieces;
};

namespace detail {

class OwnedCurves : public Handle<bladesmith_curves, bladesmith_curves_free> {
public:
    template <class Make> explicit OwnedCurves(Make make) : Handle(make) {}
    explicit OwnedCurves(bladesmith_curves *curves) noexcept : Handle(curves) {}

    std::vector<Curve> all() const;
};

} // namespace detail

/** A NURBS curve in the plane (dimension 2) or in space (3). */
class Curve : public detail::Handle<bladesmith_curve, bladesmith_curve_free> {
public:
    /** From all knots, poles [n][dimension] and, if rational, weights [n]. */
    Curve(std::uint32_t dimension, std::uint32_t degree, View<double> knots, View<double> poles, View<double> weights = {})
        : Handle([&](bladesmith_curve **out) {
              const std::size_t n = detail::points_in(poles, dimension == 2 ? 2 : 3, "poles");
              if (weights.size() > 0)
                  detail::require(weights, n, "weights");
              return bladesmith_curve_new(dimension, degree, knots.data(), knots.size(), poles.data(),
                                          weights.size() > 0 ? weights.data() : nullptr, n, out);
          })
    {
    }

    /** The closed curve, smooth over its seam, with poles [breaks - 1][dimension], each once. */
    static Curve periodic(std::uint32_t dimension, std::uint32_t degree, View<double> breaks, View<double> poles,
                          View<double> weights = {})
    {
        const std::size_t n = breaks.size() > 0 ? breaks.size() - 1 : 0;
        detail::require(poles, dimension * n, "poles");
        if (weights.size() > 0)
            detail::require(weights, n, "weights");
        return made([&](auto out) {
            return bladesmith_curve_periodic(dimension, degree, breaks.data(), breaks.size(), poles.data(),
                                             weights.size() > 0 ? weights.data() : nullptr, out);
        });
    }

    /** The arc centre + x cos a + y sin a for angles (rad) from one to another. */
    static Curve arc(View<double> centre, View<double> x, View<double> y, double from, double to)
    {
        const auto dimension = static_cast<std::uint32_t>(centre.size());
        detail::require(x, dimension, "x");
        detail::require(y, dimension, "y");
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_arc(dimension, centre.data(), x.data(), y.data(), from, to, out);
        });
    }

    /** The conic tangent to the legs of a corner: below weight 1 an ellipse, above a hyperbola. */
    static Curve conic(View<double> start, View<double> corner, View<double> end, double weight)
    {
        return conic(start, corner, end, nullptr, weight);
    }

    /** The conic tangent to the legs of a corner that passes a point inside the triangle. */
    static Curve conic(View<double> start, View<double> corner, View<double> end, View<double> through)
    {
        detail::require(through, start.size(), "through");
        return conic(start, corner, end, through.data(), 0.0);
    }

    /**
     * The curve with values [n][dimension] at parameters [n]; `orders` [n] tells which derivative
     * each is, none: points. Without knots means of neighbouring parameters are used.
     */
    static Curve interpolate(std::uint32_t dimension, std::uint32_t degree, View<double> parameters,
                             View<double> values, View<std::uint32_t> orders = {}, View<double> knots = {})
    {
        detail::require(values, dimension * parameters.size(), "values");
        if (orders.size() > 0 && orders.size() != parameters.size())
            detail::refuse("orders needs as many numbers as parameters");
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_interpolate(dimension, degree, parameters.data(), orders.size() > 0 ? orders.data() : nullptr,
                                                values.data(), parameters.size(), knots.size() > 0 ? knots.data() : nullptr,
                                                knots.size(), out);
        });
    }

    /** The closed curve, smooth at its seam, through points [n][dimension] at parameters [n + 1]. */
    static Curve interpolate_closed(std::uint32_t dimension, std::uint32_t degree, View<double> parameters,
                                    View<double> points)
    {
        const std::size_t count = parameters.size() > 0 ? parameters.size() - 1 : 0;
        detail::require(points, dimension * count, "points");
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_interpolate_closed(dimension, degree, parameters.data(), points.data(), count, out);
        });
    }

    /** Points near which a curve over given knots shall run; the arrays must outlive it. */
    struct Samples {
        std::uint32_t dimension, degree;
        View<double> knots;
        /** [n]. */
        View<double> parameters;
        /** [n][dimension]. */
        View<double> points;
        /** [n], or empty for 1 each. */
        View<double> weights = {};
    };

    /** The weighted least squares curve; at its ends point, first derivative ... as given. */
    static Curve fit(const Samples &s, View<double> start = {}, View<double> end = {})
    {
        check(s);
        const std::size_t dimension = s.dimension == 2 ? 2 : 3;
        const std::size_t at_start = detail::points_in(start, dimension, "start");
        const std::size_t at_end = detail::points_in(end, dimension, "end");
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_fit(s.dimension, s.degree, s.knots.data(), s.knots.size(), s.parameters.data(),
                                        s.points.data(), weights_of(s), s.parameters.size(), start.data(), at_start,
                                        end.data(), at_end, out);
        });
    }

    /** Least squares plus `smoothing` times the integral of the squared second derivative. */
    static Curve smooth(const Samples &s, double smoothing)
    {
        check(s);
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_smooth(s.dimension, s.degree, s.knots.data(), s.knots.size(), s.parameters.data(),
                                           s.points.data(), weights_of(s), s.parameters.size(), smoothing, out);
        });
    }

    /** The smoothest curve whose weighted squared distances sum up to no more than `residual`. */
    static Curve smooth_within(const Samples &s, double residual)
    {
        check(s);
        return Curve([&](bladesmith_curve **out) {
            return bladesmith_curve_smooth_within(s.dimension, s.degree, s.knots.data(), s.knots.size(), s.parameters.data(),
                                                  s.points.data(), weights_of(s), s.parameters.size(), residual, nullptr, out);
        });
    }

    /** The same curves with one degree, one domain (the first's) and the same clamped knots. */
    static std::vector<Curve> compatible(View<Curve> curves)
    {
        const auto handles = handles_of(curves);
        return detail::OwnedCurves([&](bladesmith_curves **out) {
                   return bladesmith_curves_compatible(handles.data(), handles.size(), out);
               }).all();
    }

    std::uint32_t dimension() const { return size().dimension; }
    std::uint32_t degree() const { return size().degree; }
    bool rational() const { return size().rational != 0; }
    /** All knots. */
    std::vector<double> knots() const { return std::move(data()[0]); }
    /** [n][dimension]. */
    std::vector<double> poles() const { return std::move(data()[1]); }
    /** [n], all 1 for a polynomial curve. */
    std::vector<double> weights() const { return std::move(data()[2]); }

    /** First and last parameter. */
    std::array<double, 2> domain() const
    {
        const auto all = knots();
        const std::uint32_t p = degree();
        return {all[p], all[all.size() - 1 - p]};
    }

    /** [n][order + 1][dimension] at t [n]; `below`: from smaller parameters where derivatives jump. */
    std::vector<double> evaluate(View<double> t, std::uint32_t order = 0, bool below = false) const
    {
        std::vector<double> out(t.size() * (order + 1) * dimension());
        detail::check(bladesmith_curve_evaluate(get(), t.data(), t.size(), order, below, out.data()));
        return out;
    }

    /** Tangent, normal and binormal [n][dimension][dimension], curvatures [n], torsions [n]. */
    struct Frames {
        std::vector<double> axes, curvatures, torsions;
    };

    Frames frames(View<double> t) const
    {
        const std::size_t n = t.size(), d = dimension();
        Frames out{std::vector<double>(n * d * d), std::vector<double>(n), std::vector<double>(n)};
        detail::check(bladesmith_curve_frames(get(), t.data(), n, out.axes.data(), out.curvatures.data(), out.torsions.data()));
        return out;
    }

    /** Arc lengths from the start to t [n], to a tolerance in mm. */
    std::vector<double> lengths(View<double> t, double tolerance = 1e-9) const
    {
        std::vector<double> out(t.size());
        detail::check(bladesmith_curve_lengths(get(), tolerance, t.data(), t.size(), out.data()));
        return out;
    }

    /** The whole arc length, to a tolerance in mm. */
    double length(double tolerance = 1e-9) const { return lengths(std::array{domain()[1]}, tolerance).front(); }

    /** Parameters at arc lengths from the start. */
    std::vector<double> at_lengths(View<double> lengths, double tolerance = 1e-9) const
    {
        std::vector<double> out(lengths.size());
        detail::check(bladesmith_curve_at_lengths(get(), tolerance, lengths.data(), lengths.size(), out.data()));
        return out;
    }

    /** With knots, ascending, inserted. */
    Curve refined(View<double> knots) const
    {
        return made([&](auto out) { return bladesmith_curve_refine(get(), knots.data(), knots.size(), out); });
    }

    /** With a knot removed as often as the tolerance (mm) allows. */
    Moved<Curve> without_knot(double t, std::uint32_t times, double tolerance) const
    {
        double by = 0.0;
        Curve curve = made([&](auto out) { return bladesmith_curve_remove_knot(get(), t, times, tolerance, &by, out); });
        return {std::move(curve), by};
    }

    Curve elevated(std::uint32_t by = 1) const
    {
        return made([&](auto out) { return bladesmith_curve_elevate(get(), by, out); });
    }

    /** With the degree lower by one, where the tolerance (mm) allows. */
    Moved<Curve> reduced(double tolerance) const
    {
        double by = 0.0;
        Curve curve = made([&](auto out) { return bladesmith_curve_reduce(get(), tolerance, &by, out); });
        return {std::move(curve), by};
    }

    Curve part(double from, double to) const
    {
        return made([&](auto out) { return bladesmith_curve_part(get(), from, to, out); });
    }

    Curve reversed() const
    {
        return made([&](auto out) { return bladesmith_curve_reverse(get(), out); });
    }

    /** Over another domain. */
    Curve over(double from, double to) const
    {
        return made([&](auto out) { return bladesmith_curve_over(get(), from, to, out); });
    }

    Curve clamped() const
    {
        return made([&](auto out) { return bladesmith_curve_clamp(get(), out); });
    }

    /** Under an affine map [3][4]; in the plane z is 0, and dimension 2 leaves it out. */
    Curve mapped(const std::array<double, 12> &matrix, std::uint32_t dimension) const
    {
        return made([&](auto out) { return bladesmith_curve_map(get(), matrix.data(), dimension, out); });
    }

    /** With another behind it, whose start may be `gap` mm away. */
    Curve joined(const Curve &next, double gap, bool smooth = false) const
    {
        return made([&](auto out) { return bladesmith_curve_join(get(), next.get(), gap, smooth, out); });
    }

    std::vector<Curve> bezier_segments() const
    {
        return detail::OwnedCurves([&](bladesmith_curves **out) { return bladesmith_curve_bezier(get(), out); }).all();
    }

    /** The global nearest points to points [n][dimension]. */
    Nearest nearest(View<double> points) const
    {
        const std::size_t n = detail::points_in(points, dimension(), "points");
        Nearest out{std::vector<double>(n), std::vector<double>(points.size()), std::vector<double>(n)};
        detail::check(bladesmith_curve_nearest(get(), points.data(), n, out.parameters.data(), out.feet.data(), out.distances.data()));
        return out;
    }

    /** Rows t, x, y, z, distance of all points as near as the nearest to within `tie` mm. */
    Table nearest_all(View<double> point, double tie = 1e-9) const
    {
        detail::require(point, dimension(), "point");
        return detail::OwnedTable([&](bladesmith_table **out) {
                   return bladesmith_curve_nearest_all(get(), point.data(), tie, out);
               }).values();
    }

    /** The handles of several curves, for calls of bladesmith.h. */
    static std::vector<const bladesmith_curve *> handles_of(View<Curve> curves)
    {
        std::vector<const bladesmith_curve *> handles;
        for (std::size_t i = 0; i < curves.size(); i++)
            handles.push_back(curves.data()[i].get());
        return handles;
    }

    /** Where it is not further than `tolerance` from another. */
    Intersections intersect(const Curve &other, double tolerance) const
    {
        return intersections([&](auto crossings, auto overlaps) {
            return bladesmith_curve_intersect(get(), other.get(), tolerance, crossings, overlaps);
        });
    }

    /** Where it passes a place twice. */
    Intersections self_intersect(double tolerance) const
    {
        return intersections([&](auto crossings, auto overlaps) {
            return bladesmith_curve_self_intersect(get(), tolerance, crossings, overlaps);
        });
    }

    /** Rows length, from, to, t, x, y, z, distance, tangential of where a ray, or a line, meets it. */
    Table ray(View<double> origin, View<double> direction, double tolerance, bool both = false) const
    {
        detail::require(origin, dimension(), "origin");
        detail::require(direction, dimension(), "direction");
        return detail::OwnedTable([&](bladesmith_table **out) {
                   return bladesmith_curve_ray(get(), origin.data(), direction.data(), both, tolerance, out);
               }).values();
    }

    /** Where rays with origins and directions [n][dimension] first meet it. */
    FirstHits first_hits(View<double> origins, View<double> directions, double tolerance) const
    {
        const std::size_t n = detail::points_in(origins, dimension(), "origins");
        detail::require(directions, origins.size(), "directions");
        FirstHits out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(origins.size())};
        detail::check(bladesmith_curve_first_hits(get(), origins.data(), directions.data(), n, tolerance, out.lengths.data(),
                                                  out.parameters.data(), out.points.data()));
        return out;
    }

    /** The trimmed offset; around outward corners arcs, or lines up to `limit` times the distance. */
    CurveOffset offset(double distance, double tolerance, double limit = 0.0) const
    {
        return moved(bladesmith_curve_offset, distance, tolerance, limit);
    }

    /** The whole offset, loops and all. */
    CurveOffset offset_raw(double distance, double tolerance, double limit = 0.0) const
    {
        return moved(bladesmith_curve_offset_raw, distance, tolerance, limit);
    }

    /** Parameters mapped to those that have a point in an offset, by its pieces. */
    std::vector<double> offset_map(const Table &pieces, View<double> t) const
    {
        if (pieces.columns != 5)
            detail::refuse("pieces needs the 5 columns of an offset");
        std::vector<double> out(t.size());
        detail::check(bladesmith_curve_offset_map(get(), pieces.values.data(), pieces.rows(), t.data(), t.size(), out.data()));
        return out;
    }

private:
    using Handle::Handle;
    friend class Surface;
    friend class detail::OwnedCurves;

    struct Size {
        std::uint32_t dimension = 0, degree = 0, rational = 0;
        std::size_t poles = 0;
    };

    template <class Call> static Curve made(Call call)
    {
        return Curve([&](bladesmith_curve **out) { return call(out); });
    }

    static void check(const Samples &s)
    {
        detail::require(s.points, s.dimension * s.parameters.size(), "points");
        if (s.weights.size() > 0)
            detail::require(s.weights, s.parameters.size(), "weights");
    }

    static const double *weights_of(const Samples &s) { return s.weights.size() > 0 ? s.weights.data() : nullptr; }

    static Curve conic(View<double> start, View<double> corner, View<double> end, const double *through, double weight)
    {
        detail::require(corner, start.size(), "corner");
        detail::require(end, start.size(), "end");
        return made([&](auto out) {
            return bladesmith_curve_conic(static_cast<std::uint32_t>(start.size()), start.data(), corner.data(), end.data(),
                                          through, weight, out);
        });
    }

    template <class Call> static Intersections intersections(Call call)
    {
        bladesmith_table *crossings = nullptr, *overlaps = nullptr;
        detail::check(call(&crossings, &overlaps));
        const detail::OwnedTable points(crossings), stretches(overlaps);
        return {points.values(), stretches.values()};
    }

    template <class Call> CurveOffset moved(Call call, double distance, double tolerance, double limit) const
    {
        bladesmith_curves *curves = nullptr;
        bladesmith_table *pieces = nullptr;
        detail::check(call(get(), distance, tolerance, limit, &curves, &pieces));
        const detail::OwnedCurves list(curves);
        const detail::OwnedTable table(pieces);
        return {list.all(), table.values()};
    }

    Size size() const
    {
        Size size;
        detail::check(bladesmith_curve_size(get(), &size.dimension, &size.degree, &size.poles, &size.rational));
        return size;
    }

    /** Knots, poles and weights. */
    std::array<std::vector<double>, 3> data() const
    {
        const Size s = size();
        std::array<std::vector<double>, 3> out{std::vector<double>(s.poles + s.degree + 1),
                                               std::vector<double>(s.poles * s.dimension), std::vector<double>(s.poles)};
        detail::check(bladesmith_curve_data(get(), s.poles, out[0].data(), out[1].data(), out[2].data()));
        return out;
    }
};

inline std::vector<Curve> detail::OwnedCurves::all() const
{
    std::size_t count = 0;
    check(bladesmith_curves_count(get(), &count));
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < count; i++)
        curves.push_back(Curve([&](bladesmith_curve **out) { return bladesmith_curves_get(get(), i, out); }));
    return curves;
}

/** How parameters() spaces: see bladesmith_spacing; `factor` counts for two of them. */
inline std::vector<double> parameters(std::uint32_t dimension, View<double> points, bladesmith_spacing spacing = BLADESMITH_SPACING_CHORD,
                                      double factor = 0.5)
{
    std::vector<double> out(detail::points_in(points, dimension == 2 ? 2 : 3, "points"));
    detail::check(bladesmith_parameters(dimension, points.data(), out.size(), spacing, factor, out.data()));
    return out;
}

/** Clamped knots for a curve through points at ascending parameters: means of neighbours. */
inline std::vector<double> averaged_knots(std::uint32_t degree, View<double> parameters)
{
    std::vector<double> out(parameters.size() + degree + 1);
    detail::check(bladesmith_averaged_knots(degree, parameters.data(), parameters.size(), out.data()));
    return out;
}

} // namespace bladesmith

#endif
