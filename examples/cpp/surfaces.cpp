// A surface through circular sections: points with derivatives, curvatures, and what is nearest.
//
//     surfaces

#include <bladesmith/bladesmith.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve, bladesmith::Direction, bladesmith::Surface;

int main()
try {
    std::vector<Curve> sections;
    std::vector<double> heights;
    for (int i = 0; i < 4; i++) {
        const double radius = 10.0 + i;
        sections.push_back(Curve::arc(std::array{0.0, 0.0, 10.0 * i}, std::array{radius, 0.0, 0.0},
                                      std::array{0.0, radius, 0.0}, 0.0, 1.5));
        heights.push_back(i / 3.0);
    }
    const auto surface = Surface::skin(sections, heights, 3);

    // One row for each (u, v): the point, then the derivatives along u and v.
    const std::vector<double> uv{0.25, 0.5, 0.5, 0.5};
    const auto jets = surface.evaluate(uv, 1);
    const auto bends = surface.curvatures(uv);
    for (std::size_t i = 0; i < 2; i++) {
        const double *p = &jets[9 * i];
        std::printf("(%.6f, %.6f, %.6f): along v (%.6f, %.6f, %.6f), curvatures %.6f and %.6f 1/mm\n", p[0], p[1], p[2], p[6],
                    p[7], p[8], bends.curvatures[2 * i], bends.curvatures[2 * i + 1]);
    }

    const auto nearest = surface.nearest(std::array{20.0, 20.0, 12.0, 1.0, 1.0, 29.0});
    for (std::size_t i = 0; i < 2; i++)
        std::printf("nearest (%.6f, %.6f, %.6f), %.6f mm away\n", nearest.feet[3 * i], nearest.feet[3 * i + 1],
                    nearest.feet[3 * i + 2], nearest.distances[i]);

    const auto half = surface.part(Direction::v, 0.0, 0.5);
    const auto edge = half.isocurve(Direction::v, 0.5);
    std::printf("edge of the lower half: %.6f mm\n", edge.lengths(std::array{1.0}).front());
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
}
