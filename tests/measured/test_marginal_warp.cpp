#include "nacre/measured/marginal_warp.h"

#include <gtest/gtest.h>

#include "nacre/math/random.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

/// Four slices of 6 x 5 nodes, uneven, with an empty corner.
std::vector<float> uneven_slices() {
    Random random(stream_key(27, 1));
    std::vector<float> values;
    for (int slice = 0; slice < 4; ++slice)
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 6; ++x)
                values.push_back(x < 2 && y < 2 ? 0.f
                                                : float(std::pow(random.next(), 4.)) * (1 + slice));
    return values;
}

const ParameterGrid two_by_two({-1.f, 1.f}, {0.f, 1.f});

/// None, one or both parameters between their nodes.
std::vector<SliceMix> some_mixes() {
    return {two_by_two.at(-1.f, 0.f), two_by_two.at(-3.f, 0.3f), two_by_two.at(0.5f, 0.8f)};
}

}  // namespace

TEST(ParameterGrid, MixesTheSlicesAround) {
    const ParameterGrid grid({0.f, 2.f, 3.f}, {0.f, 1.f});
    EXPECT_EQ(grid.size(), 6u);
    const SliceMix node = grid.at(2.f, 1.f);
    EXPECT_EQ(node.count, 1);
    EXPECT_EQ(node.slice[0], 3u);
    const SliceMix mix = grid.at(2.25f, 0.5f);
    EXPECT_EQ(mix.count, 4);
    EXPECT_EQ(mix.slice, (std::array<std::uint32_t, 4>{2, 3, 4, 5}));
    EXPECT_EQ(mix.weight, (std::array<float, 4>{0.375f, 0.375f, 0.125f, 0.125f}));
    EXPECT_EQ(grid.at(9.f, -1.f).count, 1);
    EXPECT_EQ(grid.at(9.f, -1.f).slice[0], 4u);
}

TEST(BilinearTable, IsBilinear) {
    const BilinearTable table(3, 2, {0.f, 1.f, 4.f, 2.f, 3.f, 6.f});
    const SliceMix one;
    EXPECT_FLOAT_EQ(table.eval(0.25f, 0.f, one), 0.5f);
    EXPECT_FLOAT_EQ(table.eval(0.75f, 0.5f, one), 3.5f);
    EXPECT_FLOAT_EQ(table.eval(1.f, 1.f, one), 6.f);
}

TEST(MarginalWarp, InvertUndoesSample) {
    const MarginalWarp warp(6, 5, uneven_slices());
    Random random(stream_key(27, 2));
    for (const SliceMix& mix : some_mixes())
        for (int i = 0; i < 20000; ++i) {
            const float u = random.next(), v = random.next();
            const auto to = warp.sample(u, v, mix);
            ASSERT_TRUE(to.x >= 0.f && to.x <= 1.f && to.y >= 0.f && to.y <= 1.f);
            const auto back = warp.invert(to.x, to.y, mix);
            // Where the density is low, a step of x in its last place is a step of u below 1e-6.
            ASSERT_NEAR(back.x, u, 3e-6);
            ASSERT_NEAR(back.y, v, 3e-6);
            ASSERT_NEAR(back.density, to.density, 2e-3f * to.density + 1e-4f);
            ASSERT_NEAR(warp.density(to.x, to.y, mix), back.density, 1e-5f * back.density + 1e-6f);
        }
}

/// The density is the mixture of the slices', each scaled by itself, and its integral is 1.
TEST(MarginalWarp, DensityIsThatOfTheTable) {
    const std::vector<float> values = uneven_slices();
    const MarginalWarp warp(6, 5, values);
    for (const SliceMix& mix : some_mixes()) {
        // Trapezia are exact for what is bilinear.
        double integral = 0.;
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 6; ++x) {
                double want = 0.;
                for (int k = 0; k < mix.count; ++k) {
                    double total = 0.;
                    const float* v = values.data() + mix.slice[k] * 30;
                    for (int j = 0; j < 4; ++j)
                        for (int i = 0; i < 5; ++i)
                            total += (v[j * 6 + i] + v[j * 6 + i + 1] + v[j * 6 + i + 6] +
                                      v[j * 6 + i + 7]) /
                                     80.;
                    want += mix.weight[k] * v[y * 6 + x] / total;
                }
                const double found = warp.density(float(x) / 5.f, float(y) / 4.f, mix);
                EXPECT_NEAR(found, want, 1e-5 * want + 1e-6);
                integral += found * (x % 5 ? 1. : 0.5) * (y % 4 ? 1. : 0.5) / 20.;
            }
        EXPECT_NEAR(integral, 1., 1e-6);
    }
}

TEST(MarginalWarp, SamplesFollowTheDensity) {
    const MarginalWarp warp(6, 5, uneven_slices());
    for (const SliceMix& mix : some_mixes()) {
        constexpr int cells = 12, fine = 30, count = 200000;
        std::vector<double> observed(cells * cells), expected(cells * cells);
        Random random(stream_key(27, 3));
        for (int i = 0; i < count; ++i) {
            const float u = random.next(), v = random.next();
            const auto p = warp.sample(u, v, mix);
            const auto cell = [](float x) { return std::min(int(x * cells), cells - 1); };
            observed[cell(p.y) * cells + cell(p.x)] += 1.;
        }
        for (int y = 0; y < cells * fine; ++y)
            for (int x = 0; x < cells * fine; ++x)
                expected[y / fine * cells + x / fine] +=
                    warp.density((x + 0.5f) / (cells * fine), (y + 0.5f) / (cells * fine), mix) *
                    count / double(cells * cells * fine * fine);
        EXPECT_TRUE(test::chi_square_passes(observed, expected));
    }
}

TEST(MarginalWarp, EmptySlicesAreUniformAndEdgesHold) {
    const MarginalWarp nothing(3, 3, std::vector<float>(9, 0.f));
    const SliceMix one;
    const auto p = nothing.sample(0.3f, 0.7f, one);
    EXPECT_NEAR(p.x, 0.3f, 1e-6);
    EXPECT_NEAR(p.y, 0.7f, 1e-6);
    EXPECT_NEAR(p.density, 1.f, 1e-6);
    // All within the middle: neither end of the unit interval leads to where there is nothing.
    const MarginalWarp middle(
        5, 5, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    for (const float u : {0.f, 0.5f, 0.99999994f, 1.f}) {
        const auto q = middle.sample(u, u, one);
        EXPECT_GE(q.x, 0.25f);
        EXPECT_LE(q.x, 0.75f);
        EXPECT_GE(q.y, 0.25f);
        EXPECT_LE(q.y, 0.75f);
        EXPECT_GT(q.density, 0.f);
    }
    EXPECT_EQ(middle.density(0.1f, 0.1f, one), 0.f);
}

}  // namespace nacre
