#pragma once
// Gauss-Legendre quadrature.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nacre {

/// Nodes and weights on [-1, 1], in increasing order; exact for polynomials of degree 2 n - 1.
struct GaussLegendre {
    std::vector<double> node, weight;

    /// `n` >= 1 nodes by Newton's method on the Legendre polynomial, from Tricomi's estimate of its
    /// roots; accurate to about 1e-15.
    explicit GaussLegendre(std::size_t n) : node(n), weight(n) {
        const double degree = static_cast<double>(n);
        for (std::size_t i = 0; i < n; ++i) {
            double x =
                -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (degree + 0.5));
            double slope = 1.;
            for (int step = 0; step < 8; ++step) {  // converges quadratically; four are enough
                double p = 1., before = 0.;
                for (std::size_t k = 1; k <= n; ++k) {
                    const double j = static_cast<double>(k);
                    const double next = ((2. * j - 1.) * x * p - (j - 1.) * before) / j;
                    before = p;
                    p = next;
                }
                slope = degree * (x * p - before) / (x * x - 1.);
                x -= p / slope;
            }
            node[i] = x;
            weight[i] = 2. / ((1. - x * x) * slope * slope);
        }
    }

    /// Integral of f over [a, b].
    template <class F>
    double integrate(double a, double b, F&& f) const {
        const double half = 0.5 * (b - a), middle = 0.5 * (a + b);
        double sum = 0.;
        for (std::size_t i = 0; i < node.size(); ++i) sum += weight[i] * f(middle + half * node[i]);
        return half * sum;
    }
};

}  // namespace nacre
