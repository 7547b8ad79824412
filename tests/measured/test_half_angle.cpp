#include "nacre/measured/half_angle.h"

#include <gtest/gtest.h>

#include <numbers>

#include "nacre/math/random.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

}  // namespace

TEST(HalfAngle, KnownPairs) {
    // In the plane of incidence the half vector bisects, and the difference vector leans with it.
    HalfAngle a = to_half_angle(direction(70. * degree, 0.), direction(10. * degree, 0.));
    EXPECT_NEAR(a.theta_h, 40. * degree, 1e-14);
    EXPECT_NEAR(a.phi_h, 0., 1e-14);
    EXPECT_NEAR(a.theta_d, 30. * degree, 1e-14);
    EXPECT_NEAR(a.phi_d, 0., 1e-14);
    // The mirror direction: the half vector is the normal, theta_d the angle of incidence.
    a = to_half_angle(direction(50. * degree, 1.), direction(50. * degree, 1. + std::numbers::pi));
    EXPECT_NEAR(a.theta_h, 0., 1e-14);
    EXPECT_NEAR(a.theta_d, 50. * degree, 1e-14);
    // Back towards the light.
    a = to_half_angle(direction(50. * degree, 2.), direction(50. * degree, 2.));
    EXPECT_NEAR(a.theta_h, 50. * degree, 1e-14);
    EXPECT_NEAR(a.phi_h, 2., 1e-14);
    EXPECT_NEAR(a.theta_d, 0., 1e-7);
    // Light and viewer to the two sides of the half vector, which leans along x.
    const Vec3d h = direction(30. * degree, 0.), y{0., 1., 0.};
    a = to_half_angle(h * std::cos(0.5) + y * std::sin(0.5), h * std::cos(0.5) - y * std::sin(0.5));
    EXPECT_NEAR(a.theta_h, 30. * degree, 1e-14);
    EXPECT_NEAR(a.theta_d, 0.5, 1e-14);
    EXPECT_NEAR(a.phi_d, 90. * degree, 1e-14);
}

TEST(HalfAngle, ThereAndBack) {
    Random random(stream_key(1, 1));
    for (int i = 0; i < 1000; ++i) {
        const Vec3d wi = direction(1.57 * random.next(), 6.28 * random.next());
        const Vec3d wo = direction(1.57 * random.next(), 6.28 * random.next());
        const DirectionPair pair = from_half_angle(to_half_angle(wi, wo));
        expect_near(pair.wi, wi, 1e-12);
        expect_near(pair.wo, wo, 1e-12);
    }
}

// Exchanging the directions turns phi_d by half a circle; turning the surface changes phi_h alone.
TEST(HalfAngle, Symmetries) {
    Random random(stream_key(1, 2));
    for (int i = 0; i < 200; ++i) {
        const double ti = 0.1 + 1.3 * random.next(), to = 0.1 + 1.3 * random.next();
        const double pi_ = 3. * random.next(), po = pi_ + 0.3 + 2. * random.next();
        const HalfAngle a = to_half_angle(direction(ti, pi_), direction(to, po));
        const HalfAngle b = to_half_angle(direction(to, po), direction(ti, pi_));
        const HalfAngle c = to_half_angle(direction(ti, pi_ + 0.7), direction(to, po + 0.7));
        EXPECT_NEAR(a.theta_h, b.theta_h, 1e-12);
        EXPECT_NEAR(a.theta_d, b.theta_d, 1e-12);
        EXPECT_NEAR(std::abs(a.phi_d - b.phi_d), std::numbers::pi, 1e-9);
        EXPECT_NEAR(a.theta_h, c.theta_h, 1e-12);
        EXPECT_NEAR(a.theta_d, c.theta_d, 1e-12);
        EXPECT_NEAR(a.phi_d, c.phi_d, 1e-9);
        EXPECT_NEAR(std::remainder(c.phi_h - a.phi_h - 0.7, 2. * std::numbers::pi), 0., 1e-9);
    }
}

}  // namespace nacre
