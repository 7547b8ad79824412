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

/// Pearson's statistic of counts against expected counts. Cells that expect fewer than five are
/// pooled into one more, which is not in the statistic yet: who tests says when it counts.
struct PearsonStatistic {
    double value = 0.;
    int cells = 0;
    double pooled_observed = 0., pooled_expected = 0.;

    PearsonStatistic(const std::vector<double>& observed, const std::vector<double>& expected) {
        for (std::size_t i = 0; i < observed.size(); ++i) {
            if (expected[i] >= 5.) {
                add(observed[i], expected[i]);
                continue;
            }
            pooled_observed += observed[i];
            pooled_expected += expected[i];
        }
    }
    void add_pooled() { add(pooled_observed, pooled_expected); }

  private:
    void add(double o, double e) {
        value += (o - e) * (o - e) / e;
        ++cells;
    }
};

/// Pearson's test of counts against expected counts at 1 %.
inline testing::AssertionResult chi_square_passes(const std::vector<double>& observed,
                                                  const std::vector<double>& expected) {
    PearsonStatistic statistic(observed, expected);
    if (statistic.pooled_expected > 5.)
        statistic.add_pooled();
    else if (statistic.pooled_observed > 25.)
        return testing::AssertionFailure() << statistic.pooled_observed << " samples where "
                                           << statistic.pooled_expected << " are expected";
    const int degrees = statistic.cells - 1;
    const double critical = chi_square_1_percent(degrees);
    if (statistic.value <= critical) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "chi-square " << statistic.value << " exceeds " << critical << " (1 %, " << degrees
           << " degrees of freedom)";
}

}  // namespace nacre::test
