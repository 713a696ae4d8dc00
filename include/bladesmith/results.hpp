/**
 * What searches of Bladesmith's C++ interface give, as plain values. Included by bladesmith.hpp.
 */
#ifndef BLADESMITH_RESULTS_HPP
#define BLADESMITH_RESULTS_HPP

#include <bladesmith/core.hpp>

namespace bladesmith {

/** Rows of numbers that a search found. */
struct Table {
    std::size_t columns = 0;
    /** [rows][columns]. */
    std::vector<double> values;

    std::size_t rows() const noexcept { return columns == 0 ? 0 : values.size() / columns; }
    double operator()(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/** Nearest points: [n] or [n][2] parameters, [n][dimension] points, [n] distances. */
struct Nearest {
    std::vector<double> parameters, feet, distances;
};

/** First hits of rays: [n] lengths, [n] or [n][2] parameters, [n][dimension] points; NaN where a ray misses. */
struct FirstHits {
    std::vector<double> lengths, parameters, points;
};

/** What reshaping within a tolerance gives: the new shape, and a bound of how far it moved. */
template <class T> struct Moved {
    T shape;
    double by;
};

/** Where curves meet. */
struct Intersections {
    /** Rows t, s, x, y, z, distance, tangential (0 or 1). */
    Table crossings;
    /** Rows t0, t1, s0, s1 of stretches along which both are one. */
    Table overlaps;
};

namespace detail {

class OwnedTable : public Handle<bladesmith_table, bladesmith_table_free> {
public:
    template <class Make> explicit OwnedTable(Make make) : Handle(make) {}
    explicit OwnedTable(bladesmith_table *table) noexcept : Handle(table) {}

    Table values() const
    {
        std::size_t rows = 0;
        Table table;
        check(bladesmith_table_size(get(), &rows, &table.columns));
        table.values.resize(rows * table.columns);
        check(bladesmith_table_data(get(), rows, table.values.data()));
        return table;
    }
};

} // namespace detail

} // namespace bladesmith

#endif
