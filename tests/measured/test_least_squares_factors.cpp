// Factors by least squares: over what is known, and without negative ones.
#include <gtest/gtest.h>

#include "nacre/math/random.h"
#include "nacre/measured/factor/least_squares.h"
#include "nacre/measured/factor/partial_svd.h"

namespace nacre {
namespace {

constexpr int factor_size = 36;

std::vector<double> made_matrix(const std::function<double(int, int)>& f) {
    std::vector<double> m;
    for (int k = 0; k < factor_size; ++k)
        for (int l = 0; l < factor_size; ++l) m.push_back(f(k, l));
    return m;
}

/// What is known of it: about that share, at random; the rest of the matrix becomes 0.
std::vector<std::uint8_t> hide(std::vector<double>& m, double share) {
    Random random(stream_key(5, 2));
    std::vector<std::uint8_t> known;
    for (double& x : m) {
        known.push_back(random.next() < share);
        if (!known.back()) x = 0.;
    }
    return known;
}

double smooth(int k, int l) {
    return 1. + std::cos(0.2 * k * l / 36.) + std::exp(-0.01 * (k - l) * (k - l));
}

double sum_at(const FactorTerms& t, int k, int l) {
    double sum = 0.;
    for (std::size_t j = 0; j < t.g.size(); ++j) sum += t.g[j][k] * t.h[j][l];
    return sum;
}

}  // namespace

// A product is found from half of its values, and so are the values that were not given.
TEST(LeastSquaresFactors, AProductIsKnownFromHalfOfIt) {
    const auto f = [](int k, int l) { return (1. + 0.1 * k) * (5. - 0.12 * l); };
    std::vector<double> m = made_matrix(f);
    const auto known = hide(m, 0.5);
    for (const bool nonnegative : {false, true}) {
        LeastSquaresFactors factors(m, known, factor_size, nonnegative);
        factors.grow_to(1);
        EXPECT_LT(factors.relative_error(), 1e-6);
        for (int k = 0; k < factor_size; ++k)
            for (int l = 0; l < factor_size; ++l)
                EXPECT_NEAR(sum_at(factors.terms(), k, l), f(k, l), 1e-4);
    }
}

// Where all is known, nothing is better than the singular value decomposition, and this comes near.
TEST(LeastSquaresFactors, ComeToTheSingularValues) {
    const std::vector<double> m = made_matrix(smooth);
    const Svd svd = full_svd(m, factor_size);
    double all = 0., left = 0.;
    for (double s : svd.sigma) all += s * s;
    LeastSquaresFactors factors(m, {}, factor_size, false);
    for (int terms = 1; terms <= 4; ++terms) {
        factors.grow_to(terms);
        left = all;
        for (int j = 0; j < terms; ++j) left -= svd.sigma[j] * svd.sigma[j];
        const double best = std::sqrt(left / all);
        EXPECT_GE(factors.relative_error(), best * (1. - 1e-9));
        EXPECT_LE(factors.relative_error(), best * 1.05) << terms;
    }
}

TEST(LeastSquaresFactors, TheErrorNeverRises) {
    for (const bool nonnegative : {false, true})
        for (const double share : {1., 0.6}) {
            std::vector<double> m = made_matrix(smooth);
            const auto known = hide(m, share);
            LeastSquaresFactors factors(m, known, factor_size, nonnegative);
            double before = 1.;
            for (int terms = 1; terms <= 16; ++terms) {
                factors.grow_to(terms);
                const double error = factors.relative_error();
                EXPECT_LE(error, before * (1. + 1e-9)) << terms << " " << share << nonnegative;
                before = error;
                // What it says is what its terms leave.
                double left = 0., all = 0.;
                for (int k = 0; k < factor_size; ++k)
                    for (int l = 0; l < factor_size; ++l) {
                        const std::size_t at = std::size_t(k) * factor_size + l;
                        if (!known[at]) continue;
                        left += std::pow(m[at] - sum_at(factors.terms(), k, l), 2);
                        all += m[at] * m[at];
                    }
                EXPECT_NEAR(std::sqrt(left / all), error, 1e-8);
            }
            EXPECT_EQ(factors.terms().g.size(), 16u);
            const FactorTerms found = factors.terms();
            for (const auto* side : {&found.g, &found.h})
                for (const auto& f : *side)
                    for (double x : f) EXPECT_TRUE(!nonnegative || x >= 0.);
        }
}

// Blocks beside one another are a sum of products of non-negative factors, one a block.
TEST(LeastSquaresFactors, BlocksAreFound) {
    const std::vector<double> m =
        made_matrix([](int k, int l) { return k / 12 == l / 12 ? 1. + k / 12 : 0.; });
    LeastSquaresFactors factors(m, {}, factor_size, true);
    factors.grow_to(3);
    EXPECT_LT(factors.relative_error(), 1e-5);
}

// A row without a value gets none, and disturbs nothing.
TEST(LeastSquaresFactors, RowsOfWhichNothingIsKnown) {
    std::vector<double> m = made_matrix([](int k, int l) { return (1. + k) * (2. + l); });
    std::vector<std::uint8_t> known(m.size(), 1);
    for (int l = 0; l < factor_size; ++l) {
        m[5 * factor_size + l] = 0.;
        known[5 * factor_size + l] = 0;
    }
    LeastSquaresFactors factors(m, known, factor_size, false);
    factors.grow_to(2);
    EXPECT_LT(factors.relative_error(), 1e-6);
    const FactorTerms found = factors.terms();
    for (double x : found.g[0]) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace nacre
