#include "nacre/math/random.h"

#include <gtest/gtest.h>

#include "tests/support/statistics.h"

namespace nacre {

TEST(Random, IsUniform) {
    Random rng(stream_key(1, 2));
    const int n = 1 << 20, cells = 1 << 10;
    std::vector<double> count(cells), expected(cells, double(n) / cells);
    for (int i = 0; i < n; ++i) {
        const float u = rng.next();
        ASSERT_GE(u, 0.f);
        ASSERT_LT(u, 1.f);
        ++count[static_cast<std::size_t>(u * cells)];
    }
    EXPECT_TRUE(test::chi_square_passes(count, expected));
}

TEST(Random, BothNumbersOfAPairAreUniformAndIndependent) {
    Random rng(stream_key(3, 4));
    const int n = 1 << 20, side = 32;
    std::vector<double> count(side * side), expected(side * side, double(n) / (side * side));
    for (int i = 0; i < n; ++i) {
        const Vec2f u = rng.next2();
        ASSERT_LT(std::max(u.x, u.y), 1.f);
        ++count[static_cast<std::size_t>(u.x * side) * side + static_cast<std::size_t>(u.y * side)];
    }
    EXPECT_TRUE(test::chi_square_passes(count, expected));
}

TEST(Random, StreamsOfNeighbouringKeysAreIndependent) {
    // The i-th numbers of streams whose keys differ by one in one place, on a grid.
    for (int place = 0; place < 4; ++place) {
        const int n = 1 << 18, side = 16;
        std::vector<double> count(side * side), expected(side * side, double(n) / (side * side));
        for (int i = 0; i < n; ++i) {
            std::uint64_t a[4] = {7, 11, 13, 17};
            a[place] = static_cast<std::uint64_t>(i);
            Random one(stream_key(a[0], a[1], a[2], a[3]));
            a[place] += 1;
            Random two(stream_key(a[0], a[1], a[2], a[3]));
            ++count[static_cast<std::size_t>(one.next() * side) * side +
                    static_cast<std::size_t>(two.next() * side)];
        }
        EXPECT_TRUE(test::chi_square_passes(count, expected)) << "place " << place;
    }
}

TEST(Random, KeyDistinguishesTheOrderOfItsParts) {
    EXPECT_NE(stream_key(1, 2), stream_key(2, 1));
    EXPECT_NE(stream_key(1, 2, 3, 4), stream_key(1, 2, 4, 3));
    EXPECT_EQ(stream_key(1, 2, 3, 4), stream_key(1, 2, 3, 4));
}

TEST(Random, EveryInputBitOfTheMixerMovesHalfTheOutput) {
    for (int bit = 0; bit < 64; ++bit) {
        int flipped = 0;
        const int n = 256;
        for (int i = 0; i < n; ++i) {
            const std::uint64_t v = stream_key(static_cast<std::uint64_t>(i), 5);
            flipped += __builtin_popcountll(mix_bits(v) ^ mix_bits(v ^ (1ull << bit)));
        }
        // 64 n fair coins: five standard deviations are 2.5 * sqrt(64 n) = 320.
        EXPECT_NEAR(flipped, 32 * n, 320) << "bit " << bit;
    }
}

}  // namespace nacre
