#include "nacre/math/sampling.h"

#include <gtest/gtest.h>

#include "nacre/math/random.h"
#include "tests/support/constants.h"
#include "tests/support/statistics.h"

namespace nacre {

namespace {

// Counts of n samples on a grid over [0, 1)^2 that `to_cell` maps uniformly distributed results to.
template <class Sample>
testing::AssertionResult uniform_after(std::uint64_t seed, Sample to_cell) {
    Random rng(stream_key(seed, 0));
    const int n = 1 << 18, side = 24;
    std::vector<double> count(side * side), expected(side * side, double(n) / (side * side));
    for (int i = 0; i < n; ++i) {
        const Vec2f u = rng.next2();
        const Vec2<double> c = to_cell(Vec2<double>{u.x, u.y});
        const auto at = [](double v) {
            return static_cast<std::size_t>(std::clamp(v, 0., 1. - 1e-12) * side);
        };
        ++count[at(c.x) * side + at(c.y)];
    }
    return test::chi_square_passes(count, expected);
}

double turn(double y, double x) { return std::atan2(y, x) / (2. * pi) + 0.5; }

}  // namespace

// Each test inverts the distribution analytically: what is uniform must come out uniform.

TEST(Sampling, DiskIsUniform) {
    EXPECT_TRUE(uniform_after(1, [](Vec2<double> u) {
        const Vec2<double> p = square_to_disk(u);
        return Vec2<double>{p.x * p.x + p.y * p.y, turn(p.y, p.x)};
    }));
    EXPECT_NEAR(disk_pdf<double>() * pi, 1., 1e-15);
}

TEST(Sampling, CosineHemisphereHasItsDensity) {
    EXPECT_TRUE(uniform_after(2, [](Vec2<double> u) {
        const Vec3d w = square_to_cosine_hemisphere(u);
        EXPECT_NEAR(length(w), 1., 1e-12);
        return Vec2<double>{w.z * w.z, turn(w.y, w.x)};  // P(cos < c) = c^2
    }));
    EXPECT_NEAR(cosine_hemisphere_pdf(0.5), 0.5 / pi, 1e-15);
    EXPECT_EQ(cosine_hemisphere_pdf(-0.5), 0.);
}

TEST(Sampling, SphereAndHemisphereAreUniform) {
    EXPECT_TRUE(uniform_after(3, [](Vec2<double> u) {
        const Vec3d w = square_to_sphere(u);
        EXPECT_NEAR(length(w), 1., 1e-12);
        return Vec2<double>{0.5 * (w.z + 1.), turn(w.y, w.x)};
    }));
    EXPECT_TRUE(uniform_after(4, [](Vec2<double> u) {
        const Vec3d w = square_to_hemisphere(u);
        return Vec2<double>{w.z, turn(w.y, w.x)};
    }));
    EXPECT_NEAR(sphere_pdf<double>() * 4. * pi, 1., 1e-15);
    EXPECT_NEAR(hemisphere_pdf<double>() * 2. * pi, 1., 1e-15);
}

TEST(Sampling, ConeIsUniformAndStaysInside) {
    for (const double cos_max : {-0.5, 0.3, 0.99}) {
        EXPECT_TRUE(uniform_after(5, [=](Vec2<double> u) {
            const Vec3d w = square_to_cone(u, cos_max);
            EXPECT_GE(w.z, cos_max - 1e-12);
            return Vec2<double>{(1. - w.z) / (1. - cos_max), turn(w.y, w.x)};
        })) << cos_max;
        EXPECT_NEAR(cone_pdf(cos_max) * 2. * pi * (1. - cos_max), 1., 1e-14);
    }
}

TEST(Sampling, NarrowConesKeepTheirShapeInSinglePrecision) {
    // The sun: half a degree wide. The edge of the cone must be at the angle asked for.
    const float cos_max = std::cos(0.004654f);
    const Vec3f edge = square_to_cone(Vec2f{0.99999994f, 0.25f}, cos_max);
    EXPECT_NEAR(std::hypot(edge.x, edge.y), std::sqrt(2. * (1. - double(cos_max))), 1e-7);
}

TEST(Sampling, TriangleIsUniform) {
    EXPECT_TRUE(uniform_after(6, [](Vec2<double> u) {
        const Vec2<double> b = square_to_triangle(u);
        EXPECT_GE(b.x, 0.);
        EXPECT_GE(b.y, 0.);
        EXPECT_LE(b.x + b.y, 1. + 1e-12);
        // P(x + y < s) = s^2, and x / (x + y) is uniform.
        const double s = b.x + b.y;
        return Vec2<double>{s * s, s > 0. ? b.x / s : 0.};
    }));
}

TEST(Sampling, CornersOfTheSquareMapToFinitePoints) {
    for (const float x : {0.f, 0.5f, 0.99999994f})
        for (const float y : {0.f, 0.5f, 0.99999994f}) {
            const Vec2f u{x, y};
            EXPECT_NEAR(length(square_to_sphere(u)), 1.f, 1e-6f);
            EXPECT_NEAR(length(square_to_cosine_hemisphere(u)), 1.f, 1e-6f);
            EXPECT_GE(square_to_cosine_hemisphere(u).z, 0.f);
        }
}

}  // namespace nacre
