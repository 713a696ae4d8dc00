// Morphs a part by a CalculiX field and prints the report:
//
//     morph HOT.brep FIELD.frd FACTOR COLD.brep
//
// HOT.brep is Open CASCADE's text B-rep, as FreeCAD's exportBrep writes it. FACTOR 1 adds the
// displacements, -1 takes them away.

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>

static std::string read_text(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file)
        throw std::runtime_error(path + " cannot be read");
    return text;
}

static void write_text(const std::string &path, const std::string &text)
{
    std::ofstream file(path, std::ios::binary);
    if (!(file << text).flush())
        throw std::runtime_error(path + " cannot be written");
}

// The node that the new surfaces miss most, in words.
static std::string worst_node(const bladesmith::Nodes &nodes)
{
    double worst = -1.0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < nodes.ids.size(); i++) {
        const double *d = nodes.deviations.data() + 3 * i;
        const double length = std::hypot(d[0], d[1], d[2]);
        if (length > worst) {
            worst = length;
            at = i;
        }
    }
    return worst < 0.0 ? "no nodes"
                       : "node " + std::to_string(nodes.ids[at]) + " on face " + std::to_string(nodes.faces[at]) +
                             " is missed by " + std::to_string(worst) + " mm";
}

int main(int argc, char **argv)
try {
    if (argc != 5) {
        std::cerr << "usage: morph HOT.brep FIELD.frd FACTOR COLD.brep (Bladesmith " << bladesmith::version() << ")\n";
        return EXIT_FAILURE;
    }
    const auto hot = bladesmith::Part::read(read_text(argv[1]), argv[1]);
    const auto field = bladesmith::Field::read(argv[2]);
    bladesmith::Options options;
    options.factor = std::stod(argv[3]);
    options.solid_name = argv[1];
    const auto show = [](std::string_view stage, double fraction) {
        std::cerr << std::lround(100.0 * fraction) << " % " << stage << '\n';
        return true; // false would cancel
    };
    const auto morphed = bladesmith::Morphed::morph(hot, field, options, show);
    std::cout << morphed.report() << '\n';
    std::cerr << worst_node(morphed.nodes()) << '\n';
    write_text(argv[4], morphed.part().write());
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
