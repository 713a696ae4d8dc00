// A curve through points: its length, points at equal distances along it, and what is nearest.
//
//     curves

#include <bladesmith/bladesmith.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>

int main()
try {
    const std::vector<double> points{0, 0, 8, 5, 20, 9, 34, 10, 48, 7, 60, 2, 70, -4};

    // Points on their own leave parameters and knots open: here by the square root of distances.
    const auto t = bladesmith::parameters(2, points, BLADESMITH_SPACING_CENTRIPETAL, 0.5);
    const auto curve = bladesmith::Curve::interpolate(2, 3, t, points);

    const double length = curve.lengths(std::array{1.0}).front();
    std::printf("length %.6f mm\n", length);

    std::vector<double> stations;
    for (int i = 0; i < 5; i++)
        stations.push_back(length * i / 4);
    const auto at = curve.at_lengths(stations);
    const auto values = curve.evaluate(at);
    const auto frames = curve.frames(at);
    for (std::size_t i = 0; i < stations.size(); i++)
        std::printf("at %6.3f mm: (%.6f, %.6f), curvature %.6f 1/mm\n", stations[i], values[2 * i], values[2 * i + 1],
                    frames.curvatures[i]);

    const auto nearest = curve.nearest(std::array{30.0, 20.0, 75.0, 0.0});
    std::printf("distances %.6f mm, %.6f mm\n", nearest.distances[0], nearest.distances[1]);

    std::printf("%d Bezier segments\n", static_cast<int>(curve.bezier_segments().size()));
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
}
