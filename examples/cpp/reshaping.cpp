// Exact changes of a curve: another degree, more knots, parts, joining, a copy elsewhere.
//
//     reshaping

#include <bladesmith/bladesmith.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>

using bladesmith::Curve;

static void report(const char *what, const Curve &curve)
{
    std::printf("%-24s degree %u, %2d poles, %.9f mm\n", what, curve.degree(), static_cast<int>(curve.poles().size() / curve.dimension()),
                curve.length());
}

int main()
try {
    const auto arc = Curve::arc(std::array{0.0, 0.0}, std::array{20.0, 0.0}, std::array{0.0, 20.0}, 0.0, 2.5);
    report("an arc", arc);
    report("of a higher degree", arc.elevated());
    report("with more knots", arc.refined(std::array{0.1, 0.2, 0.3}));
    report("over another domain", arc.over(0.0, 50.0));

    // Parts keep their parameters, and become one curve again; the knot between them can then go.
    const auto both = arc.part(0.0, 0.3).joined(arc.part(0.3, 1.0), 1e-9);
    report("cut and joined", both);
    const auto healed = both.without_knot(0.3, 2, 1e-9);
    report("without that knot", healed.shape);
    std::printf("%s\n", healed.by <= 1e-9 ? "nothing has moved" : "it moved");

    // An affine map takes the plane into space: here twice as large, upright, 5 mm up.
    const auto upright = arc.mapped({2, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 5}, 3);
    report("twice as large, upright", upright);
    std::printf("%d Bezier segments\n", static_cast<int>(upright.bezier_segments().size()));
    return EXIT_SUCCESS;
} catch (const bladesmith::Error &error) {
    std::cerr << "status " << error.status() << ": " << error.what() << '\n';
    return EXIT_FAILURE;
}
