/**
 * Bladesmith for C++17: owners for the handles of bladesmith.h, exceptions for its statuses.
 *
 * Units, numbering, shapes and threads are those of bladesmith.h: mm; solids and faces from 1;
 * [n][3] is n times x y z in one array; handles never change once made, so many threads may read
 * one at once. Header only; link with bladesmith::bladesmith or bladesmith::static.
 *
 * Owners (Field, Part, Morphed; Curve and Surface in files of their own) can be moved, not copied, and free
 * their handle with themselves.
 * Every function that can fail throws Error, which carries the status and the library's message;
 * one that was moved from is refused like NULL. Nothing thrown crosses the C interface.
 */
#ifndef BLADESMITH_HPP
#define BLADESMITH_HPP

#include <bladesmith/core.hpp>
#include <bladesmith/fillet.hpp>
#include <bladesmith/surface.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace bladesmith {

/**
 * Hears of the stage (English) and the fraction of the work done, from 0 to 1, on the thread that
 * started the work; returns true to go on, false to cancel. What it throws comes out of the call
 * that it follows.
 */
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/** Settings of a morph; they start with the library's defaults. */
struct Options {
    /** Takes the defaults from the library. */
    Options()
    {
        bladesmith_morph_options defaults;
        bladesmith_morph_options_init(&defaults, sizeof defaults);
        factor = defaults.factor;
        tolerance_mm = defaults.tolerance_mm;
        match_tolerance_mm = defaults.match_tolerance_mm;
        field_unit_mm = defaults.field_unit_mm;
        displacement_scale = defaults.displacement_scale;
    }

    /** Multiplies the displacement: 1 adds the field, -1 takes it away. */
    double factor;
    /** Largest deviation, mm, that counts as success. */
    double tolerance_mm;
    /** How far a node may lie off the part, mm; 0 chooses from the part's size. */
    double match_tolerance_mm;
    /** Length unit of the field in mm (1000 for metres); 0: mm, and refuses what looks otherwise. */
    double field_unit_mm;
    /** Further factor on the displacements alone. */
    double displacement_scale;
    /** Solid to morph, from 1; 0 takes the only one that the field covers. */
    std::uint32_t solid = 0;
    /** Extends the field over areas without nodes however far that is. */
    bool extrapolate = false;
    /** Also fits without every tenth node, and reports the error there. */
    bool holdout = false;
    /** Number of threads; 0 uses all processors. The result does not depend on it. */
    std::uint32_t threads = 0;
    /** Faces that move, from 1, all others stay; none: all move. */
    std::vector<std::uint32_t> moving_faces;
    /** Faces that stay, from 1. */
    std::vector<std::uint32_t> fixed_faces;
    /** Names of all faces by index, UTF-8, "" for none; or empty. */
    std::vector<std::string> face_names;
    /** What the report calls the solid, UTF-8. */
    std::string solid_name;
};

/** What became of every node on every face it lies on: arrays of one length, or three times it. */
struct Nodes {
    /** [n] node numbers. */
    std::vector<std::int64_t> ids;
    /** [n] faces, from 1. */
    std::vector<std::uint32_t> faces;
    /** [n][3] foot points on the input solid, mm. */
    std::vector<double> feet;
    /** [n][3] displacements applied there, factor included, mm. */
    std::vector<double> displacements;
    /** [n][3] what the output surface misses there, mm. */
    std::vector<double> deviations;
};

namespace detail {

inline void require_triples(View<double> values, std::size_t count, const char *name)
{
    if (values.size() != 3 * count)
        refuse(std::string(name) + " needs " + std::to_string(3 * count) + " numbers, 3 for each of " +
               std::to_string(count) + " nodes, not " + std::to_string(values.size()));
}

/** A progress function and what it threw. */
struct Follower {
    const Progress &progress;
    std::exception_ptr thrown;
};

} // namespace detail

