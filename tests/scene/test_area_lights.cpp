// Lights of shapes against closed forms: what they send to a point, and that densities are those of
// the samples.
#include "nacre/scene/lights/rectangle.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/light_fixture.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

using AreaLights = Lights;

TEST_F(AreaLights, DiskGivesPiLSineSquared) {
    rays_.add(Disk{Transform::translate({0, 0, 3}) * Transform::rotate({1, 0, 0}, 180) *
                   Transform::scale({2, 2, 2})});
    const LightPtr made = area_light();
    expect_estimate(irradiance(*made, {}, {0.f, 0.f, 1.f}), 2.0 * pi * 4.0 / (4.0 + 9.0));
    expect_estimate(density_integral(*made, {}, {0.f, 0.f, 1.f}, 3.0 / std::sqrt(13.0) - 1e-3),
                    1.0);
    EXPECT_NEAR(made->power(), pi * 4.0 * pi * luminance({1.f, 2.f, 3.f}), 1e-3);
}

TEST_F(AreaLights, AreaLightShinesOnTheSideOfItsNormalOnly) {
    const LightPtr made = rectangle({0.f, 0.f, 1.f}, {1.f, 0.f, 0.f}, {0.f, 1.f, 0.f});  // up
    const Ray ray{{0.3f, 0.3f, 0.f}, {0.f, 0.f, 1.f}};
    const SurfacePoint at = rays_.surface_point(ray, *rays_.intersect(ray));
    EXPECT_EQ(made->sample(ray.o, {0.5f, 0.5f}, bands).pdf, 0.f);
    EXPECT_EQ(made->pdf(ray.o, ray.d, &at), 0.f);
    EXPECT_EQ(made->radiance(&at, ray.d, bands)[1], 0.f);
    EXPECT_FLOAT_EQ(made->radiance(&at, -ray.d, bands)[1], 2.f);
    EXPECT_GT(made->sample({0.3f, 0.3f, 2.f}, {0.5f, 0.5f}, bands).pdf, 0.f);
}

TEST_F(AreaLights, SphereGivesItsFormFactor) {
    // E = pi L (r / d)^2 cos for a sphere above the horizon, at any distance.
    for (const auto& [distance, radius] :
         {std::pair{5.f, 2.f}, {2.001f, 2.f}, {1000.f, 1.f}, {1e6f, 1.f}}) {
        SCOPED_TRACE(distance);
        rays_ = RayScene();
        const Vec3f axis = normalize(Vec3f(1.f, -2.f, 2.f));
        const LightPtr made = sphere(axis * distance, radius);
        const double ratio = radius / distance;
        expect_estimate(irradiance(*made, {}, axis), 2.0 * pi * ratio * ratio);
        if (distance < 1e5f)
            expect_estimate(
                density_integral(*made, {}, axis,
                                 std::sqrt(std::max(0.0, 1.0 - ratio * ratio)) * (1.0 - 2e-8)),
                1.0);
    }
}

TEST_F(AreaLights, SphereSamplesAreUniformInTheCone) {
    const Vec3f axis = normalize(Vec3f(0.3f, 0.2f, -1.f));
    const LightPtr made = sphere(axis * 3.f, 1.f);
    expect_samples_are_met(*made, {}, 2e-3f);
    const Framef frame = Framef::around(axis);
    const double drop = 1.0 - std::sqrt(1.0 - 1.0 / 9.0);
    std::vector<double> counts(8 * 8, 0.0);
    Random random(1);
    const int n = 64000;
    for (int i = 0; i < n; ++i) {
        const Vec3f d = frame.to_local(made->sample({}, random.next2(), bands).wi);
        const double c = (1.0 - d.z) / drop, phi = std::atan2(d.y, d.x) / (2.0 * pi) + 0.5;
        ++counts[std::clamp(int(c * 8), 0, 7) * 8 + std::clamp(int(phi * 8), 0, 7)];
    }
    EXPECT_TRUE(test::chi_square_passes(counts, std::vector<double>(64, n / 64.0)));
}

