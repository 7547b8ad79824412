#include "nacre/math/fast_atan2.h"

#include <gtest/gtest.h>

#include "nacre/math/random.h"

namespace nacre {

TEST(FastAtan2, IsAtan2) {
    Random random(stream_key(27, 20));
    for (int i = 0; i < 100000; ++i) {
        // Of all sizes, near the axes as well.
        const float scale = std::pow(10.f, 12.f * random.next() - 6.f);
        const float y = 2.f * random.next() - 1.f, x = (2.f * random.next() - 1.f) * scale;
        const double want = std::atan2(double(y), double(x));
        ASSERT_NEAR(fast_atan2(y, x), want, 3e-7 * std::abs(want)) << y << " " << x;
        const Lanes<float, 4> pack =
            fast_atan2(Lanes<float, 4>(y, -y, x, 0.f), Lanes<float, 4>(x, x, y, 0.f));
        ASSERT_EQ(pack[0], fast_atan2(y, x));
        ASSERT_EQ(pack[1], fast_atan2(-y, x));
        ASSERT_EQ(pack[2], fast_atan2(x, y));
        ASSERT_EQ(pack[3], 0.f);
    }
    EXPECT_EQ(fast_atan2(0.f, 1.f), 0.f);
    EXPECT_FLOAT_EQ(fast_atan2(0.f, -1.f), 3.14159265f);
    EXPECT_FLOAT_EQ(fast_atan2(-1.f, 0.f), -1.57079633f);
}

}  // namespace nacre
