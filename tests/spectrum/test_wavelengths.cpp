#include "nacre/spectrum/wavelengths.h"

#include <gtest/gtest.h>

#include "nacre/math/random.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/spectrum.h"
#include "tests/support/statistics.h"

namespace nacre {

TEST(Wavelengths, DensityIntegratesToOne) {
    double sum = 0.;
    for (int i = 0; i < 4700; ++i) sum += 0.1 * wavelength_pdf(360.05f + 0.1f * float(i));
    EXPECT_NEAR(sum, 1., 1e-5);
    EXPECT_EQ(wavelength_pdf(359.f), 0.f);
    EXPECT_EQ(wavelength_pdf(831.f), 0.f);
}

TEST(Wavelengths, EachLaneFollowsTheDensity) {
    const int cells = 47, n = 1 << 18;
    std::vector<double> expected(cells);
    for (int c = 0; c < cells; ++c)
        for (int i = 0; i < 100; ++i)
            expected[c] += n * 0.1 * wavelength_pdf(360.05f + 10.f * float(c) + 0.1f * float(i));
    for (int lane = 0; lane < 4; ++lane) {
        Random rng(stream_key(11, std::uint64_t(lane)));
        std::vector<double> count(cells);
        for (int i = 0; i < n; ++i) {
            const Wavelengths w = Wavelengths::sample(rng.next());
            ASSERT_NEAR(w.pdf[lane] / wavelength_pdf(w.lambda[lane]), 1.f, 3e-5f);
            ++count[std::min(cells - 1, int((w.lambda[lane] - 360.f) / 10.f))];
        }
        EXPECT_TRUE(test::chi_square_passes(count, expected)) << "lane " << lane;
    }
}

TEST(Wavelengths, LanesAreAQuarterOfTheDistributionApart) {
    const Wavelengths w = Wavelengths::sample(0.1f);
    for (int i = 0; i < 3; ++i) {
        double between = 0.;
        const float a = w.lambda[i], step = (w.lambda[i + 1] - a) / 1000.f;
        for (int k = 0; k < 1000; ++k)
            between += step * wavelength_pdf(a + (float(k) + 0.5f) * step);
        EXPECT_NEAR(between, 0.25, 1e-5);
    }
}

TEST(Wavelengths, EndsOfTheUnitIntervalStayVisible) {
    for (const float u : {0.f, 0.25f, 0.99999994f}) {
        const Wavelengths w = Wavelengths::sample(u);
        for (int i = 0; i < 4; ++i) {
            EXPECT_GE(w.lambda[i], visible_min);
            EXPECT_LE(w.lambda[i], visible_max);
            EXPECT_GT(w.pdf[i], 0.f);
        }
    }
}

TEST(Wavelengths, MeanWeighsTheThreeBandsAlikeAndIgnoresTheFourthLane) {
    EXPECT_FLOAT_EQ(mean(Spectral(1.f, 2.f, 6.f, 1000.f), Wavelengths::rgb_bands()), 3.f);
    EXPECT_FLOAT_EQ(mean(Spectral(1.f, 2.f, 6.f, 7.f), Wavelengths::sample(0.3f)), 4.f);
    EXPECT_FLOAT_EQ(mean(Spectral(1.f, 2.f, 6.f, 7.f), Wavelengths::at(500.f)), 4.f);
}

// The mean of the one-sample colour over wavelengths is the integral over wavelengths.
TEST(Wavelengths, ColourEstimateIsUnbiased) {
    const SpectrumPtr lamp = make_blackbody(2856.f, 1e-3f);
    const Vec3f expected = lamp->rgb();
    Random rng(stream_key(21, 0));
    const int n = 400000;
    Vec3d sum, squares;
    for (int i = 0; i < n; ++i) {
        const Wavelengths w = Wavelengths::sample(rng.next());
        const Vec3d c(to_rgb(lamp->eval(w), w));
        sum += c, squares += c * c;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double mean = sum[k] / n;
        const double error = std::sqrt((squares[k] / n - mean * mean) / n);
        EXPECT_NEAR(mean, expected[k], 4. * error) << "component " << k;
        EXPECT_LT(error, 0.005 * expected.y) << "the test would not see a bias";
    }
}

}  // namespace nacre
