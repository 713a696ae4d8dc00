// Tools for surfaces: an offset wall, where a plane and another surface cut it, a curve projected on it.
//
//     sections

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve, bladesmith::Section, bladesmith::Surface;

static Curve line(double x0, double y0, double z0, double x1, double y1, double z1)
{
    return Curve(3, 1, std::array{0.0, 0.0, 1.0, 1.0}, std::array{x0, y0, z0, x1, y1, z1});
}

static void report(const char *what, const Section &section)
{
    double length = 0.0;
    for (const auto &branch : section.branches)
        length += branch.curve.length();
    std::printf("%s: %d branch(es), %.4f mm\n", what, static_cast<int>(section.branches.size()), length);
}

int main()
try {
    const double turn = 6.283185307179586;
    const auto pipe = Surface::revolved(line(10, 0, 0, 10, 0, 30), {0, 0, 0}, {0, 0, 1}, turn);
    const auto thin = Surface::revolved(line(-20, 4, 15, 20, 4, 15), {0, 0, 15}, {1, 0, 0}, turn);

    const auto wall = pipe.offset(1.0, 1e-6);
    const auto corner = wall.shape.evaluate(std::array{0.0, 0.0});
    std::printf("offset wall of radius %.4f mm\n", std::hypot(corner[0], corner[1]));

    // At 45 degrees a plane cuts the pipe in an ellipse.
    report("plane", pipe.section({0, 0, 15}, {1, 0, 1}, 1e-6));
    const auto holes = pipe.intersect(thin, 1e-6);
    report("thin pipe", holes);

    // Each branch comes with its curve in the parameters of both surfaces.
    const auto &branch = holes.branches.front();
    const double middle = branch.curve.domain()[1] / 2;
    const auto on_pipe = pipe.evaluate(branch.parameters[0].evaluate(std::array{middle}));
    const auto in_space = branch.curve.evaluate(std::array{middle});
    const bool same = std::hypot(on_pipe[0] - in_space[0], on_pipe[1] - in_space[1], on_pipe[2] - in_space[2]) < 2e-6;
    std::printf("its parameters %s\n", same ? "lead to it" : "lead elsewhere");

    for (const auto &part : pipe.project(line(-5, 30, 5, 5, 30, 25), {0, 1, 0}, 1e-6))
        std::printf("projected: %.4f mm\n", part.curve.length());
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
}