extern "C" {
/** Passes a call of the library on; keeps what the function throws. */
inline std::int32_t bladesmith_hpp_follow(void *user, const char *stage, double fraction)
{
    auto &follower = *static_cast<detail::Follower *>(user);
    try {
        return follower.progress(stage, fraction) ? 0 : 1;
    } catch (...) {
        follower.thrown = std::current_exception();
        return 1;
    }
}
}

namespace detail {

inline bladesmith_morph_options in_c(const Options &options, const std::vector<const char *> &names)
{
    bladesmith_morph_options c;
    bladesmith_morph_options_init(&c, sizeof c);
    c.factor = options.factor;
    c.tolerance_mm = options.tolerance_mm;
    c.match_tolerance_mm = options.match_tolerance_mm;
    c.field_unit_mm = options.field_unit_mm;
    c.displacement_scale = options.displacement_scale;
    c.solid = options.solid;
    c.extrapolate = options.extrapolate;
    c.holdout = options.holdout;
    c.threads = options.threads;
    c.moving_faces = options.moving_faces.data();
    c.moving_count = options.moving_faces.size();
    c.fixed_faces = options.fixed_faces.data();
    c.fixed_count = options.fixed_faces.size();
    c.face_names = names.data();
    c.face_names_count = names.size();
    c.solid_name = options.solid_name.c_str();
    return c;
}

/** Calls `work` with what C needs; what the progress function threw comes out. */
template <class Work> auto followed(const Options &options, const Progress &progress, Work work)
{
    std::vector<const char *> names;
    for (const std::string &name : options.face_names)
        names.push_back(name.c_str());
    const bladesmith_morph_options c = in_c(options, names);
    Follower follower{progress, nullptr};
    try {
        return work(c, progress ? bladesmith_hpp_follow : nullptr, &follower);
    } catch (const Error &) {
        if (follower.thrown)
            std::rethrow_exception(follower.thrown);
        throw;
    }
}

} // namespace detail

/** A displacement field on the nodes of an FE mesh. */
class Field : public detail::Handle<bladesmith_field, bladesmith_field_free> {
public:
    /**
     * Reads CalculiX results (.frd) or CSV, gzipped or not. `mesh`: deck (.inp) with the nodes in
     * full precision, or "". `step`: from 1; 0 for the last. Throws BLADESMITH_STATUS_IO,
     * BLADESMITH_STATUS_FIELD with file and line.
     */
    static Field read(const std::string &path, const std::string &mesh = {}, std::uint32_t step = 0)
    {
        return Field([&](bladesmith_field **out) {
            return bladesmith_field_read(path.c_str(), mesh.empty() ? nullptr : mesh.c_str(), step, out);
        });
    }

    /**
     * Copies arrays: ids [n], coordinates xyz [n][3] and displacements u [n][3], in one length
     * unit. Throws BLADESMITH_STATUS_ARGUMENT for other sizes or values that are not finite.
     */
    static Field from_arrays(const std::string &name, View<std::int64_t> ids, View<double> xyz, View<double> u)
    {
        detail::require_triples(xyz, ids.size(), "xyz");
        detail::require_triples(u, ids.size(), "u");
        return Field([&](bladesmith_field **out) {
            return bladesmith_field_from_arrays(name.c_str(), ids.data(), xyz.data(), u.data(), ids.size(), out);
        });
    }

    /** What is in the field, as JSON. */
    std::string info() const { return text(bladesmith_field_info); }

private:
    using Handle::Handle;
};

/** A part: the shapes of one B-rep. */
class Part : public detail::Handle<bladesmith_part, bladesmith_part_free> {
public:
    /**
     * Reads Open CASCADE's text B-rep; `name` stands for it in messages. Throws
     * BLADESMITH_STATUS_BREP with the line.
     */
    static Part read(std::string_view text, const std::string &name = "B-rep")
    {
        return Part([&](bladesmith_part **out) {
            return bladesmith_part_read(text.data(), text.size(), name.c_str(), out);
        });
    }

    /** Solids, faces, edges and extent (mm), as JSON. */
    std::string info() const { return text(bladesmith_part_info); }

    /** The part as text B-rep, which reads back the same to the last bit. */
    std::string write() const { return text(bladesmith_part_write); }

