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
        renderer.deform({});
        EXPECT_EQ(renderer.render(view).read(), rest) << int(kind);
    }
}

/// A furnace: an object without absorption and without a boundary under an even sky. Light is lost
/// only where the technique cannot see it; more than the sky there never is. 24 directions of the
/// sky stand for it, each with its own shadow map.
TEST_F(FramesTest, AnEvenSkyIsNeverExceeded) {
    const Scene s = scene(
        sensor({0, 0, 14}, {0, 0, 0}, 48, 48, 20) + xml::constant_light(1) +
        xml::sphere({0, 0, 0}, 1.5,
                    xml::bsdf("null") + xml::medium("interior", xml::number("sigma_s", 20) +
                                                                    xml::number("sigma_a", 0))));
    double mean = 0;
    int n = 0;
    std::vector<double> sum(48 * 48);
    FrameRenderer renderer(
        gpu(), s, shapes_of(s, translucent_shadow_map_technique(), {{"pattern", "nested"}}));
    const View view = camera_of(s, renderer.scene());
    for (std::uint32_t f = 0; f < 6; ++f) {
        const std::vector<float> rgba =
            renderer.render(view, {.index = f, .light_points = 24, .light_view = 128}).read();
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += rgba[4 * i] / 6;
    }
    for (int y = 18; y < 30; ++y)
        for (int x = 18; x < 30; ++x, ++n) mean += sum[std::size_t(48 * y + x)];
    mean /= n;
    EXPECT_LT(mean, 1.05);
    EXPECT_GT(mean, 0.8);
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
