/**
 * NURBS surfaces for C++17: the owner of the kernel's handle. Included by bladesmith.hpp.
 *
 * As curve.hpp. Poles are [n][m][3], the second index along v.
 */
#ifndef BLADESMITH_SURFACE_HPP
#define BLADESMITH_SURFACE_HPP

#include <bladesmith/section.hpp>

namespace bladesmith {

class Surface;

namespace detail {

class OwnedSurfaces : public Handle<bladesmith_surfaces, bladesmith_surfaces_free> {
public:
    template <class Make> explicit OwnedSurfaces(Make make) : Handle(make) {}

    std::vector<Surface> all() const;
};

} // namespace detail

/** Direction of a surface's parameter. */
enum class Direction : std::uint32_t { u = 0, v = 1 };

/** A NURBS surface in space. */
class Surface : public detail::Handle<bladesmith_surface, bladesmith_surface_free> {
public:
    /** From all knots along u and v, poles [n][m][3] and, if rational, weights [n][m]. */
    Surface(std::array<std::uint32_t, 2> degrees, View<double> knots_u, View<double> knots_v, View<double> poles,
            View<double> weights = {})
        : Handle([&](bladesmith_surface **out) {
              const std::size_t n = detail::points_in(poles, 3, "poles");
              if (weights.size() > 0)
                  detail::require(weights, n, "weights");
              return bladesmith_surface_new(degrees[0], degrees[1], knots_u.data(), knots_u.size(), knots_v.data(), knots_v.size(),
                                            poles.data(), weights.size() > 0 ? weights.data() : nullptr, n, out);
          })
    {
    }

    /** Of the lines between points of two curves at equal parameters. */
    static Surface ruled(const Curve &first, const Curve &second)
    {
        return made([&](auto out) { return bladesmith_surface_ruled(first.get(), second.get(), out); });
    }

    /** What a curve sweeps when it turns about an axis, by an angle in rad. */
    static Surface revolved(const Curve &curve, const std::array<double, 3> &origin, const std::array<double, 3> &axis, double angle)
    {
        return made([&](auto out) { return bladesmith_surface_revolved(curve.get(), origin.data(), axis.data(), angle, out); });
    }

    /** The patch between curves along u (at both ends of v) and along v (at both ends of u). */
    static Surface coons(const std::array<const Curve *, 2> &along_u, const std::array<const Curve *, 2> &along_v)
    {
        const bladesmith_curve *const curves[] = {along_u[0]->get(), along_u[1]->get(), along_v[0]->get(), along_v[1]->get()};
        return made([&](auto out) { return bladesmith_surface_coons(curves, out); });
    }

    /** Through sections, which it holds at ascending parameters of v. */
    static Surface skin(View<Curve> sections, View<double> parameters, std::uint32_t degree = 3)
    {
        detail::require(parameters, sections.size(), "parameters");
        const auto handles = Curve::handles_of(sections);
        return made([&](auto out) { return bladesmith_surface_skin(handles.data(), parameters.data(), handles.size(), degree, out); });
    }

    std::array<std::uint32_t, 2> degrees() const { return size().degrees; }
    /** Poles along u and v. */
    std::array<std::size_t, 2> pole_counts() const { return size().poles; }
    bool rational() const { return size().rational != 0; }
    /** All knots along a direction. */
    std::vector<double> knots(Direction direction) const { return std::move(data()[static_cast<std::size_t>(direction)]); }
    /** [n][m][3]. */
    std::vector<double> poles() const { return std::move(data()[2]); }
    /** [n][m], all 1 for a polynomial surface. */
    std::vector<double> weights() const { return std::move(data()[3]); }

    /** [n][(order + 1) (order + 2) / 2][3] at uv [n][2]: S; S_u, S_v; S_uu, S_uv, S_vv ... */
    std::vector<double> evaluate(View<double> uv, std::uint32_t order = 0, bool below_u = false, bool below_v = false) const
    {
        const std::size_t n = detail::points_in(uv, 2, "uv");
        std::vector<double> out(n * (order + 1) * (order + 2) / 2 * 3);
        detail::check(bladesmith_surface_evaluate(get(), uv.data(), n, order, below_u, below_v, out.data()));
        return out;
    }

    /** As evaluate() on the grid u x v, v fastest; the order is at most 2. */
    std::vector<double> evaluate_grid(View<double> u, View<double> v, std::uint32_t order = 0) const
    {
        std::vector<double> out(u.size() * v.size() * (order + 1) * (order + 2) / 2 * 3);
        detail::check(bladesmith_surface_evaluate_grid(get(), u.data(), u.size(), v.data(), v.size(), order, out.data()));
        return out;
    }