    /**
     * Points and derivatives up to `order` (0 to 2) of the surface under a face (from 1) at the
     * parameters uv [n][2]: [n][3 * k] with k = 1, 3 or 6, in mm and mm per parameter: S, S_u, S_v,
     * S_uu, S_uv, S_vv. Throws BLADESMITH_STATUS_ARGUMENT for a face that is not there.
     */
    std::vector<double> evaluate(std::uint32_t face, View<double> uv, std::uint32_t order = 0) const
    {
        if (uv.size() % 2 != 0)
            detail::refuse("uv needs two numbers a point, not " + std::to_string(uv.size()) + " in all");
        if (order > 2)
            detail::refuse("order is " + std::to_string(order) + "; 0, 1 and 2 are known");
        const std::size_t points = uv.size() / 2;
        std::vector<double> out(points * 3 * ((order + 1) * (order + 2) / 2));
        detail::check(bladesmith_part_evaluate(get(), face, uv.data(), points, order, out.data()));
        return out;
    }

private:
    using Handle::Handle;
    friend class Morphed;
};

/** A morphed solid with its report; it depends on no other object. */
class Morphed : public detail::Handle<bladesmith_morphed, bladesmith_morphed_free> {
public:
    /**
     * Moves one solid: x_out = x_in + factor * u(x_in). A result that misses options.tolerance_mm
     * is no error: see the report. Throws Error with BLADESMITH_STATUS_CANCELLED,
     * BLADESMITH_STATUS_MISMATCH, BLADESMITH_STATUS_SOLID ..., or what `progress` throws.
     */
    static Morphed morph(const Part &part, const Field &field, const Options &options = {},
                         const Progress &progress = {})
    {
        return detail::followed(options, progress, [&](const auto &c, auto call, void *user) {
            return Morphed([&](bladesmith_morphed **out) {
                return bladesmith_morph(part.get(), field.get(), &c, call, user, out);
            });
        });
    }

    /**
     * How the field lies on the part, as JSON, for a look before a morph: the first third of its
     * work. Throws where a morph would refuse the input.
     */
    static std::string check(const Part &part, const Field &field, const Options &options = {},
                             const Progress &progress = {})
    {
        return detail::followed(options, progress, [&](const auto &c, auto call, void *user) {
            // Large enough as a rule: asking for the length first would do the work twice.
            std::string json(1 << 16, '\0');
            std::size_t length = 0;
            const auto fetch = [&] {
                return bladesmith_check(part.get(), field.get(), &c, call, user, json.data(), json.size(), &length);
            };
            std::int32_t status = fetch();
            if (status == BLADESMITH_STATUS_BUFFER_TOO_SMALL) {
                json.resize(length + 1);
                status = fetch();
            }
            detail::check(status);
            json.resize(length);
            return json;
        });
    }

    /** The morphed solid as a part of its own. */
    Part part() const
    {
        return Part([&](bladesmith_part **out) { return bladesmith_morphed_part(get(), out); });
    }

    /** Deviations, gaps, angles, volume, warnings, as JSON; each name carries its unit. */
    std::string report() const { return text(bladesmith_morphed_report); }

    /** Every node on every face it lies on, for colour maps and tables. */
    Nodes nodes() const
    {
        std::size_t n = 0;
        detail::check(bladesmith_morphed_nodes(get(), 0, nullptr, nullptr, nullptr, nullptr, nullptr, &n));
        Nodes out{std::vector<std::int64_t>(n), std::vector<std::uint32_t>(n), std::vector<double>(3 * n),
                  std::vector<double>(3 * n), std::vector<double>(3 * n)};
        detail::check(bladesmith_morphed_nodes(get(), n, out.ids.data(), out.faces.data(), out.feet.data(),
                                               out.displacements.data(), out.deviations.data(), &n));
        return out;
    }

private:
    using Handle::Handle;
};

/** Release of the loaded library, such as "0.1.0". */
inline std::string version()
{
    return bladesmith_version();
}

} // namespace bladesmith

#endif
