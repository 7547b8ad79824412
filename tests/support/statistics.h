#pragma once
// Statistical tests with a stated significance.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nacre::test {

/// The value that chi-square with `degrees` degrees of freedom exceeds with probability 1 %, by
/// Wilson and Hilferty 1931 (within 0.3 % from 3 degrees on).
inline double chi_square_1_percent(double degrees) {
    const double a = 2. / (9. * degrees);
    const double root = 1. - a + 2.3263479 * std::sqrt(a);
    return degrees * root * root * root;
}

/// Pearson's test of counts against expected counts at 1 %. Cells that expect fewer than five are
/// pooled.
inline testing::AssertionResult chi_square_passes(const std::vector<double>& observed,
                                                  const std::vector<double>& expected) {
    double statistic = 0., pooled_observed = 0., pooled_expected = 0.;
    int cells = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 5.) {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
            continue;
        }
        statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++cells;
    }
    if (pooled_expected > 5.) {
        statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) /
                     pooled_expected;
        ++cells;
    } else if (pooled_observed > 25.) {
        return testing::AssertionFailure()
               << pooled_observed << " samples where " << pooled_expected << " are expected";
    }
    const double critical = chi_square_1_percent(cells - 1.);
    if (statistic <= critical) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "chi-square " << statistic << " exceeds " << critical
                                       << " (1 %, " << cells - 1 << " degrees of freedom)";
}

}  // namespace nacre::test
