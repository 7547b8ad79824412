#include "nacre/render/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "nacre/math/error.h"

namespace nacre {
namespace {

const std::vector<Sampler::Kind> kinds{Sampler::Kind::independent, Sampler::Kind::stratified,
                                       Sampler::Kind::sobol};

/// Chi-square statistic of counts that should be equal.
double chi_square(const std::vector<int>& counts) {
    double total = 0, r = 0;
    for (int c : counts) total += c;
    const double expected = total / static_cast<double>(counts.size());
    for (int c : counts) r += (c - expected) * (c - expected) / expected;
    return r;
}

TEST(Sampler, NamesAreKnownAndOthersAnswered) {
    EXPECT_EQ(Sampler::kind_from_name("independent"), Sampler::Kind::independent);
    EXPECT_EQ(Sampler::kind_from_name("stratified"), Sampler::Kind::stratified);
    EXPECT_EQ(Sampler::kind_from_name("sobol"), Sampler::Kind::sobol);
    try {
        Sampler::kind_from_name("halton");
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(),
                     "unknown sampler 'halton'; known are: independent, stratified, sobol");
    }
}

TEST(Sampler, ASampleIsAFunctionOfSeedPixelAndIndexAlone) {
    for (Sampler::Kind kind : kinds) {
        const auto draw = [&](std::uint64_t seed, std::uint64_t pixel, std::uint32_t index) {
            Sampler s(kind, seed, 16);
            s.start(99, 3);  // whatever was drawn before
            s.next2d();
            s.start(pixel, index);
            std::vector<float> r;
            for (int i = 0; i < 4; ++i) {
                const Vec2f u = s.next2d();
                r.insert(r.end(), {u.x, u.y, s.next1d(), s.random().next()});
            }
            return r;
        };
        EXPECT_EQ(draw(1, 2, 3), draw(1, 2, 3));
        EXPECT_NE(draw(1, 2, 3), draw(2, 2, 3));
        EXPECT_NE(draw(1, 2, 3), draw(1, 3, 3));
        EXPECT_NE(draw(1, 2, 3), draw(1, 2, 4));
        const std::vector<float> values = draw(1, 2, 3);
        EXPECT_EQ(std::set<float>(values.begin(), values.end()).size(), values.size());
    }
}

/// Every single number is uniform over pixels, whatever the sample index and dimension: 64 cells,
/// 20000 pixels, the 1e-6 quantile of chi-square with 63 degrees of freedom is 126.
TEST(Sampler, EveryNumberIsUniformOverPixels) {
    for (Sampler::Kind kind : kinds)
        for (int samples : {1, 7, 16})
            for (std::uint32_t index : {0u, static_cast<std::uint32_t>(samples - 1)}) {
                std::vector<int> one(64), two(64), second(64);
                Sampler s(kind, 42, samples);
                for (int pixel = 0; pixel < 20000; ++pixel) {
                    s.start(pixel, index);
                    s.next1d();
                    const float u = s.next1d();
                    const Vec2f v = s.next2d();
                    for (float t : {u, v.x, v.y}) {
                        ASSERT_GE(t, 0.f);
                        ASSERT_LT(t, 1.f);
                    }
                    ++one[int(u * 64)];
                    ++two[int(v.x * 8) * 8 + int(v.y * 8)];
                    ++second[int(u * 8) * 8 + int(v.x * 8)];  // two calls are independent
                }
                EXPECT_LT(chi_square(one), 126) << int(kind) << " " << samples << " " << index;
                EXPECT_LT(chi_square(second), 126) << int(kind) << " " << samples << " " << index;
                // A grid of more cells than samples leaves the last ones out at random, never the
                // same ones.
                EXPECT_LT(chi_square(two), 126) << int(kind) << " " << samples << " " << index;
            }
}

TEST(Sampler, StratifiedFillsEveryStratumOnce) {
    for (int samples : {1, 2, 5, 16, 100}) {
        Sampler s(Sampler::Kind::stratified, 3, samples);
        const int columns = static_cast<int>(std::lround(std::sqrt(samples)));
        const int rows = (samples + columns - 1) / columns;
        for (int call = 0; call < 3; ++call) {
            std::set<int> strata, cells;
            for (int i = 0; i < samples; ++i) {
                s.start(17, i);
                for (int skip = 0; skip < 2 * call; ++skip) s.next1d();
                strata.insert(int(s.next1d() * float(samples)));
                const Vec2f u = s.next2d();
                cells.insert(int(u.x * float(columns)) + columns * int(u.y * float(rows)));
            }
            EXPECT_EQ(int(strata.size()), samples);
            EXPECT_EQ(int(cells.size()), samples);
        }
    }
}

/// Sobol's first two dimensions are a (0, m, 2)-net, and scrambling keeps that: every elementary
/// interval of area 1/16 holds one of 16 points.
TEST(Sampler, SobolIsANetInEveryCall) {
    Sampler s(Sampler::Kind::sobol, 3, 16);
    for (int call = 0; call < 5; ++call)
        for (int log_columns = 0; log_columns <= 4; ++log_columns) {
            const int columns = 1 << log_columns, rows = 16 / columns;
            std::set<int> cells;
            for (int i = 0; i < 16; ++i) {
                s.start(5, i);
                for (int skip = 0; skip < call; ++skip) s.next2d();
                const Vec2f u = s.next2d();
                cells.insert(int(u.x * float(columns)) + columns * int(u.y * float(rows)));
            }
            EXPECT_EQ(cells.size(), 16u) << call << " " << columns;
        }
}

/// Variance of the mean of a smooth function falls by far more than chance: known ratios are not
/// needed, only the order that the theory promises (1/N, 1/N^2 for strata of a linear function,
/// N^-3 for scrambled nets).
TEST(Sampler, EvenPointsIntegrateSmoothFunctionsBetter) {
    const int samples = 64, pixels = 2000;
    std::vector<double> variance;
    for (Sampler::Kind kind : kinds) {
        Sampler s(kind, 8, samples);
        double sum2 = 0, sum = 0;
        for (int p = 0; p < pixels; ++p) {
            double mean = 0;
            for (int i = 0; i < samples; ++i) {
                s.start(p, i);
                const Vec2f u = s.next2d();
                mean += u.x + u.y;
            }
            mean /= samples;
            sum += mean;
            sum2 += (mean - 1) * (mean - 1);
        }
        variance.push_back(sum2 / pixels);
        // Unbiased: the mean of pixels within 5 standard errors of 1.
        EXPECT_NEAR(sum / pixels, 1.0, 5 * std::sqrt(variance.back() / pixels));
    }
    // Independent: 2/12/64; strata of side 1/8: 2/12/64/64. Relative standard error sqrt(2/2000).
    EXPECT_NEAR(variance[0], 1.0 / 384, 0.16 / 384);
    EXPECT_NEAR(variance[1], 1.0 / 384 / 64, 0.16 / 384 / 64);
    EXPECT_LT(variance[2], variance[1] / 8);
}

TEST(Permute, IsABijectionThatTakesEveryPlaceAlikeOften) {
    for (std::uint32_t n : {1u, 2u, 3u, 5u, 8u, 9u, 17u, 100u}) {
        std::vector<int> places(n);
        for (std::uint64_t key = 0; key < 4000; ++key) {
            std::set<std::uint32_t> image;
            for (std::uint32_t i = 0; i < n; ++i) image.insert(permute(i, n, mix_bits(key)));
            ASSERT_EQ(image.size(), n);
            ASSERT_LT(*image.rbegin(), n);
            ++places[permute(n / 2, n, mix_bits(key))];
        }
        // Chi-square with n - 1 degrees of freedom: mean n - 1, deviation sqrt(2 (n - 1)).
        const double df = n - 1.0;
        EXPECT_LT(chi_square(places), df + 6 * std::sqrt(2 * df) + 10) << n;
    }
    // Pairs of places too: 9 * 8 of them, 71 degrees of freedom, quantile 1 - 1e-6: 137.
    std::vector<int> pairs(72);
    for (std::uint64_t key = 0; key < 40000; ++key) {
        const std::uint32_t a = permute(2, 9, mix_bits(key)), b = permute(6, 9, mix_bits(key));
        ++pairs[a * 8 + (b > a ? b - 1 : b)];
    }
    EXPECT_LT(chi_square(pairs), 137);
}

}  // namespace
}  // namespace nacre
