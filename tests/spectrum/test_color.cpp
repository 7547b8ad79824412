#include "nacre/spectrum/color.h"

#include <gtest/gtest.h>

#include <fstream>

#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/photometry.h"

namespace nacre {

namespace {

void expect_near(Vec3f a, Vec3f b, float tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

}  // namespace

TEST(Color, DaylightIsWhite) {
    expect_near(xyz_to_rgb(integrate_xyz(d65_unit)), {1.f, 1.f, 1.f}, 1e-5f);
}

TEST(Color, DaylightHasThePublishedChromaticity) {
    const Vec3f white = integrate_xyz(cie_d65);
    const float sum = white.x + white.y + white.z;
    EXPECT_NEAR(white.x / sum, 0.31272f, 1e-4f);  // CIE 15
    EXPECT_NEAR(white.y / sum, 0.32903f, 1e-4f);
}

TEST(Color, DaylightAgreesWithTheModelItWasMadeFrom) {
    // CIE 15: S0 + M1 S1 + M2 S2 at 6504 K, with the tables' values at four wavelengths.
    const double t = 6504.;
    const double x = 0.244063 + 0.09911e3 / t + 2.9678e6 / (t * t) - 4.6070e9 / (t * t * t);
    const double y = -3. * x * x + 2.870 * x - 0.275, m = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    const double rows[][4] = {{400., 94.8, 43.4, -1.1},
                              {560., 100., 0., 0.},
                              {600., 90.5, -5.8, 3.2},
                              {700., 74.3, -13.3, 9.6}};
    for (const auto& r : rows) {
        EXPECT_NEAR(cie_d65(float(r[0])), r[1] + m1 * r[2] + m2 * r[3], 0.35) << r[0];
    }
}

TEST(Color, SpectrumOfOneHasUnitLuminance) {
    const Vec3f xyz = integrate_xyz([](float) { return 1.f; });
    expect_near(xyz, {1.f, 1.f, 1.f}, 1e-3f);  // the observer's three integrals are alike to 0.03 %
    EXPECT_NEAR(xyz.y, 1.f, 1e-6f);
}

TEST(Color, MatrixFollowsFromThePrimariesAndTheWhiteOfTheTable) {
    // Each primary's chromaticity, and that all three together are D65.
    const float chromaticity[3][2] = {{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}};
    Vec3f total;
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3f rgb;
        rgb[i] = 1.f;
        const Vec3f xyz = rgb_to_xyz(rgb);
        const float sum = xyz.x + xyz.y + xyz.z;
        EXPECT_NEAR(xyz.x / sum, chromaticity[i][0], 1e-6f);
        EXPECT_NEAR(xyz.y / sum, chromaticity[i][1], 1e-6f);
        total += xyz;
    }
    expect_near(total, integrate_xyz(d65_unit), 1e-5f);
}

TEST(Color, MatricesAreInverseAndNearTheStandards) {
    const Vec3f colour(0.3f, 0.7f, 0.05f);
    expect_near(xyz_to_rgb(rgb_to_xyz(colour)), colour, 1e-6f);
    // IEC 61966-2-1 prints the luminance weights 0.2126, 0.7152, 0.0722.
    EXPECT_NEAR(luminance({1.f, 0.f, 0.f}), 0.2126f, 2e-4f);
    EXPECT_NEAR(luminance({0.f, 1.f, 0.f}), 0.7152f, 2e-4f);
    EXPECT_NEAR(luminance({0.f, 0.f, 1.f}), 0.0722f, 2e-4f);
    EXPECT_NEAR(luminance({1.f, 1.f, 1.f}), 1.f, 1e-6f);
}

TEST(Color, TransferCurveHasThePublishedPoints) {
    EXPECT_NEAR(srgb_encode(0.18f), 0.4613561f, 1e-5f);
    EXPECT_NEAR(srgb_encode(0.001f), 0.01292f, 1e-7f);
    EXPECT_NEAR(srgb_decode(0.5f), 0.2140411f, 1e-6f);
    EXPECT_FLOAT_EQ(srgb_encode(1.f), 1.f);
    for (const float v : {-0.5f, 0.f, 0.002f, 0.0031308f, 0.3f, 2.f})
        EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 1e-6f);
}

TEST(Color, TablesAgreeWithTheOneNanometreObserver) {
    std::ifstream file(NACRE_SHARED_DIR "/data/tables/cie1931_2deg_xyz_1nm.csv");
    if (!file) GTEST_SKIP() << "the shared table of the observer is not here";
    std::string line;
    std::getline(file, line);
    int rows = 0;
    for (float nm, x, y, z; std::getline(file, line); ++rows) {
        ASSERT_EQ(std::sscanf(line.c_str(), "%f,%f,%f,%f", &nm, &x, &y, &z), 4);
        // Exact at the table's own 5 nm; in between linear, off by at most 1 % of the peak.
        expect_near(cie_xyz(nm), {x, y, z}, std::fmod(nm, 5.f) == 0.f ? 1e-6f : 0.018f);
    }
    EXPECT_EQ(rows, 471);
}

TEST(Photometry, EfficienciesPeakWhereTheyShould) {
    EXPECT_FLOAT_EQ(photopic_efficiency(555.f), 1.f);
    EXPECT_NEAR(scotopic_efficiency(507.f), 1.f, 0.003f);  // 5 nm table; the peak is at 507
    EXPECT_EQ(scotopic_efficiency(370.f), 0.f);
    // Scotopic maximum: 683 / V'(555.016 nm) = 1700 lm/W, rounded.
    EXPECT_NEAR(km_photopic / scotopic_efficiency(555.016f), km_scotopic, 3.f);
    // Integrals of V and V', nm (CIE 018:2019).
    EXPECT_NEAR(luminance(*make_constant(1.f)) / km_photopic, 106.857f, 0.01f);
    EXPECT_NEAR(scotopic_luminance(*make_constant(1.f)) / km_scotopic, 97.07f, 0.1f);
}

TEST(Photometry, FreezingPlatinumIsTheOldCandela) {
    // The candela of 1948: a black body at the freezing point of platinum, 2041.4 K on today's
    // scale, has 60 cd/cm^2.
    EXPECT_NEAR(luminance(*make_blackbody(2041.4f)), 6e5f, 0.01f * 6e5f);
}

TEST(Photometry, MonochromaticLightAt555HasItsEfficacy) {
    // One watt per square metre in a triangular line of 2 nm base around 555 nm.
    const auto line =
        make_tabulated({554.f, 555.f, 556.f}, {0.f, 1.f, 0.f}, SpectrumRole::illuminant);
    EXPECT_NEAR(illuminance(*line), 683.f, 1.f);
}

TEST(Photometry, LuminanceOfTheRgbProjectionIsLuminanceOfTheSpectrum) {
    const auto lamp = make_blackbody(3000.f);
    EXPECT_NEAR(photometric_scale * luminance(lamp->rgb()) / luminance(*lamp), 1.f, 1e-5f);
}

}  // namespace nacre
