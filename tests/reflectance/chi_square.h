#pragma once
// Does a sampler draw directions with the density that it claims? Pearson's chi-square test over
// bins of the sphere.
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "nacre/math/quadrature.h"
#include "nacre/math/random.h"
#include "nacre/math/statistics.h"
#include "tests/support/statistics.h"

namespace nacre::test {

struct ChiSquareResult {
    double p = 0.;         ///< probability of a worse fit by chance
    double integral = 0.;  ///< of the density over the sphere
    double drawn = 0.;     ///< share of the samples that had a direction
};

/// `sample` returns the direction of random number i, or nothing if it belongs to no density (it
/// was absorbed or discrete); `pdf` is the density of those that it returns. Bins of fewer than
/// five expected samples are pooled, and the directions that do not exist are a bin of their own.
inline ChiSquareResult chi_square(const std::function<std::optional<Vec3f>(Random&)>& sample,
                                  const std::function<double(const Vec3f&)>& pdf,
                                  std::uint64_t seed, int samples = 50000, int rows = 32,
                                  int columns = 32) {
    std::vector<double> expected(rows * columns), found(rows * columns);
    const GaussLegendre nodes(8);
    const double pi = std::numbers::pi, dz = 2. / rows, dphi = 2. * pi / columns;
    ChiSquareResult result;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double mean = nodes.integrate(-1. + r * dz, -1. + (r + 1) * dz, [&](double z) {
                return nodes.integrate(c * dphi, (c + 1) * dphi, [&](double phi) {
                    const double s = std::sqrt(1. - z * z);
                    return pdf(Vec3f{float(s * std::cos(phi)), float(s * std::sin(phi)), float(z)});
                });
            });
            expected[r * columns + c] = mean * samples;
            result.integral += mean;
        }
    Random random(stream_key(seed, 1));
    int drawn = 0;
    for (int i = 0; i < samples; ++i)
        if (const auto w = sample(random)) {
            const int r = std::clamp(int((w->z + 1.) / dz), 0, rows - 1);
            const double phi = std::atan2(w->y, w->x);
            const int c = std::clamp(int((phi < 0. ? phi + 2. * pi : phi) / dphi), 0, columns - 1);
            found[r * columns + c] += 1.;
            ++drawn;
        }
    result.drawn = double(drawn) / samples;

    expected.push_back(std::max(0., 1. - result.integral) * samples);
    found.push_back(samples - drawn);
    PearsonStatistic statistic(found, expected);
    const double pooled = statistic.pooled_expected;
    if (pooled >= 1.)
        statistic.add_pooled();
    else if (statistic.pooled_observed > pooled + 6. * std::sqrt(pooled) + 6.)
        return result;  // directions where there is no density at all
    const int terms = statistic.cells;
    result.p = terms > 1 ? gamma_q(0.5 * (terms - 1), 0.5 * statistic.value) : 1.;
    return result;
}

/// Significance of each of n tests for which all together fail by chance with 1 % (Sidak).
inline double sidak(int n) { return 1. - std::pow(0.99, 1. / n); }

}  // namespace nacre::test
