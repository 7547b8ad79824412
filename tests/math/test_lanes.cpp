#include "nacre/math/lanes.h"

#include <gtest/gtest.h>

#include "nacre/math/lanes_math.h"

namespace nacre {

TEST(Lanes, ArithmeticActsOnEachLane) {
    const Spectral a(1.f, 2.f, 3.f, 4.f), b(4.f, 3.f, 2.f, 1.f);
    EXPECT_FLOAT_EQ((a / b)[0], 0.25f);
    EXPECT_FLOAT_EQ((2.f * a - b)[3], 7.f);
    EXPECT_FLOAT_EQ(sum(a), 10.f);
    EXPECT_FLOAT_EQ(max_lane(select(a < b, b, Spectral(0.f))), 4.f);
}

TEST(Lanes, TranscendentalFunctionsAgreeWithTheStandardLibrary) {
    const Spectral x(0.1f, 1.f, 2.5f, 7.f);
    for (int i = 0; i < 4; ++i) {
        EXPECT_FLOAT_EQ(exp(x)[i], std::exp(x[i]));
        EXPECT_FLOAT_EQ(log(x)[i], std::log(x[i]));
        EXPECT_FLOAT_EQ(pow(x, Spectral(2.2f))[i], std::pow(x[i], 2.2f));
        EXPECT_NEAR(sin(x)[i], std::sin(x[i]), 1e-6f);
        EXPECT_NEAR(cos(x)[i], std::cos(x[i]), 1e-6f);
    }
}

}  // namespace nacre
