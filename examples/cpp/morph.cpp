// Morphs a part by a CalculiX field and prints the report:
//
//     morph HOT.brep FIELD.frd FACTOR COLD.brep
//
// HOT.brep is Open CASCADE's text B-rep, as FreeCAD's exportBrep writes it. FACTOR 1 adds the
// displacements, -1 takes them away.

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

static std::string read_text(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file)
        throw std::runtime_error(path + ": cannot be read");
    return text;
}

static double read_number(const std::string &text)
{
    std::istringstream stream(text);
    double number = 0.0;
    if (!(stream >> number) || !stream.eof())
        throw std::runtime_error(text + ": FACTOR must be a number");
    return number;
}

// A file that gets its name when it is whole.
class Output {
    std::string path, partial;
    std::ofstream file;

  public:
    explicit Output(const std::string &name) : path(name), partial(name + ".partial"), file(partial, std::ios::binary)
    {
        if (!file)
            throw std::runtime_error(path + ": cannot be written");
    }
    ~Output()
    {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
    }
    void finish(const std::string &text)
    {
        file << text;
        file.close();
        if (!file)
            throw std::runtime_error(path + ": cannot be written");
        std::filesystem::rename(partial, path);
    }
};

static void print_worst_node(const bladesmith::Nodes &nodes)
{
    const auto deviation = [&](std::size_t i) {
        const double *d = nodes.deviations.data() + 3 * i;
        return std::hypot(d[0], d[1], d[2]);
    };
    std::size_t worst = 0;
    for (std::size_t i = 1; i < nodes.ids.size(); i++)
        worst = deviation(i) > deviation(worst) ? i : worst;
    if (!nodes.ids.empty())
        std::cerr << "node " << nodes.ids[worst] << " on face " << nodes.faces[worst] << " is missed by "
                  << deviation(worst) << " mm\n";
}

int main(int argc, char **argv)
try {
    if (argc != 5)
        throw std::runtime_error("usage: morph HOT.brep FIELD.frd FACTOR COLD.brep (Bladesmith " + bladesmith::version() + ")");
    bladesmith::Options options;
    options.solid_name = argv[1];
    options.factor = read_number(argv[3]);
    Output output(argv[4]);
    const auto hot = bladesmith::Part::read(read_text(argv[1]), argv[1]);
    const auto field = bladesmith::Field::read(argv[2]);
    const auto show = [](std::string_view stage, double fraction) {
        std::cerr << std::lround(100.0 * fraction) << " % " << stage << '\n';
        return true; // false would cancel
    };
    const auto morphed = bladesmith::Morphed::morph(hot, field, options, show);
    std::cout << morphed.report() << '\n';
    print_worst_node(morphed.nodes());
    output.finish(morphed.part().write());
    return EXIT_SUCCESS;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
