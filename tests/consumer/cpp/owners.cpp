// The C++ header at work: owners PART.brep FIELD.frd
//
// Owners move and free, statuses come as exceptions, arrays are checked, and what a progress
// function throws comes out of the morph.

#include <bladesmith/bladesmith.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>

using bladesmith::Error, bladesmith::Field, bladesmith::Morphed, bladesmith::Options, bladesmith::Part;

static_assert(!std::is_copy_constructible_v<Part> && !std::is_copy_assignable_v<Field>);
static_assert(std::is_nothrow_move_constructible_v<Morphed> && std::is_nothrow_move_assignable_v<Part>);

static int failures = 0;

static void expect(bool holds, const std::string &what)
{
    if (!holds) {
        std::cerr << "does not hold: " << what << '\n';
        failures++;
    }
}

// Status and message with which a call must fail.
template <class Call> static void expect_error(std::int32_t status, const std::string &part, Call call)
{
    try {
        call();
        expect(false, "an error that says '" + part + "'");
    } catch (const Error &error) {
        expect(error.status() == status, "status " + std::to_string(status) + " rather than " + std::to_string(error.status()));
        expect(std::string(error.what()).find(part) != std::string::npos, "'" + part + "' in: " + error.what());
    }
}

static void check_errors(const Part &part)
{
    expect_error(BLADESMITH_STATUS_BREP, "mine, line 1", [] { Part::read("solid x", "mine"); });
    expect_error(BLADESMITH_STATUS_IO, "no/such.frd", [] { Field::read("no/such.frd"); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "'face': is 1000", [&] { part.evaluate(1000, std::array{0.0, 0.0}); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "two numbers", [&] { part.evaluate(1, std::array{0.0, 0.0, 1.0}); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "order is 3", [&] { part.evaluate(1, std::array{0.0, 0.0}, 3); });
    expect_error(BLADESMITH_STATUS_ARGUMENT, "u needs 6 numbers", [] {
        Field::from_arrays("mine", std::array<std::int64_t, 2>{1, 2}, std::vector<double>(6), std::vector<double>(5));
    });
}

static void check_arrays(const Part &part)
{
    const double uv[] = {0.25, 0.5, 0.5, 0.5};
    expect(part.evaluate(1, uv).size() == 6 && part.evaluate(1, uv, 2).size() == 36, "two points of three numbers each");
    expect(part.evaluate(1, {}).empty(), "no points of no parameters");
    const std::vector<std::int64_t> ids{7, 3};
    const auto field = Field::from_arrays("mine", ids, std::vector<double>{0, 0, 0, 1, 0, 0}, std::vector<double>(6));
    expect(field.info().find("\"mine\"") != std::string::npos, "the name in " + field.info());
}

static void check_moves(Part part)
{
    const auto *handle = part.get();
    Part other = std::move(part);
    expect(other.get() == handle && part.get() == nullptr, "a handle moves");
    expect_error(BLADESMITH_STATUS_ARGUMENT, "'part': is NULL", [&] { part.info(); });
    part = Part::read(other.write());
    expect(part.write() == other.write(), "what was moved from can be given anew");
    part = std::move(other);
    expect(part.get() == handle, "assignment moves");
}

static void check_progress(const Part &part, const Field &field)
{
    struct Mine {};
    bool caught = false;
    try {
        Morphed::morph(part, field, {}, [](std::string_view, double) -> bool { throw Mine(); });
    } catch (const Mine &) {
        caught = true;
    }
    try {
        Morphed::check(part, field, {}, [](std::string_view, double) -> bool { throw Mine(); });
        caught = false;
    } catch (const Mine &) {
    }
    expect(caught, "what the progress function throws comes out");
    expect_error(BLADESMITH_STATUS_CANCELLED, "cancelled", [&] {
        Morphed::morph(part, field, {}, [](std::string_view stage, double) { return stage.empty(); });
    });
}

static void check_morph(const Part &part, const Field &field)
{
    Options options;
    expect(options.factor == 1.0 && options.tolerance_mm == 1e-3, "the library's defaults");
    options.fixed_faces = {1000};
    expect_error(BLADESMITH_STATUS_ARGUMENT, "1000", [&] { Morphed::morph(part, field, options); });
    options.fixed_faces.clear();
    options.factor = -1.0;
    options.face_names = {"foot", "", "tip", "", "", "", "hole"};
    options.solid_name = "bar";
    expect(Morphed::check(part, field, options).find("\"nodes_on_faces\"") != std::string::npos, "a look before");
    double last = 0.0;
    const auto morphed = Morphed::morph(part, field, options, [&](std::string_view, double fraction) {
        expect(fraction >= last, "the fraction done rises");
        last = fraction;
        return true;
    });
    expect(last == 1.0, "progress to the end");
    expect(morphed.report().find("\"hole\"") != std::string::npos, "the report names faces");
    const auto nodes = morphed.nodes();
    const std::size_t n = nodes.ids.size();
    expect(n > 600 && nodes.faces.size() == n && nodes.feet.size() == 3 * n, "arrays of one length");
    expect(nodes.displacements.size() == 3 * n && nodes.deviations.size() == 3 * n, "and three times it");
    expect(morphed.part().write() != part.write(), "the part has moved");
}

int main(int argc, char **argv)
try {
    if (argc != 3)
        throw std::runtime_error("usage: owners PART.brep FIELD.frd");
    std::ifstream file(argv[1], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto part = Part::read(text, argv[1]);
    const auto field = Field::read(argv[2]);
    expect(bladesmith::version().find('.') != std::string::npos, "a release");
    check_errors(part);
    check_arrays(part);
    check_moves(Part::read(text));
    check_progress(part, field);
    check_morph(part, field);
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
