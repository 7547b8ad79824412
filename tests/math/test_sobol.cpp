#include "nacre/math/sobol.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/statistics.h"

namespace nacre {

namespace {

using sobol_detail::sobol_bits;

// Whether N = 2^m points put exactly one into each of the N boxes of 2^-a by 2^-(m - a).
bool one_point_per_box(std::uint32_t m, std::uint32_t a, std::uint32_t first_dimension,
                       std::uint32_t seed) {
    std::set<std::pair<int, int>> boxes;
    const std::uint32_t n = 1u << m;
    for (std::uint32_t i = 0; i < n; ++i)
        boxes.insert({int(sobol_owen(i, first_dimension, seed) * float(1u << a)),
                      int(sobol_owen(i, first_dimension + 1, seed) * float(1u << (m - a)))});
    return boxes.size() == n;
}

// Root mean square error, over scramblings, of the mean of a smooth function over four dimensions;
// each factor integrates to 1.
double rms_error(std::uint32_t n, std::uint32_t first_dimension) {
    double sum = 0.;
    const int runs = 64;
    for (std::uint32_t run = 0; run < runs; ++run) {
        double mean = 0.;
        for (std::uint32_t i = 0; i < n; ++i) {
            double f = 1.;
            for (std::uint32_t d = 0; d < 4; ++d) {
                const double x = sobol_owen(i, first_dimension + d, run);
                f *= 1. + 0.5 * (std::exp(x) - (std::exp(1.) - 1.));
            }
            mean += f / n;
        }
        sum += (mean - 1.) * (mean - 1.);
    }
    return std::sqrt(sum / runs);
}

}  // namespace

TEST(Sobol, UnscrambledPointsAreThePublishedOnes) {
    // First points of the first four dimensions, as in Joe and Kuo's generator but in the order of
    // the index itself, not of its Gray code.
    const double expected[4][4] = {
        {0., 0., 0., 0.}, {0.5, 0.5, 0.5, 0.5}, {0.25, 0.75, 0.75, 0.75}, {0.75, 0.25, 0.25, 0.25}};
    for (std::uint32_t i = 0; i < 4; ++i)
        for (std::uint32_t d = 0; d < 4; ++d)
            EXPECT_EQ(sobol_bits(i, d) * 0x1p-32, expected[i][d]) << i << ", " << d;
    // Point 4 is m3 / 8, by hand from Joe and Kuo's recurrence: m3 = 2 m2 ^ m2 = 5; 2 m2 ^ 4 m1 ^
    // m1 = 3; given as 1.
    EXPECT_EQ(sobol_bits(4, 1) * 0x1p-32, 5. / 8);
    EXPECT_EQ(sobol_bits(4, 2) * 0x1p-32, 3. / 8);
    EXPECT_EQ(sobol_bits(4, 3) * 0x1p-32, 1. / 8);
}

TEST(Sobol, FirstTwoDimensionsOfEveryGroupAreANet) {
    for (const std::uint32_t seed : {0u, 1u, 12345u})
        for (const std::uint32_t dimension : {0u, 4u, 40u})
            for (std::uint32_t m = 1; m <= 10; ++m)
                for (std::uint32_t a = 0; a <= m; ++a)
                    ASSERT_TRUE(one_point_per_box(m, a, dimension, seed))
                        << "m " << m << ", a " << a << ", dimension " << dimension;
}

TEST(Sobol, EveryDimensionIsStratified) {
    for (std::uint32_t dimension = 0; dimension < 16; ++dimension) {
        std::set<int> cells;
        for (std::uint32_t i = 0; i < 1024; ++i)
            cells.insert(int(sobol_owen(i, dimension, 99) * 1024.f));
        EXPECT_EQ(cells.size(), 1024u) << "dimension " << dimension;
    }
}

TEST(Sobol, EveryPointIsUniformOverScramblings) {
    // A fixed index and dimension, many seeds, and pairs of dimensions of one and of two groups.
    for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(2u, 3u), std::pair(1u, 5u)}) {
        const int side = 16;
        const std::uint32_t n = 1u << 17;
        std::vector<double> count(side * side), expected(side * side, double(n) / (side * side));
        for (std::uint32_t seed = 0; seed < n; ++seed)
            ++count[std::size_t(sobol_owen(7, a, seed) * side) * side +
                    std::size_t(sobol_owen(7, b, seed) * side)];
        EXPECT_TRUE(test::chi_square_passes(count, expected)) << a << ", " << b;
    }
}

TEST(Sobol, GroupsAreDecorrelated) {
    // The same component of two groups: on a grid the points must fill as independent ones do. An
    // unshuffled repetition would fill the diagonal only.
    const int side = 16;
    const std::uint32_t n = 1u << 14;
    std::vector<double> count(side * side), expected(side * side, double(n) / (side * side));
    for (std::uint32_t i = 0; i < n; ++i)
        ++count[std::size_t(sobol_owen(i, 0, 3) * side) * side +
                std::size_t(sobol_owen(i, 4, 3) * side)];
    EXPECT_TRUE(test::chi_square_passes(count, expected));
}

TEST(Sobol, ErrorFallsFasterThanInversely) {
    for (const std::uint32_t dimension : {0u, 8u}) {
        const double order = std::log2(rms_error(64, dimension) / rms_error(4096, dimension)) / 6.;
        EXPECT_GT(order, 1.2) << "from dimension " << dimension;  // plain random numbers: 0.5
    }
}

}  // namespace nacre
