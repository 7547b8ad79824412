#include "nacre/math/quadrature.h"

#include <gtest/gtest.h>

namespace nacre {

TEST(GaussLegendre, IsExactForPolynomialsOfDegreeTwiceItsSizeLessOne) {
    for (const std::size_t n : {1u, 2u, 3u, 8u, 24u, 64u}) {
        const GaussLegendre rule(n);
        for (std::size_t degree = 0; degree < 2 * n; ++degree) {
            const double power = static_cast<double>(degree);
            // Integral of x^degree over [0, 2].
            const double expected = std::pow(2., power + 1.) / (power + 1.);
            EXPECT_NEAR(rule.integrate(0., 2., [=](double x) { return std::pow(x, power); }),
                        expected, 1e-13 * expected)
                << n << " nodes, degree " << degree;
        }
    }
}

TEST(GaussLegendre, MissesTheFirstDegreeThatItCannotIntegrate) {
    const GaussLegendre rule(2);
    // The square of the Legendre polynomial (3 x^2 - 1) / 2 vanishes at both nodes.
    const auto square = [](double x) { return std::pow(1.5 * x * x - 0.5, 2.); };
    EXPECT_NEAR(rule.integrate(-1., 1., square), 0., 1e-15);
}

}  // namespace nacre
