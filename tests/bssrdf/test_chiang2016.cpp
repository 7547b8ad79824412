#include "nacre/bssrdf/chiang2016.h"

#include <gtest/gtest.h>

namespace nacre {

TEST(Chiang2016, FurnaceLosesWhatTheFitLeaves) {
    // The exponent at A = 1 is -5.09406 + 2.61188 - 4.31805 = -6.80023: white is not lossless.
    EXPECT_EQ(chiang2016_single_albedo(0.), 0.);
    EXPECT_NEAR(chiang2016_single_albedo(1.), 1. - std::exp(-6.80023), 1e-12);
    EXPECT_NEAR(chiang2016_single_albedo(1.), 1., 0.0012);
    for (double a = 0.01; a <= 1.; a += 0.01)
        EXPECT_GT(chiang2016_single_albedo(a), chiang2016_single_albedo(a - 0.01));
}

TEST(Chiang2016, HalfSpaceReturnsTheColour) {
    // Hapke 1981, Bidirectional Reflectance Spectroscopy 1, JGR 86: diffuse reflectance of a half
    // space of isotropic scattering with q = sqrt(1 - alpha), here within 0.0014 of the truth (by
    // adding-doubling). The fit is within 0.005 up to 0.8 and loses 0.074 at 1.
    const auto reflectance = [](double a) {
        const double q = std::sqrt(1. - chiang2016_single_albedo(a));
        return (1. - q) / (1. + q) * (1. - q / (3. * (1. + q)));
    };
    for (double a = 0.1; a <= 0.81; a += 0.1) EXPECT_NEAR(reflectance(a), a, 0.0064) << a;
    EXPECT_NEAR(reflectance(1.), 0.926, 0.0019);
}

}  // namespace nacre
