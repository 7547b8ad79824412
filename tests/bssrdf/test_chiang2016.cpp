#include "nacre/bssrdf/chiang2016.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace nacre {

TEST(Chiang2016, AgreesWithTheReference) {
    std::ifstream file(NACRE_SOURCE_DIR "/tests/bssrdf/data/chiang2016.json");
    const nlohmann::json reference = nlohmann::json::parse(file);
    int checked = 0;
    for (const auto& row : reference["chiang2016"]) {
        const double A = row["A"], d = row["d"];
        const double alpha = Chiang2016<double>::albedo(A);
        const double sigma_t = 1. / (d * Chiang2016<double>::scale(A));
        EXPECT_NEAR(alpha, double(row["alpha"]), 1e-10) << A;
        EXPECT_NEAR(Chiang2016<double>::scale(A), double(row["s"]), 1e-10) << A;
        EXPECT_NEAR(sigma_t, double(row["sigma_t"]), 1e-10) << A;
        EXPECT_NEAR(alpha * sigma_t, double(row["sigma_s"]), 1e-10) << A;
        EXPECT_NEAR(Chiang2016<float>::albedo(float(A)), alpha, 1e-6) << A;
        ++checked;
    }
    EXPECT_EQ(checked, 12);
}

TEST(Chiang2016, FurnaceLosesWhatTheFitLeaves) {
    // The exponent at A = 1 is -5.09406 + 2.61188 - 4.31805 = -6.80023: white is not lossless.
    EXPECT_EQ(Chiang2016<double>::albedo(0.), 0.);
    EXPECT_NEAR(Chiang2016<double>::albedo(1.), 1. - std::exp(-6.80023), 1e-12);
    EXPECT_NEAR(Chiang2016<double>::albedo(1.), 1., 0.0012);
    for (double A = 0.01; A <= 1.; A += 0.01)
        EXPECT_GT(Chiang2016<double>::albedo(A), Chiang2016<double>::albedo(A - 0.01));
}

TEST(Chiang2016, HalfSpaceReturnsTheColour) {
    // Hapke 1981, Bidirectional Reflectance Spectroscopy 1, JGR 86: diffuse reflectance of a half
    // space of isotropic scattering with q = sqrt(1 - alpha), here within 0.0014 of the truth (by
    // adding-doubling). The fit is within 0.005 up to 0.8 and loses 0.074 at 1.
    const auto reflectance = [](double A) {
        const double q = std::sqrt(1. - Chiang2016<double>::albedo(A));
        return (1. - q) / (1. + q) * (1. - q / (3. * (1. + q)));
    };
    for (double A = 0.1; A <= 0.81; A += 0.1) EXPECT_NEAR(reflectance(A), A, 0.0064) << A;
    EXPECT_NEAR(reflectance(1.), 0.926, 0.0019);
}

}  // namespace nacre