TEST_F(AreaLights, SphereThatShinesInwardsGivesPiLInside) {
    const LightPtr made = sphere({1.f, 2.f, 3.f}, 2.f, true);
    const Point3f inside{1.5f, 1.2f, 3.9f};
    expect_estimate(irradiance(*made, inside, normalize(Vec3f(1.f, 1.f, 0.f))), 2.0 * pi);
    expect_estimate(density_integral(*made, inside, {0.f, 0.f, 1.f}, -1.0), 1.0);
    expect_samples_are_met(*made, inside, 1e-3f);
    EXPECT_EQ(made->sample({9.f, 0.f, 0.f}, {0.5f, 0.5f}, bands).pdf, 0.f);
}

TEST_F(AreaLights, SphereDoesNotShineInside) {
    const LightPtr made = sphere({}, 2.f);
    EXPECT_EQ(made->sample({0.5f, 0.f, 0.f}, {0.5f, 0.5f}, bands).pdf, 0.f);
}

/// Form factor of a parallel rectangle a x b whose corner is above the point at height h (Howell, A
/// Catalog of Radiation Heat Transfer Configuration Factors, B-3).
double corner_form_factor(double a, double b, double h) {
    const double x = a / h, y = b / h, rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * pi);
}

TEST_F(AreaLights, RectangleGivesItsFormFactor) {
    for (const auto& [a, b, h] :
         {std::tuple{1.f, 2.f, 1.5f}, {3.f, 0.2f, 0.1f}, {1.f, 1.f, 50.f}, {1.f, 1.f, 500.f}}) {
        SCOPED_TRACE(h);
        rays_ = RayScene();
        // Facing down; the corner above the origin.
        const LightPtr made = rectangle({0.f, 0.f, h}, {0.f, b, 0.f}, {a, 0.f, 0.f});
        expect_estimate(irradiance(*made, {}, {0.f, 0.f, 1.f}),
                        2.0 * pi * corner_form_factor(a, b, h));
        const Vec3f centre{a / 2, b / 2, h};
        const double cosine = h / std::sqrt(a * a + b * b + h * h);
        if (h < 10.f)
            expect_estimate(density_integral(*made, {}, {0.f, 0.f, 1.f}, cosine - 1e-3), 1.0);
        expect_samples_are_met(*made, {0.1f, -0.4f, 0.f}, 2e-3f);
    }
}

/// Solid angle of a triangle. Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30(2).
double triangle_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double la = length(a), lb = length(b), lc = length(c);
    return 2.0 * std::abs(std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc +
                                                              dot(b, c) * la + dot(c, a) * lb));
}

TEST_F(AreaLights, RectangleSamplesAreUniformInSolidAngle) {
    const Rectangle r{{-1.0, -0.5, 0.7}, {1, 0, 0}, {0, 1, 0}, 2.5, 1.5};
    const Vec3d from{0.4, -0.9, 0.1};
    const SphericalRectangle seen(r, from);
    constexpr int cells = 8, n = 64000;
    std::vector<double> expected, counts(cells * cells, 0.0);
    const auto corner = [&](int i, int j) {
        return r.corner + r.x_axis * (r.width * i / cells) + r.y_axis * (r.height * j / cells) -
               from;
    };
    double whole = 0.0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double omega =
                triangle_solid_angle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)) +
                triangle_solid_angle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
            whole += omega;
            expected.push_back(omega);
        }
    EXPECT_NEAR(seen.solid_angle(), whole, 1e-12);
    Random random(2);
    for (int i = 0; i < n; ++i) {
        const Vec3d p = from + seen.sample(random.next2()) - r.corner;
        EXPECT_NEAR(p.z, 0.0, 1e-12);
        ++counts[std::clamp(int(p.x / r.width * cells), 0, cells - 1) * cells +
                 std::clamp(int(p.y / r.height * cells), 0, cells - 1)];
    }
    for (double& e : expected) e *= n / whole;
    EXPECT_TRUE(test::chi_square_passes(counts, expected));
}

