/**
 * Intersections of surfaces and projected curves for C++17, as plain values. Included by
 * bladesmith.hpp; Surface makes them.
 */
#ifndef BLADESMITH_SECTION_HPP
#define BLADESMITH_SECTION_HPP

#include <bladesmith/curve.hpp>

#include <optional>

namespace bladesmith {

/** One branch of an intersection. */
struct Branch {
    /** In space, over its length. */
    Curve curve;
    /** Its parameters on the surface, and on the other or in the plane. */
    std::array<Curve, 2> parameters;
    /** Whether the end is the start. */
    bool closed;
    /** Whether the surfaces touch along it rather than cross. */
    bool touching;
    /** How far from the true branch it was seen, mm. */
    double deviation;
};

/** Where a surface meets a plane or another surface. */
struct Section {
    std::vector<Branch> branches;
    /** Rows x, y, z, u, v, s, t, gap, crossing (0 or 1) of points in which the tangent planes agree. */
    Table touching;
    /** Rows u0, v0, u1, v1: where both are one. */
    Table overlaps;
    /** Rows u, v: around which the contact is too close to decide. */
    Table uncertain;
    /** Origin and unit vectors of a plane, [3][3], to which its parameters refer. */
    std::optional<std::array<double, 9>> axes;
};

/** A part of a curve on a surface. */
struct Projection {
    /** In space. */
    Curve curve;
    /** Its parameters on the surface. */
    Curve parameters;
    /** How far from the true projection it was seen, mm. */
    double deviation;
};

namespace detail {

class OwnedSection : public Handle<bladesmith_section, bladesmith_section_free> {
public:
    template <class Make> explicit OwnedSection(Make make) : Handle(make) {}

    std::vector<Branch> branches() const
    {
        bladesmith_curves *curves = nullptr, *first = nullptr, *second = nullptr;
        bladesmith_table *rows = nullptr;
        check(bladesmith_section_branches(get(), &curves, &first, &second, &rows));
        const OwnedCurves in_space(curves), on_first(first), on_second(second);
        const OwnedTable table(rows);
        std::vector<Curve> x = in_space.all(), a = on_first.all(), b = on_second.all();
        const Table what = table.values();
        std::vector<Branch> found;
        for (std::size_t i = 0; i < x.size(); i++)
            found.push_back({std::move(x[i]), {std::move(a[i]), std::move(b[i])}, what(i, 0) != 0, what(i, 1) != 0, what(i, 2)});
        return found;
    }

    Section all() const
    {
        bladesmith_table *touching = nullptr, *overlaps = nullptr, *uncertain = nullptr;
        check(bladesmith_section_contacts(get(), &touching, &overlaps, &uncertain));
        const OwnedTable points(touching), rectangles(overlaps), places(uncertain);
        return {branches(), points.values(), rectangles.values(), places.values(), std::nullopt};
    }

    Section all_in_plane() const
    {
        Section found = all();
        check(bladesmith_section_axes(get(), found.axes.emplace().data()));
        return found;
    }
};

} // namespace detail

} // namespace bladesmith

#endif
