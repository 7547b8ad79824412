#include "nacre/math/fast_wide.h"

#include <gtest/gtest.h>

#include <numbers>

#include "nacre/math/fast.h"
#include "tests/support/statistics.h"

namespace nacre {

namespace {

#if defined(__AVX512F__)
constexpr int width = 16;
#else
constexpr int width = 8;
#endif
using Pack = Lanes<float, width>;

}  // namespace

TEST(FastWide, LogarithmIsThatOfEachLane) {
    for (double x = 1e-10; x < 1e10; x *= 1.7) {
        Pack p;
        for (int i = 0; i < width; ++i) p.set(i, float(x * (1. + 0.04 * i)));
        const Pack r = fast_log(p);
        for (int i = 0; i < width; ++i) {
            const double exact = std::log(double(p[i]));
            EXPECT_NEAR(r[i], exact, 3e-7 * std::abs(exact) + 1e-12) << p[i];
        }
    }
    EXPECT_EQ(fast_log(Pack(1.f))[0], 0.f);
}

TEST(FastWide, UnitCircleIsThatOfEachLane) {
    for (int k = 0; k <= 1000; k += width) {
        Pack u;
        for (int i = 0; i < width; ++i) u.set(i, float(std::min(k + i, 1000)) / 1000.f);
        const auto c = fast_unit_circle(u);
        for (int i = 0; i < width; ++i) {
            const double angle = 2. * std::numbers::pi * double(u[i]);
            EXPECT_NEAR(c.cos[i], std::cos(angle), 2e-7) << u[i];
            EXPECT_NEAR(c.sin[i], std::sin(angle), 2e-7) << u[i];
        }
    }
}

TEST(FastWide, SquareRootIsRounded) {
    Pack x;
    for (int i = 0; i < width; ++i) x.set(i, 0.37f * float(i * i * i));
    const Pack r = fast_sqrt(x);
    for (int i = 0; i < width; ++i) EXPECT_EQ(r[i], std::sqrt(x[i]));
}

TEST(FastWide, MasksAreBits) {
    Pack x;
    for (int i = 0; i < width; ++i) x.set(i, float(i));
    EXPECT_EQ(bits(x < Pack(3.f)), 0b111u);
    EXPECT_EQ(bits(x == Pack(float(width - 1))), 1u << (width - 1));
    EXPECT_EQ(bits(x < Pack(0.f)), 0u);
    for (const std::uint32_t set : {0u, 1u, 0x81u, 0xffu})
        EXPECT_EQ(bits(lanes_of<width>(set)), set);
    std::vector<int> seen;
    for_each_bit(0x92u, [&](int i) { seen.push_back(i); });
    EXPECT_EQ(seen, (std::vector<int>{1, 4, 7}));
}

TEST(FastWide, RandomNumbersAreUniformAndIndependent) {
    RandomLanes<width> random(42);
    constexpr int draws = 200000 / width, cells = 64;
    std::vector<double> one(cells), pairs(cells), neighbours(cells);
    Pack last = random.next();
    for (int k = 0; k < draws; ++k) {
        const Pack u = random.next();
        for (int i = 0; i < width; ++i) {
            ASSERT_GT(u[i], 0.f);
            ASSERT_LT(u[i], 1.f);
            const auto in = [](float x, int n) { return int(x * float(n)); };
            ++one[std::size_t(in(u[i], cells))];
            ++pairs[std::size_t(8 * in(last[i], 8) + in(u[i], 8))];
            ++neighbours[std::size_t(8 * in(u[i], 8) + in(u[(i + 1) % width], 8))];
        }
        last = u;
    }
    const std::vector<double> expected(cells, double(draws) * width / cells);
    EXPECT_TRUE(test::chi_square_passes(one, expected));
    EXPECT_TRUE(test::chi_square_passes(pairs, expected));
    EXPECT_TRUE(test::chi_square_passes(neighbours, expected));
    // A stream is its key's.
    RandomLanes<width> same(42), other(43);
    RandomLanes<width> again(42);
    EXPECT_EQ(same.next()[0], again.next()[0]);
    EXPECT_NE(same.next()[0], other.next()[0]);
}

}  // namespace nacre