TEST_F(AreaLights, SphericalRectangleKeepsItsDigitsFarAway) {
    // Solid angle of a small facing square: area / d^2, to relative (side / d)^2.
    const Rectangle r{{-0.5, -0.5, 1e4}, {1, 0, 0}, {0, 1, 0}, 1.0, 1.0};
    EXPECT_NEAR(SphericalRectangle(r, {}).solid_angle(), 1e-8, 2e-15);
}

TEST_F(AreaLights, OnlyRectanglesCountAsRectangles) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {2, 3, 0}};
    ASSERT_TRUE(as_rectangle(mesh));
    EXPECT_DOUBLE_EQ(as_rectangle(mesh)->width * as_rectangle(mesh)->height, 2.0);
    mesh.positions[3] = {0, 1, 0.1f};  // not in the plane
    EXPECT_FALSE(as_rectangle(mesh));
    mesh.positions[3] = {0.5f, 1, 0};  // a trapezium
    EXPECT_FALSE(as_rectangle(mesh));
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}};  // a parallelogram
    EXPECT_FALSE(as_rectangle(mesh));
}

TEST_F(AreaLights, MeshGivesTheSumOfItsFaces) {
    const LightPtr made = cube({0.f, 0.f, 3.f}, 1.f);
    // Below the centre of the lower face, 2 x 2 at height 2, four corners of 1 x 1.
    expect_estimate(irradiance(*made, {}, {0.f, 0.f, 1.f}, 200000),
                    2.0 * pi * 4.0 * corner_form_factor(1.0, 1.0, 2.0));
    // Points are drawn from six equal faces, one of which can be seen from here, three from there.
    expect_estimate(density_integral(*made, {}, {0.f, 0.f, 1.f}, 0.8), 1.0 / 6.0);
    expect_estimate(density_integral(*made, {4.f, 4.f, 7.f}, {-1.f, -1.f, -1.f}, 0.9), 0.5);
    expect_samples_are_met(*made, {}, 1e-4f);
    // Inside there are only backs.
    const Ray ray{{0.1f, 0.2f, 3.f}, {0.f, 0.f, 1.f}};
    const SurfacePoint at = rays_.surface_point(ray, *rays_.intersect(ray));
    EXPECT_EQ(made->pdf(ray.o, ray.d, &at), 0.f);
    EXPECT_EQ(made->sample(ray.o, {0.3f, 0.6f}, bands).pdf, 0.f);
}

TEST_F(AreaLights, TexturedAreaLightsShineByTheirTexture) {
    rays_.add(Sphere{{0.f, 0.f, 5.f}, 1.f, false});
    rays_.build();
    root_ = read(
        "<shape type=\"sphere\"><emitter type=\"area\"><texture name=\"radiance\" "
        "type=\"checkerboard\"><rgb name=\"color0\" value=\"1, 1, 1\"/><rgb name=\"color1\" "
        "value=\"3, 3, 3\"/></texture></emitter></shape>");
    const LightPtr made =
        make_area_light(*root_->children.at(0).node->children.at(0).node, rays_, 0, context_);
    Random random(1);
    bool dark = false, bright = false;
    for (int i = 0; i < 400; ++i) {
        const LightSample s = made->sample({}, random.next2(), bands);
        if (!(s.pdf > 0.f)) continue;
        const Ray ray{{}, s.wi};
        const auto hit = rays_.intersect(ray);
        if (!hit || std::abs(hit->t - s.distance) > 1e-3f) continue;
        const SurfacePoint at = rays_.surface_point(ray, *hit);
        EXPECT_NEAR(made->pdf({}, s.wi, &at), s.pdf, 2e-2f * s.pdf);
        dark |= std::abs(s.radiance[1] - 1.f) < 1e-4f;
        bright |= std::abs(s.radiance[1] - 3.f) < 1e-4f;
    }
    EXPECT_TRUE(dark && bright);
}

}  // namespace
}  // namespace nacre
