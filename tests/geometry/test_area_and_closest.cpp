// Uniform points by area, and nearest points, against closed forms.

#include "nacre/geometry/closest_point.h"
#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/ray_scene.h"
#include "tests/geometry/shapes.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using test::random_direction;
using test::share;

struct Moments {
    double area = 0;
    Vec3d mean, square;
};

// First and second moments weighted by 1 / pdf, which gives the area's own integrals even where
// samples are not exactly uniform.
Moments moments(const RayScene& scene, std::uint32_t shape, int n) {
    Random random(11);
    Moments m;
    for (int i = 0; i < n; ++i) {
        const AreaSample s = scene.sample_area(shape, random.next2());
        const Vec3d p(s.p);
        const double w = 1.0 / s.pdf / n;
        m.area += w;
        m.mean += p * w;
        m.square += p * p * w;
        EXPECT_NEAR(length(s.n), 1, 1e-5);
    }
    m.mean = m.mean / m.area;
    m.square = m.square / m.area;
    return m;
}

// Tolerances are five standard errors: second moments of coordinates within [-1, 1] have a
// variance below 1/4, so 5 * 0.5 / sqrt(200000) = 0.0056.
constexpr int kSamples = 200000;
constexpr double kTolerance = 0.0056;

TEST(SampleArea, SphereDiskCylinderMoments) {
    RayScene scene;
    scene.add(Sphere{{0, 0, 0}, 1.f});
    scene.add(Disk{});
    scene.add(Cylinder{});
    scene.build();
    EXPECT_NEAR(scene.area(0), 4 * pi, 1e-12);
    EXPECT_NEAR(scene.area(1), pi, 1e-12);
    EXPECT_NEAR(scene.area(2), 2 * pi, 1e-12);
    const Moments sphere = moments(scene, 0, kSamples), disk = moments(scene, 1, kSamples),
                  cylinder = moments(scene, 2, kSamples);
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(sphere.mean[a], 0, kTolerance);
        EXPECT_NEAR(sphere.square[a], 1 / 3., kTolerance);
    }
    EXPECT_NEAR(disk.square.x, 0.25, kTolerance);
    EXPECT_NEAR(disk.square.y, 0.25, kTolerance);
    EXPECT_NEAR(disk.square.z, 0, 1e-12);
    EXPECT_NEAR(cylinder.square.x, 0.5, kTolerance);
    EXPECT_NEAR(cylinder.mean.z, 0.5, kTolerance);
    EXPECT_NEAR(cylinder.square.z, 1 / 3., kTolerance);
}

TEST(SampleArea, EllipticCylinderIsUniformByArea) {
    RayScene scene;
    scene.add(Cylinder{Transform::scale({1, 0.25, 1})});
    scene.build();
    // Perimeter of the ellipse and the integral of x^2 along it, by a fine polygon.
    double perimeter = 0, xx = 0;
    const int n = 1000000;
    for (int i = 0; i < n; ++i) {
        const double a = 2 * pi * i / n, b = 2 * pi * (i + 1) / n;
        const double ds = std::hypot(std::cos(b) - std::cos(a), 0.25 * (std::sin(b) - std::sin(a)));
        perimeter += ds;
        xx += ds * std::pow(std::cos((a + b) / 2), 2);
    }
    EXPECT_NEAR(scene.area(0), perimeter, 1e-6);
    const Moments m = moments(scene, 0, kSamples);
    EXPECT_NEAR(m.area, perimeter, 1e-3);
    EXPECT_NEAR(m.square.x, xx / perimeter, kTolerance);
    // Nearly constant density, too.
    Random random(3);
    for (int i = 0; i < 1000; ++i)
        ASSERT_NEAR(scene.sample_area(0, random.next2()).pdf * perimeter, 1, 0.02);
}

TEST(SampleArea, MeshMomentsAndSubtriangleDetail) {
    RayScene scene;
    scene.add(share(make_cube()));
    scene.add(share(make_rectangle()), false, true);
    scene.build();
    EXPECT_NEAR(scene.area(0), 24, 1e-12);
    const Moments cube = moments(scene, 0, kSamples);
    // A side at +-1 for a third of the area, uniform on [-1,1] for the rest: 1/3 + 2/3 * 1/3.
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(cube.mean[a], 0, 2 * kTolerance);
        EXPECT_NEAR(cube.square[a], 5 / 9., kTolerance);
    }
    const Moments square = moments(scene, 1, kSamples);
    EXPECT_NEAR(square.square.x, 1 / 3., kTolerance);
    EXPECT_NEAR(square.square.y, 1 / 3., kTolerance);
    EXPECT_EQ(scene.sample_area(1, {0.3f, 0.6f}).n, (Vec3f{0, 0, -1}));
    // The extreme numbers stay inside.
    for (const float u : {0.f, 0x1.fffffep-1f})
        for (const float v : {0.f, 0x1.fffffep-1f})
            for (std::uint32_t shape : {0u, 1u}) {
                const Point3f p = scene.sample_area(shape, {u, v}).p;
                EXPECT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.f);
            }
}