    /** Unit normals [n][3], principal curvatures [n][2], ascending, and directions [n][2][3]. */
    struct Curvatures {
        std::vector<double> normals, curvatures, directions;
    };

    Curvatures curvatures(View<double> uv) const
    {
        const std::size_t n = detail::points_in(uv, 2, "uv");
        Curvatures out{std::vector<double>(3 * n), std::vector<double>(2 * n), std::vector<double>(6 * n)};
        detail::check(bladesmith_surface_curvatures(get(), uv.data(), n, out.normals.data(), out.curvatures.data(), out.directions.data()));
        return out;
    }

    /** With knots, ascending, inserted. */
    Surface refined(Direction direction, View<double> knots) const
    {
        return made([&](auto out) { return bladesmith_surface_refine(get(), number(direction), knots.data(), knots.size(), out); });
    }

    /** With a knot removed as often as the tolerance (mm) allows. */
    Moved<Surface> without_knot(Direction direction, double t, std::uint32_t times, double tolerance) const
    {
        double by = 0.0;
        Surface surface = made([&](auto out) {
            return bladesmith_surface_remove_knot(get(), number(direction), t, times, tolerance, &by, out);
        });
        return {std::move(surface), by};
    }

    Surface elevated(Direction direction, std::uint32_t by = 1) const
    {
        return made([&](auto out) { return bladesmith_surface_elevate(get(), number(direction), by, out); });
    }

    /** With the degree lower by one, where the tolerance (mm) allows. */
    Moved<Surface> reduced(Direction direction, double tolerance) const
    {
        double by = 0.0;
        Surface surface = made([&](auto out) { return bladesmith_surface_reduce(get(), number(direction), tolerance, &by, out); });
        return {std::move(surface), by};
    }

    Surface part(Direction direction, double from, double to) const
    {
        return made([&](auto out) { return bladesmith_surface_part(get(), number(direction), from, to, out); });
    }

    Surface reversed(Direction direction) const
    {
        return made([&](auto out) { return bladesmith_surface_reverse(get(), number(direction), out); });
    }

    /** Over another domain along a direction. */
    Surface over(Direction direction, double from, double to) const
    {
        return made([&](auto out) { return bladesmith_surface_over(get(), number(direction), from, to, out); });
    }

    /** Between neighbouring knots, those along v next to each other. */
    std::vector<Surface> bezier_patches() const
    {
        return detail::OwnedSurfaces([&](bladesmith_surfaces **out) { return bladesmith_surface_bezier(get(), out); }).all();
    }

    /** With u and v exchanged. */
    Surface swapped() const
    {
        return made([&](auto out) { return bladesmith_surface_swap(get(), out); });
    }

    Surface clamped() const
    {
        return made([&](auto out) { return bladesmith_surface_clamp(get(), out); });
    }

    /** Under an affine map [3][4]. */
    Surface mapped(const std::array<double, 12> &matrix) const
    {
        return made([&](auto out) { return bladesmith_surface_map(get(), matrix.data(), out); });
    }

    /** The curve along which the parameter of a direction is t. */
    Curve isocurve(Direction direction, double t) const
    {
        return Curve::made([&](auto out) { return bladesmith_surface_isocurve(get(), number(direction), t, out); });
    }

    /** The global nearest points to points [n][3]; parameters are [n][2]. */
    Nearest nearest(View<double> points) const
    {
        const std::size_t n = detail::points_in(points, 3, "points");
        Nearest out{std::vector<double>(2 * n), std::vector<double>(3 * n), std::vector<double>(n)};
        detail::check(bladesmith_surface_nearest(get(), points.data(), n, out.parameters.data(), out.feet.data(), out.distances.data()));
        return out;
    }

    /** Rows u, v, x, y, z, distance of all points as near as the nearest to within `tie` mm. */
    Table nearest_all(const std::array<double, 3> &point, double tie = 1e-9) const
    {
        return detail::OwnedTable([&](bladesmith_table **out) {
                   return bladesmith_surface_nearest_all(get(), point.data(), tie, out);
               }).values();
    }

    /** Rows length, from, to, u, v, x, y, z, distance, tangential of where a ray, or a line, meets it. */
    Table ray(const std::array<double, 3> &origin, const std::array<double, 3> &direction, double tolerance,
              bool both = false) const
    {
        return detail::OwnedTable([&](bladesmith_table **out) {
                   return bladesmith_surface_ray(get(), origin.data(), direction.data(), both, tolerance, out);
               }).values();
    }

