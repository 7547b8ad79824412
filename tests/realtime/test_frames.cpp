// Frames: what all techniques owe to the shared passes.
#include "tests/realtime/frames.h"

namespace nacre {

const TechniqueDescription& translucent_shadow_map_technique();

namespace {

class FramesTest : public Frames {
  protected:
    std::vector<float> frame(const Scene& s, const FrameOptions& options = {},
                             VisibilityMethod method = VisibilityMethod::compute) {
        FrameRenderer renderer(gpu(), s, shapes_of(s, translucent_shadow_map_technique()));
        renderer.set_visibility(method);
        return renderer.render(camera_of(s, renderer.scene()), options).read();
    }
    std::string body(const std::string& lights,
                     const std::string& boundary = xml::dielectric(1.3)) const {
        return sensor({3, 4, 14}, {0, 1, 0}, 64, 64) + lights +
               xml::sphere({0, 1.5, 0}, 1.5, boundary + matter(3)) +
               xml::shape("rectangle",
                          "<transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/>"
                          "<scale value=\"20\"/></transform>");
    }
};

double rms(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0, reference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (i % 4 == 3) continue;
        squares += (a[i] - b[i]) * (a[i] - b[i]);
        reference += b[i] * b[i];
    }
    return std::sqrt(squares / reference);
}

/// Light is linear: two lights make the sum of two pictures, but for what mirrors show of none.
TEST_F(FramesTest, LightsAddUp) {
    const std::string one = point_light({5, 9, 6}, 100), other = parallel_light({1, -1, 1}, 0.5);
    const std::vector<float> a = frame(scene(body(one))), b = frame(scene(body(other))),
                             both = frame(scene(body(one + other)));
    std::vector<float> sum = a;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += b[i];
    EXPECT_LT(rms(both, sum), 1e-3);
    EXPECT_GT(rms(both, a), 0.1);
}

/// A lamp of small size is a point of the same intensity, pi r^2 L. (Without a boundary, in which
/// only the lamp would be mirrored.)
TEST_F(FramesTest, SmallLampsArePoints) {
    const double r = 0.02, radiance = 100 / (pi * r * r);
    const std::string none = xml::bsdf("null");
    const std::vector<float> point = frame(scene(body(point_light({5, 9, 6}, 100), none))),
                             lamp = frame(
                                 scene(body(
                                     xml::sphere({5, 9, 6}, r,
                                                 xml::area_light({radiance, radiance, radiance})),
                                     none)),
                                 {.light_points = 4});
    EXPECT_LT(rms(lamp, point), 0.02);
}

/// A spot lights its cone only, and as a point does within its beam.
TEST_F(FramesTest, SpotsHaveTheirCone) {
    const auto spot = [](double cutoff) {
        return fmt::format(
            "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"5, 9, "
            "6\" target=\"0, 1.5, 0\" up=\"0, 0, 1\"/></transform>{}{}{}</emitter>",
            xml::rgb("intensity", {100, 100, 100}), xml::number("cutoff_angle", cutoff),
            xml::number("beam_width", 0.9 * cutoff));
    };
    const std::vector<float> point = frame(scene(body(point_light({5, 9, 6}, 100)))),
                             wide = frame(scene(body(spot(60)))),
                             narrow = frame(scene(body(spot(4))));
    double whole = 0, cone = 0, differs = 0;
    for (std::size_t i = 0; i < point.size(); i += 4) {
        whole += point[i];
        cone += narrow[i];
        differs += std::abs(point[i] - wide[i]);
    }
    EXPECT_LT(differs, 0.03 * whole);
    EXPECT_LT(cone, 0.5 * whole);
    EXPECT_GT(cone, 0.01 * whole);
}

/// The floor is lit where a ray to the light says so, but for pixels on the shadow's edge; and then
/// by Lambert's law.
TEST_F(FramesTest, ShadowsAreThoseOfRays) {
    const Vec3d at(5, 9, 6);
    const Scene s = scene(body(point_light(at, 100)));
    const std::vector<float> rgba = frame(s);
    int wrong = 0, shadowed = 0, lit = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const Ray ray =
                s.camera->ray({(float(x) + 0.5f) / 64, (float(y) + 0.5f) / 64}, {0.5f, 0.5f});
            const auto hit = s.rays.intersect(ray);
            if (!hit || hit->shape != 1) continue;
            const SurfacePoint p = s.rays.surface_point(ray, *hit);
            const Vec3f d = Vec3f(at) - p.p, wi = normalize(d);
            const bool dark = s.rays.occluded({p.spawn(wi), wi, 0.f, length(d) * 0.999f});
            const double expected = dark ? 0. : 0.5 * 100 / pi * wi.y / dot(d, d);
            const float value = rgba[4 * std::size_t(64 * y + x)];
            (dark ? shadowed : lit) += 1;
            wrong += std::abs(value - expected) > 0.01 * std::max(expected, 0.1);
        }
    EXPECT_GT(shadowed, 40);
    EXPECT_GT(lit, 1000);
    EXPECT_LT(wrong, 8);
}

/// Both ways to find what is visible make the same picture, but for pixels on edges.
TEST_F(FramesTest, AreTheSameByTheRasterUnit) {
    const Scene s = scene(body(point_light({5, 9, 6}, 100)));
    EXPECT_LT(rms(frame(s), frame(s, {}, VisibilityMethod::raster)), 0.02);
}