TEST(Closest, TriangleAgainstDenseSampling) {
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        Vec3d p[4];
        for (Vec3d& v : p) v = Vec3d(random_direction(random)) * (2.0 * random.next());
        if (i % 10 == 0) p[3] = p[1] + (p[2] - p[1]) * 0.5;  // flat
        if (i % 25 == 0) p[3] = p[2] = p[1];                 // a point
        const AnalyticHit hit = closest_on_triangle(p[0], p[1], p[2], p[3]);
        const Vec3d at = p[1] + (p[2] - p[1]) * double(hit.u) + (p[3] - p[1]) * double(hit.v);
        EXPECT_NEAR(length(at - p[0]), hit.t, 1e-6);
        double best = 1e30;
        const int n = 200;
        for (int a = 0; a <= n; ++a)
            for (int b = 0; a + b <= n; ++b)
                best = std::min(best, length(p[1] + (p[2] - p[1]) * (double(a) / n) +
                                             (p[3] - p[1]) * (double(b) / n) - p[0]));
        EXPECT_LE(hit.t, best + 1e-12);
        EXPECT_GT(hit.t, best - 0.04);  // the spacing of the samples
    }
}

TEST(Closest, SphereDiskCylinderCube) {
    RayScene scene;
    scene.add(Sphere{{5, 0, 0}, 2.f});
    scene.add(Disk{Transform::translate({0, 0, -20})});
    scene.add(Cylinder{Transform::translate({0, 30, 0}) * Transform::scale({2, 2, 4})});
    scene.add(share(make_cube()));
    scene.build();
    EXPECT_FLOAT_EQ(scene.distance({5, 0, 0.5f}, 1e30f, 0), 1.5f);
    EXPECT_FLOAT_EQ(scene.distance({5, 0, 5}, 1e30f, 0), 3.f);
    EXPECT_FLOAT_EQ(scene.distance({0.5f, 0, -17}, 1e30f, 1), 3.f);
    EXPECT_FLOAT_EQ(scene.distance({4, 0, -16}, 1e30f, 1), 5.f);
    EXPECT_FLOAT_EQ(scene.distance({0, 30.5f, 1}, 1e30f, 2), 1.5f);
    EXPECT_FLOAT_EQ(scene.distance({5, 30, 8}, 1e30f, 2), 5.f);
    EXPECT_FLOAT_EQ(scene.distance({0.25f, 0, 0}, 1e30f, 3), 0.75f);
    EXPECT_FLOAT_EQ(scene.distance({2, 2, 2}, 1e30f, 3), std::sqrt(3.f));
    // All shapes: the nearest counts, and limits hold.
    EXPECT_FLOAT_EQ(scene.distance({2.25f, 0, 0}, 1e30f), 0.75f);
    EXPECT_EQ(scene.closest({2.25f, 0, 0}, 1e30f)->shape, 0u);
    EXPECT_EQ(scene.distance({0.25f, 0, 0}, 0.5f), 0.5f);
    EXPECT_FALSE(scene.closest({0.25f, 0, 0}, 0.5f));
    EXPECT_TRUE(scene.closest({0.25f, 0, 0}, 0.76f));
    const auto hit = scene.closest({0.25f, 0.1f, 3}, 1e30f);
    const SurfacePoint point = scene.surface_point({}, *hit);
    EXPECT_LT(length(point.p - Point3f{0.25f, 0.1f, 1}), 1e-6f);
    EXPECT_EQ(point.ng, (Vec3f{0, 0, 1}));
}

// Under maps that are no similarities: the distance is that to the point it names, and no sampled
// point is nearer.
TEST(Closest, EllipsesUnderAffineMaps) {
    Random random(9);
    const Transform map = Transform::rotate({1, 2, 3}, 70) * Transform::scale({3, 0.4, 1.5}) *
                          Transform::rotate({1, 0, 1}, 30);
    RayScene scene;
    scene.add(Disk{map});
    scene.add(Cylinder{map});
    scene.build();
    std::vector<Point3f> samples[2];
    for (std::uint32_t shape : {0u, 1u})
        for (int i = 0; i < 20000; ++i)
            samples[shape].push_back(scene.sample_area(shape, random.next2()).p);
    for (int i = 0; i < 300; ++i) {
        const Point3f p = random_direction(random) * (5 * random.next());
        for (std::uint32_t shape : {0u, 1u}) {
            const auto hit = scene.closest(p, 1e30f, shape);
            ASSERT_TRUE(hit);
            ASSERT_NEAR(length(scene.surface_point({}, *hit).p - p), hit->t, 1e-5);
            float best = 1e30f;
            for (const Point3f& q : samples[shape]) best = std::min(best, length(q - p));
            ASSERT_LE(hit->t, best + 1e-5f);
            ASSERT_GT(hit->t, best - 0.2f);
        }
    }
}

TEST(Closest, MeshAgreesWithEveryTriangle) {
    const auto mesh = share(make_torus(1.f, 0.4f, 40, 20));
    RayScene scene;
    scene.add(mesh);
    scene.build();
    Random random(10);
    for (int i = 0; i < 1000; ++i) {
        const Point3f p = random_direction(random) * (3 * random.next());
        double best = 1e30;
        for (const auto& t : mesh->triangles)
            best = std::min(best, closest_on_triangle(Vec3d(p), Vec3d(mesh->positions[t[0]]),
                                                      Vec3d(mesh->positions[t[1]]),
                                                      Vec3d(mesh->positions[t[2]]))
                                      .t);
        ASSERT_NEAR(scene.distance(p, 1e30f), best, 1e-6);
    }
}

}  // namespace
}  // namespace nacre
