// Surfaces as functions of two coordinates: against the hits that they name, and their derivatives
// against differences.
#include "nacre/geometry/surface_chart.h"

#include <gtest/gtest.h>

#include "nacre/geometry/ray_scene.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

Transform oblique() {
    return Transform::translate({0.3, -0.2, 0.5}) * Transform::rotate({1, 2, 0.5}, 40) *
           Transform::scale({1.5, 0.7, 1.2});
}

class SurfaceChartTest : public testing::Test {
  protected:
    void SetUp() override {
        scene_.add(Primitive(Sphere{{1, 2, 3}, 1.5f, false}));
        scene_.add(Primitive(Sphere{{-1, 0, 3}, 0.5f, true}));
        scene_.add(Primitive(Disk{oblique(), false}));
        scene_.add(Primitive(Cylinder{oblique(), true}));
        const auto mesh = std::make_shared<Mesh>(tessellate(Sphere{}, 0.05));
        scene_.add(mesh);
        scene_.add(mesh, true);
        scene_.add(mesh, false, true);
        scene_.build();
    }
    RayScene scene_;
};

TEST_F(SurfaceChartTest, IsTheSurfaceOfItsHits) {
    Random random(2);
    for (std::uint32_t shape = 0; shape < scene_.shape_count(); ++shape) {
        const std::vector<ChartTriangle> triangles = scene_.chart_triangles(shape);
        ASSERT_FALSE(triangles.empty());
        for (int i = 0; i < 200; ++i) {
            const ChartTriangle& t =
                triangles[std::size_t(random.next() * float(triangles.size()))];
            const double a = random.next(), b = (1 - a) * random.next();
            const auto hit = scene_.chart_hit(t, a, b);
            if (!hit) continue;  // beyond a disk's rim
            const SurfacePoint at = scene_.surface_point({}, *hit);
            const SurfaceChart chart = scene_.chart(t, a, b);
            ASSERT_LT(length(Vec3d(at.p) - chart.p), 2e-6) << shape;
            ASSERT_LT(length(Vec3d(at.ng) - chart.ng), 2e-6) << shape;
            ASSERT_LT(length(Vec3d(at.shading.n) - chart.n), 2e-6) << shape;
        }
    }
}

TEST_F(SurfaceChartTest, DerivativesAreThoseOfDifferences) {
    Random random(3);
    constexpr double h = 1e-5;
    for (std::uint32_t shape = 0; shape < scene_.shape_count(); ++shape) {
        const std::vector<ChartTriangle> triangles = scene_.chart_triangles(shape);
        for (int i = 0; i < 50; ++i) {
            const ChartTriangle& t =
                triangles[std::size_t(random.next() * float(triangles.size()))];
            const double a = 0.1 + 0.4 * random.next(), b = 0.1 + 0.3 * random.next();
            const SurfaceChart chart = scene_.chart(t, a, b);
            const auto difference = [&](double da, double db, auto&& of) {
                return (of(scene_.chart(t, a + da, b + db)) - of(scene_.chart(t, a - da, b - db))) *
                       (0.5 / h);
            };
            const auto p = [](const SurfaceChart& c) { return c.p; };
            const auto n = [](const SurfaceChart& c) { return c.n; };
            ASSERT_LT(length(difference(h, 0, p) - chart.pa), 1e-6) << shape;
            ASSERT_LT(length(difference(0, h, p) - chart.pb), 1e-6) << shape;
            ASSERT_LT(length(difference(h, 0, n) - chart.na), 1e-6) << shape;
            ASSERT_LT(length(difference(0, h, n) - chart.nb), 1e-6) << shape;
        }
    }
}

// Pieces cover a shape once: their areas add up (a disk's square is 4 / pi of it).
TEST_F(SurfaceChartTest, PiecesCoverTheShape) {
    for (std::uint32_t shape = 0; shape < scene_.shape_count(); ++shape) {
        constexpr int n = 40;
        double area = 0;
        for (const ChartTriangle& t : scene_.chart_triangles(shape))
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    // The unit square folded onto the triangle.
                    double a = (i + 0.5) / n, b = (j + 0.5) / n;
                    if (a + b > 1) a = 1 - a, b = 1 - b;
                    const SurfaceChart chart = scene_.chart(t, a, b);
                    area += 0.5 * length(cross(chart.pa, chart.pb)) / (n * n);
                }
        const bool disk =
            scene_.primitive(shape) && std::holds_alternative<Disk>(*scene_.primitive(shape));
        const double expected = scene_.area(shape) * (disk ? 4 / 3.14159265358979 : 1);
        EXPECT_NEAR(area, expected, 2e-3 * expected) << shape;
    }
}

}  // namespace
}  // namespace nacre
