#include "nacre/math/fast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nacre {

TEST(FastMath, LogarithmIsAccurateFromTheSmallestToTheLargestFreePath) {
    for (int i = 1; i < 1 << 20; ++i) {
        const float x = static_cast<float>(i) * 0x1p-20f;
        const double expected = std::log(static_cast<double>(x));
        ASSERT_NEAR(fast_log(x), expected, 3e-7 * std::max(1e-1, std::abs(expected)))
            << "x = " << x;
    }
    EXPECT_EQ(fast_log(1.f), 0.f);
    EXPECT_NEAR(fast_log(0x1p-24f), -24 * std::numbers::ln2, 1e-5);
}

TEST(FastMath, UnitCircleGoesOnceAround) {
    for (int i = 0; i <= 1 << 16; ++i) {
        const double u = i * 0x1p-16, angle = 2 * std::numbers::pi * u;
        const Vec2f c = fast_unit_circle(static_cast<float>(u));
        ASSERT_NEAR(c.x, std::cos(angle), 2e-7) << "u = " << u;
        ASSERT_NEAR(c.y, std::sin(angle), 2e-7) << "u = " << u;
    }
}

}  // namespace nacre
