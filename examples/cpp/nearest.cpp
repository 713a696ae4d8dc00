// Nearest points: of many at once, and all that are equally near.
//
//     nearest

#include <bladesmith/bladesmith.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve, bladesmith::Surface;

int main()
try {
    // A half ring: a quarter of a circle that turns about the z axis.
    const auto profile = Curve::arc(std::array{10.0, 0.0, 0.0}, std::array{4.0, 0.0, 0.0}, std::array{0.0, 0.0, 4.0}, 0.0, 1.5707963267948966);
    const auto ring = Surface::revolved(profile, {0, 0, 0}, {0, 0, 1}, 3.141592653589793);

    // The handle keeps what the first search prepared: the next ones are faster.
    const std::vector<double> points{14, 1, 2, 0, 20, 0, 3, -5, 8};
    const auto found = ring.nearest(points);
    for (std::size_t i = 0; i < found.distances.size(); i++)
        std::printf("(u, v) = (%.6f, %.6f), %.6f mm away\n", found.parameters[2 * i], found.parameters[2 * i + 1], found.distances[i]);

    // From a middle between two lines both are as near: nearest() gives one of them, nearest_all() both.
    const Curve bend(2, 1, std::array{0.0, 0.0, 1.0, 2.0, 2.0}, std::array{0.0, 8.0, 0.0, 0.0, 6.0, 0.0});
    const auto ties = bend.nearest_all(std::array{2.0, 2.0}, 1e-9);
    for (std::size_t i = 0; i < ties.rows(); i++)
        std::printf("t = %.6f: (%.6f, %.6f), %.6f mm away\n", ties(i, 0), ties(i, 1), ties(i, 2), ties(i, 4));
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
}
