// The single steps of FLIP, by hand.
#include <gtest/gtest.h>

#include <numeric>

#include "nacre/metrics/flip.h"
#include "nacre/metrics/flip_color.h"
#include "nacre/metrics/flip_filters.h"

namespace nacre {
namespace {

using namespace flip_steps;

double sum(const std::vector<float>& taps) { return std::accumulate(taps.begin(), taps.end(), 0.); }

void expect_near(Vec3f a, Vec3f b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

}  // namespace

TEST(FlipColor, WhiteAndPrimariesAreWhereTheyAre) {
    expect_near(to_ycxcz({1.f, 1.f, 1.f}), {100.f, 0.f, 0.f}, 1e-4f);
    expect_near(hunt_lab({1.f, 1.f, 1.f}), {100.f, 0.f, 0.f}, 1e-4f);
    expect_near(hunt_lab({0.f, 0.f, 0.f}), {0.f, 0.f, 0.f}, 1e-4f);
    expect_near(to_ycxcz({0.f, 0.f, 0.f}), {-16.f, 0.f, 0.f}, 1e-4f);
    // CIELab of sRGB green and blue, (87.7347, -86.1827, 83.1793) and (32.2970, 79.1875,
    // -107.8602) in any table of colours, chroma times 0.01 L*.
    expect_near(hunt_lab({0.f, 1.f, 0.f}), {87.7347f, -75.6122f, 72.9771f}, 0.02f);
    expect_near(hunt_lab({0.f, 0.f, 1.f}), {32.2970f, 25.5752f, -34.8356f}, 0.02f);
}

TEST(FlipColor, TheOpponentSpaceIsUndone) {
    for (const Vec3f rgb : {Vec3f(0.2f, 0.5f, 0.9f), Vec3f(1.f, 0.f, 0.f), Vec3f(0.f, 0.f, 0.f)})
        expect_near(from_ycxcz(to_ycxcz(rgb)), rgb, 1e-6f);
    // Luminance of BT.709: Y = 0.2126 R + 0.7152 G + 0.0722 B.
    EXPECT_NEAR(to_ycxcz({1.f, 0.f, 0.f}).x, 116.f * 0.2126f - 16.f, 0.01f);
    EXPECT_NEAR(to_ycxcz({0.f, 0.f, 1.f}).x, 116.f * 0.0722f - 16.f, 0.01f);
}

TEST(FlipColor, DistancesBecomeErrors) {
    EXPECT_FLOAT_EQ(hyab({50.f, 3.f, 0.f}, {40.f, 0.f, 4.f}), 15.f);
    // |87.7347 - 32.2970| + sqrt((75.6122 + 25.5752)^2 + (72.9771 + 34.8356)^2) = 203.297; ^0.7
    EXPECT_NEAR(largest_distance_power(), 41.276f, 0.003f);
    const float c_max = largest_distance_power();
    EXPECT_EQ(redistribute(0.f), 0.f);
    EXPECT_NEAR(redistribute(0.2f * c_max), 0.475f, 1e-6f);
    EXPECT_NEAR(redistribute(0.4f * c_max), 0.95f, 1e-6f);
    EXPECT_NEAR(redistribute(0.7f * c_max), 0.975f, 1e-6f);
    EXPECT_NEAR(redistribute(c_max), 1.f, 1e-6f);
}

TEST(FlipFilters, FilteringIsAConvolutionThatContinuesTheBorder) {
    const std::vector<float> across = {0.125f, 0.5f, 0.25f}, down = {0.f, 1.f, 0.5f};
    Plane impulse{7, 5, std::vector<float>(35)};
    impulse.data[2 * 7 + 3] = 1.f;
    const Plane r = filter(impulse, across, down);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            const bool inside = std::abs(x - 3) < 2 && std::abs(y - 2) < 2;
            EXPECT_EQ(r.data[std::size_t(y * 7 + x)],
                      inside ? across[std::size_t(x - 2)] * down[std::size_t(y - 1)] : 0.f);
        }
    const Plane two{2, 1, {1.f, 0.f}};
    const std::vector<float> one = {1.f};
    // sum over k of across[k] v(x - k): the right tap falls on the continued left border.
    EXPECT_EQ(filter(two, across, one).data, (std::vector<float>{0.75f, 0.25f}));
}

TEST(FlipFilters, ContrastSensitivityFollowsItsGaussians) {
    const auto a = contrast_sensitivity(Opponent::achromatic, flip_pixels_per_degree);
    const auto rg = contrast_sensitivity(Opponent::red_green, flip_pixels_per_degree);
    const auto by = contrast_sensitivity(Opponent::blue_yellow, flip_pixels_per_degree);
    ASSERT_EQ(a.size(), 1u);
    ASSERT_EQ(rg.size(), 1u);
    ASSERT_EQ(by.size(), 2u);
    // 3 sqrt(0.04 / (2 pi^2)) 67.02 = 9.05, rounded up: 10 pixels to each side.
    for (const SpatialFilter& f : {a[0], rg[0], by[0], by[1]}) {
        EXPECT_EQ(f.taps.size(), 21u);
        EXPECT_NEAR(sum(f.taps), 1., 1e-6);
    }
    // One pixel from the centre: exp(-pi^2 / (b 67.02^2)), 67.02^2 = 4491.76.
    EXPECT_NEAR(a[0].taps[11] / a[0].taps[10], std::exp(-9.8696044 / (0.0047 * 4491.76)), 1e-5);
    EXPECT_NEAR(rg[0].taps[9] / rg[0].taps[10], std::exp(-9.8696044 / (0.0053 * 4491.76)), 1e-5);
    EXPECT_NEAR(by[0].taps[11] / by[0].taps[10], std::exp(-9.8696044 / (0.04 * 4491.76)), 1e-5);
    EXPECT_NEAR(by[1].taps[11] / by[1].taps[10], std::exp(-9.8696044 / (0.025 * 4491.76)), 1e-5);
    // The integral of a sqrt(pi / b) exp(-pi^2 r^2 / b) is proportional to a sqrt(b): 34.1 * 0.2
    // to 13.5 * 0.158114. The filters end at 3.3 sigma and lose less than 0.3 %.
    EXPECT_EQ(a[0].weight, 1.f);
    EXPECT_NEAR(by[0].weight, 6.82 / (6.82 + 2.13454), 1e-3);
    EXPECT_NEAR(by[0].weight + by[1].weight, 1., 1e-6);
}

TEST(FlipFilters, FeaturesOfAStepAndOfNothing) {
    const FeatureTaps t = feature_taps(flip_pixels_per_degree);
    EXPECT_EQ(t.smooth.size(), 19u);  // 3 * 0.041 * 67.02 = 8.24, rounded up: 9
    EXPECT_NEAR(sum(t.smooth), 1., 1e-6);
    for (const std::vector<float>* taps : {&t.edge, &t.point}) {
        double positive = 0., negative = 0.;
        for (const float v : *taps) (v > 0.f ? positive : negative) += double(v);
        EXPECT_NEAR(positive, 1., 1e-6);
        EXPECT_NEAR(negative, -1., 1e-6);
    }
    // sigma^2 = (0.041 * 67.0206)^2 = 7.55068: smooth and point by hand.
    EXPECT_NEAR(t.smooth[10] / t.smooth[9], std::exp(-0.5 / 7.55068), 1e-5);
    EXPECT_NEAR(t.point[10] / t.point[9], (1. - 1. / 7.55068) * std::exp(-0.5 / 7.55068), 1e-5);
    EXPECT_NEAR(t.edge[11] / t.edge[10], 2. * std::exp(-1.5 / 7.55068), 1e-5);
    // The pixels beside a step from 0 to 1 have all positive or all negative taps on 1.
    Plane step{40, 3, std::vector<float>(120)};
    for (int i = 0; i < 120; ++i) step.data[std::size_t(i)] = i % 40 < 20 ? 0.f : 1.f;
    const Plane edge = filter(step, t.edge, t.smooth);
    EXPECT_NEAR(std::abs(edge.data[40 + 19]), 1.f, 1e-5f);
    EXPECT_NEAR(std::abs(edge.data[40 + 20]), 1.f, 1e-5f);
    EXPECT_NEAR(edge.data[40 + 5], 0.f, 1e-6f);
    EXPECT_NEAR(filter(step, t.smooth, t.edge).data[40 + 20], 0.f, 1e-6f);
}

}  // namespace nacre