/// Told of a change, the next frame is that of a technique made for the scene as it is.
TEST_F(FramesTest, FollowChanges) {
    Scene s = scene(body(point_light({5, 9, 6}, 100)));
    const auto shapes = shapes_of(s, translucent_shadow_map_technique());
    FrameRenderer renderer(gpu(), s, shapes);
    const View view = camera_of(s, renderer.scene());
    const std::vector<float> before = renderer.render(view).read();
    const auto check = [&](const Changes& what) {
        renderer.changed(what);
        FrameRenderer fresh(gpu(), s, shapes);
        const std::vector<float> now = renderer.render(view).read();
        EXPECT_EQ(now, fresh.render(view).read()) << what.text();
        EXPECT_NE(now, before) << what.text();
    };
    Scene lit = scene(body(point_light({-5, 9, 6}, 100)));
    s.lights = lit.lights;
    check({.light = true});
    Scene other = scene(body(point_light({-5, 9, 6}, 100)));
    other.media.push_back(std::make_shared<Medium>(*other.shapes[0].interior));
    auto dense = std::make_shared<Medium>(*s.shapes[0].interior);
    dense->scale = 4.f;
    dense->sigma_t = make_constant(9.f);
    s.media.push_back(dense);
    s.shapes[0].interior = dense.get();
    check({.material = true});
    Scene moved = scene(sensor({3, 4, 14}, {0, 1, 0}, 64, 64) +
                        xml::sphere({0.4, 1.2, 0}, 1.2, translucent(3)) +
                        xml::shape("rectangle",
                                   "<transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/>"
                                   "<scale value=\"20\"/></transform>"));
    s.rays = std::move(moved.rays);
    check({.geometry = true});
}

/// A bend and its way back; a twist by nothing changes nothing but by rounding; and a bent object is
/// another picture.
TEST_F(FramesTest, DeformAndComeBack) {
    const Scene s = scene(body(point_light({5, 9, 6}, 100)));
    FrameRenderer renderer(gpu(), s, shapes_of(s, translucent_shadow_map_technique()));
    const View view = camera_of(s, renderer.scene());
    const std::vector<float> rest = renderer.render(view).read();
    for (const auto kind :
         {Deformation::Kind::twist, Deformation::Kind::bend, Deformation::Kind::breathe}) {
        renderer.deform({.kind = kind, .amount = 0.3f, .phase = 0.8f});
        const std::vector<float> bent = renderer.render(view).read();
        // A ball that is twisted about its axis is still a ball.
        EXPECT_GT(rms(bent, rest), kind == Deformation::Kind::twist ? 1e-6 : 1e-3) << int(kind);
        for (const float v : bent) ASSERT_TRUE(std::isfinite(v));
        // Hardly any bend is hardly another picture: normals go along.
        renderer.deform({.kind = kind, .amount = 1e-3f, .phase = 0.8f});
        EXPECT_LT(rms(renderer.render(view).read(), rest), 0.02) << int(kind);
        renderer.deform({});
        EXPECT_EQ(renderer.render(view).read(), rest) << int(kind);
    }
}

/// A furnace: an object without absorption under an even sky of radiance 1, with a boundary that
/// mirrors the sky and without. What the technique cannot see is lost; more than the sky there
/// never is, but for what the boundary's transmittance straight on is above its mean (1.06). 144
/// directions of the sky stand for it, each with its own shadow map.
TEST_F(FramesTest, AnEvenSkyIsNeverExceeded) {
    for (const bool mirrors : {false, true}) {
        const Scene s =
            scene(sensor({0, 0, 14}, {0, 0, 0}, 32, 32, 20) + xml::constant_light(1) +
                  xml::sphere({0, 0, 0}, 1.5,
                              (mirrors ? xml::dielectric(1.5) : xml::bsdf("null")) +
                                  xml::medium("interior", xml::number("sigma_s", 20) +
                                                              xml::number("sigma_a", 0))));
        std::vector<double> sum(32 * 32);
        FrameRenderer renderer(gpu(), s, shapes_of(s, translucent_shadow_map_technique()));
        const View view = camera_of(s, renderer.scene());
        for (std::uint32_t f = 0; f < 6; ++f) {
            const std::vector<float> rgba =
                renderer.render(view, {.index = f, .light_points = 24, .light_view = 128}).read();
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += rgba[4 * i] / 6;
        }
        double mean = 0, rim = 0;
        for (int y = 12; y < 20; ++y)
            for (int x = 12; x < 20; ++x) mean += sum[std::size_t(32 * y + x)] / 64;
        for (const int x : {7, 24}) rim += sum[std::size_t(32 * 16 + x)] / 2;
        EXPECT_LT(mean, mirrors ? 1.06 : 1.03) << mirrors;
        EXPECT_GT(mean, 0.8) << mirrors;
        EXPECT_LT(rim, 1.06) << mirrors;
        EXPECT_GT(rim, 0.7) << mirrors;
    }
}

TEST_F(FramesTest, WhatCannotBeIsSaid) {
    const Scene inside = scene(body(point_light({0, 1.5, 0.2}, 1)));
    EXPECT_EQ(
        error_of([&] { frame(inside); }),
        "a light at (0, 1.5, 0.2) is too near to an object, which fills more than 170 degrees "
        "from there: move it away, or use an offline technique");
}

}  // namespace
}  // namespace nacre
