/**
 * Fillets between planar curves for C++17. Included by bladesmith.hpp.
 */
#ifndef BLADESMITH_FILLET_HPP
#define BLADESMITH_FILLET_HPP

#include <bladesmith/curve.hpp>

#include <optional>

namespace bladesmith {

/** A circular arc tangent to two curves. */
struct Fillet {
    std::array<double, 2> centre;
    /** Of the points of contact on both curves. */
    std::array<double, 2> parameters;
    /** 1 where the centre is to the left of the curve, -1 to the right. */
    std::array<double, 2> sides;
    /** From the first curve to the second, in rad, positive to the left. */
    double angle;
    /** What is left of the first curve, the arc, what is left of the second: none where nothing is. */
    std::optional<Curve> first, arc, second;
};

namespace detail {

/** Fillets as `call(curves, table)` gives them. */
template <class Call> std::vector<Fillet> fillets(Call call)
{
    bladesmith_curves *curves = nullptr;
    bladesmith_table *rows = nullptr;
    check(call(&curves, &rows));
    const OwnedCurves list(curves);
    const Table table = OwnedTable(rows).values();
    std::vector<Curve> all = list.all();
    std::vector<Fillet> found;
    for (std::size_t i = 0; i < table.rows(); i++) {
        const auto at = [&](std::size_t column) { return table(i, column); };
        const auto curve = [&](std::size_t column) -> std::optional<Curve> {
            if (at(column) < 0)
                return std::nullopt;
            return std::move(all[static_cast<std::size_t>(at(column))]);
        };
        found.push_back({{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}, at(6), curve(7), curve(8), curve(9)});
    }
    return found;
}

/** The only one, if there is one. */
inline std::optional<Fillet> only(std::vector<Fillet> found)
{
    if (found.empty())
        return std::nullopt;
    return std::move(found.front());
}

} // namespace detail

/** All fillets of a radius on all sides of two curves in the plane, none of which cuts into them. */
inline std::vector<Fillet> fillets(const Curve &first, const Curve &second, double radius, double tolerance)
{
    return detail::fillets([&](auto curves, auto table) {
        return bladesmith_curve_fillets(first.get(), second.get(), radius, tolerance, curves, table);
    });
}

/** The fillet that rounds the corner at which ends of both curves meet, if there is one. */
inline std::optional<Fillet> fillet(const Curve &first, const Curve &second, double radius, double tolerance)
{
    return detail::only(detail::fillets([&](auto curves, auto table) {
        return bladesmith_curve_fillet(first.get(), second.get(), radius, tolerance, nullptr, curves, table);
    }));
}

/** The fillet with its centre nearest to a point, if there is one. */
inline std::optional<Fillet> fillet(const Curve &first, const Curve &second, double radius, double tolerance,
                                    const std::array<double, 2> &near)
{
    return detail::only(detail::fillets([&](auto curves, auto table) {
        return bladesmith_curve_fillet(first.get(), second.get(), radius, tolerance, near.data(), curves, table);
    }));
}

} // namespace bladesmith

#endif