    /** Where rays with origins and directions [n][3] first meet it; parameters are [n][2]. */
    FirstHits first_hits(View<double> origins, View<double> directions, double tolerance) const
    {
        const std::size_t n = detail::points_in(origins, 3, "origins");
        detail::require(directions, origins.size(), "directions");
        FirstHits out{std::vector<double>(n), std::vector<double>(2 * n), std::vector<double>(3 * n)};
        detail::check(bladesmith_surface_first_hits(get(), origins.data(), directions.data(), n, tolerance, out.lengths.data(),
                                                    out.parameters.data(), out.points.data()));
        return out;
    }

    /** Where it meets the plane through a point across a direction. */
    Section section(const std::array<double, 3> &origin, const std::array<double, 3> &normal, double tolerance) const
    {
        return detail::OwnedSection([&](bladesmith_section **out) {
                   return bladesmith_surface_section(get(), origin.data(), normal.data(), tolerance, out);
               }).all_in_plane();
    }

    /** Where it meets another surface. */
    Section intersect(const Surface &other, double tolerance) const
    {
        return detail::OwnedSection([&](bladesmith_section **out) {
                   return bladesmith_surface_intersect(get(), other.get(), tolerance, out);
               }).all();
    }

    /** A curve in space projected to its nearest points. */
    std::vector<Projection> project(const Curve &curve, double tolerance) const
    {
        return projected(curve, nullptr, tolerance);
    }

    /** A curve in space projected along a direction. */
    std::vector<Projection> project(const Curve &curve, const std::array<double, 3> &direction, double tolerance) const
    {
        return projected(curve, direction.data(), tolerance);
    }

    /** The offset along the normals, and how far it is from the true one at equal parameters. */
    Moved<Surface> offset(double distance, double tolerance) const
    {
        double deviation = 0.0;
        Surface shape = made([&](auto out) { return bladesmith_surface_offset(get(), distance, tolerance, &deviation, out); });
        return {std::move(shape), deviation};
    }

private:
    using Handle::Handle;
    friend class detail::OwnedSurfaces;

    struct Size {
        std::array<std::uint32_t, 2> degrees{};
        std::array<std::size_t, 2> poles{};
        std::uint32_t rational = 0;
    };

    template <class Call> static Surface made(Call call)
    {
        return Surface([&](bladesmith_surface **out) { return call(out); });
    }

    static std::uint32_t number(Direction direction) { return static_cast<std::uint32_t>(direction); }

    std::vector<Projection> projected(const Curve &curve, const double *direction, double tolerance) const
    {
        bladesmith_curves *curves = nullptr, *parameters = nullptr;
        bladesmith_table *deviations = nullptr;
        detail::check(bladesmith_surface_project(get(), curve.get(), direction, tolerance, &curves, &parameters, &deviations));
        const detail::OwnedCurves in_space(curves), on_surface(parameters);
        const detail::OwnedTable table(deviations);
        std::vector<Curve> x = in_space.all(), uv = on_surface.all();
        const Table off = table.values();
        std::vector<Projection> parts;
        for (std::size_t i = 0; i < x.size(); i++)
            parts.push_back({std::move(x[i]), std::move(uv[i]), off(i, 0)});
        return parts;
    }

    Size size() const
    {
        Size size;
        detail::check(bladesmith_surface_size(get(), &size.degrees[0], &size.degrees[1], &size.poles[0], &size.poles[1], &size.rational));
        return size;
    }

    /** Knots along u and v, poles and weights. */
    std::array<std::vector<double>, 4> data() const
    {
        const Size s = size();
        const std::size_t n = s.poles[0] * s.poles[1];
        std::array<std::vector<double>, 4> out{std::vector<double>(s.poles[0] + s.degrees[0] + 1),
                                               std::vector<double>(s.poles[1] + s.degrees[1] + 1), std::vector<double>(3 * n),
                                               std::vector<double>(n)};
        detail::check(bladesmith_surface_data(get(), n, out[0].data(), out[1].data(), out[2].data(), out[3].data()));
        return out;
    }
};

inline std::vector<Surface> detail::OwnedSurfaces::all() const
{
    std::size_t count = 0;
    check(bladesmith_surfaces_count(get(), &count));
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i < count; i++)
        surfaces.push_back(Surface([&](bladesmith_surface **out) { return bladesmith_surfaces_get(get(), i, out); }));
    return surfaces;
}

} // namespace bladesmith

#endif
