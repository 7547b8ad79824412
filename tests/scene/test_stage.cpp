// What stands around a bare mesh: as it is written, and where it then is.
#include "nacre/scene/stage.h"

#include <numbers>

#include "nacre/geometry/mesh_build.h"
#include "nacre/image/image.h"
#include "nacre/scene/content_key.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

using Type = StageLight::Type;

class Stage : public SceneFiles {
  protected:
    /// A box of 60 x 100 x 40 mm that is wider to the right than deep.
    Scene staged(const StageOptions& stage) {
        auto mesh = std::make_shared<Mesh>(make_cube());
        for (Point3f& p : mesh->positions) p = {p.x * 30, p.y * 50, p.z * 20};
        return make_mesh_scene(mesh, {.stage = stage});
    }
    static Vec3d eye(const Scene& scene) {
        return Vec3d(scene.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f}).o);
    }
    static Vec3d ahead(const Scene& scene) {
        return Vec3d(scene.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f}).d);
    }
    /// Radiance by all lights of a white surface at the box's middle that is turned to `normal`, if
    /// nothing is in the way.
    static Vec3f white(const Scene& scene, const Vec3f& normal) {
        Vec3d sum;
        constexpr int side = 64;
        for (const LightPtr& light : scene.lights)
            for (int i = 0; i < side * side; ++i) {
                const Vec2f u{(i % side + 0.5f) / side, (i / side + 0.5f) / side};
                const LightSample s = light->sample({0, 50, 0}, u, Wavelengths::rgb_bands());
                const float cosine = dot(s.wi, normalize(normal));
                if (s.pdf <= 0 || cosine <= 0) continue;
                const float share = cosine / s.pdf / (std::numbers::pi_v<float> * side * side);
                sum += Vec3d(Vec3f{s.radiance[0], s.radiance[1], s.radiance[2]} * share);
            }
        return Vec3f(sum);
    }
};

TEST_F(Stage, ViewsByNameAndByAngles) {
    const struct {
        const char* text;
        Vec3d from;
    } cases[] = {{"front", {0, 0, 1}},
                 {"back", {0, 0, -1}},
                 {"left", {-1, 0, 0}},
                 {"right", {1, 0, 0}},
                 {"top", {0, 1, 0}},
                 {"90,0", {1, 0, 0}},
                 {"three-quarter", direction(28, 14)},
                 {"Three Quarter", direction(28, 14)},
                 {"-45, 30", direction(-45, 30)}};
    for (const auto& c : cases) {
        const Scene scene = staged({.view = parse_view(c.text)});
        const Vec3d from = normalize(eye(scene) - Vec3d(0, 50, 0));
        EXPECT_LT(length(from - c.from), 1e-4) << c.text;
        EXPECT_LT(length(ahead(scene) + c.from), 1e-4) << c.text;
    }
    // Seen from above, the front is at the lower border.
    const Scene above = staged({.view = parse_view("top")});
    EXPECT_GT(above.camera->ray({0.5f, 0.9f}, {0.5f, 0.5f}).d.z, 0.05f);
}

TEST_F(Stage, TheUsualLightsFollowTheViewer) {
    for (const char* view : {"28,14", "back", "left", "100,50"}) {
        const StageView v = parse_view(view);
        const Scene scene = staged({.view = v});
        const auto towards = [&](double azimuth) {
            return luminance(white(scene, Vec3f(direction(v.azimuth + azimuth, 40))));
        };
        EXPECT_NEAR(towards(-53), 0.73f, 0.05f) << view;
        EXPECT_NEAR(towards(130), 1.73f, 0.05f) << view;
    }
}

TEST_F(Stage, FlatThingsAreSeenFromHigherUpInEvenLight) {
    const auto flat = [](float height) {
        auto mesh = std::make_shared<Mesh>(make_cube());
        for (Point3f& p : mesh->positions) p.y *= height;
        return make_mesh_scene(mesh, {});
    };
    const auto elevation = [&](float height) {
        return std::asin(-ahead(flat(height)).y) * 180 / std::numbers::pi;
    };
    EXPECT_NEAR(elevation(1), 14, 1e-3);
    EXPECT_NEAR(elevation(0.4f), 14, 1e-3);
    EXPECT_NEAR(elevation(0.25f), 26, 1e-3);
    EXPECT_NEAR(elevation(0.01f), 38, 1e-3);
    // And do not become too bright, though they are turned to the light from behind.
    const float above = luminance(white(flat(0.05f), {0, 1, 0}));
    EXPECT_GT(above, 0.7f);
    EXPECT_LT(above, 1.f);
}

TEST_F(Stage, CamerasStandWhereTheyAreTold) {
    const StageCamera c = parse_stage_camera("origin=10,60,400 target=0,20,0 fov=35");
    const Scene scene = staged({.camera = c});
    EXPECT_LT(length(eye(scene) + ahead(scene) * 0.0 - Vec3d(10, 60, 400)), 0.1);
    EXPECT_LT(length(ahead(scene) - normalize(Vec3d(-10, -40, -400))), 1e-5);
    const Vec3d top(scene.camera->ray({0.5f, 0.f}, {0.5f, 0.5f}).d);
    EXPECT_NEAR(dot(top, ahead(scene)), std::cos(17.5 * std::numbers::pi / 180), 1e-5);
    // The middle of the object is the usual target.
    const Scene other = staged({.camera = parse_stage_camera("origin=0,50,300")});
    EXPECT_LT(length(ahead(other) - Vec3d(0, 0, -1)), 1e-5);
}

TEST_F(Stage, LightsBringTheWhiteThatIsAskedFor) {
    for (const char* text :
         {"point position=-200,300,300", "spot position=-200,300,300",
          "directional direction=200,-250,-300", "sphere position=-200,300,300 radius=30",
          "area position=-200,300,300 size=20"}) {
        StageLight light = parse_stage_light(text);
        EXPECT_NEAR(luminance(white(staged({.lights = {light}}), {-200, 250, 300})), 1.f, 0.005f)
            << text;
        light = parse_stage_light(std::string(text) + " white=0.5 color=1,0.5,0");
        const Scene scene = staged({.lights = {light}});
        const Vec3f seen = white(scene, {-200, 250, 300});
        EXPECT_NEAR(seen.x, 0.5f, 0.003f) << text;
        EXPECT_NEAR(seen.y, 0.25f, 0.002f) << text;
        EXPECT_EQ(seen.z, 0.f) << text;
        EXPECT_EQ(scene.lights.size(), 1u) << "in place of the usual lights";
        EXPECT_EQ(scene.environment, nullptr);
    }
    // Two of them add up; what is emitted may be given instead. White shines
    // with 1 / pi of the irradiance.
    const Scene two = staged({.lights = {parse_stage_light("directional direction=0,-1,0"),
                                         parse_stage_light("directional direction=0,-2,0 "
                                                           "irradiance=1,2,3")}});
    const Vec3f seen = white(two, {0, 1, 0});
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(seen[std::size_t(i)], 1 + (i + 1) / std::numbers::pi, 1e-5);
}

TEST_F(Stage, SurroundingsReplaceTheUsualLights) {
    Image image(64, 33);
    for (int y = 0; y < 33; ++y)
        for (int x = 0; x < 64; ++x) image.at(x, y, 0) = x == 32 ? 5.f : 0.25f;  // red at +z
    write_image(image, folder_ / "sky of a day.exr");
    const std::string file = (folder_ / "sky of a day.exr").string();
    const auto towards = [](const Scene& scene, double azimuth) {
        return scene.environment->radiance(nullptr, Vec3f(direction(azimuth, 0)),
                                           Wavelengths::rgb_bands())[0];
    };
    const Scene plain = staged({.environment = parse_stage_environment(file)});
    ASSERT_NE(plain.environment, nullptr);
    EXPECT_EQ(plain.lights.size(), 1u);
    EXPECT_EQ(plain.shapes.size(), 1u) << "a floor would hide them";
    EXPECT_GT(towards(plain, 0), 2.f);
    EXPECT_NEAR(towards(plain, 90), 0.25f, 1e-6f);
    const Scene turned = staged(
        {.environment = parse_stage_environment(file + " rotate=90 scale=2"), .floor = true});
    EXPECT_NEAR(towards(turned, 90), 2 * towards(plain, 0), 0.1f);
    EXPECT_NEAR(towards(turned, 0), 0.5f, 1e-6f);
    EXPECT_EQ(turned.shapes.size(), 2u);
}

TEST_F(Stage, BackgroundsAreSeenAndLightNothing) {
    const auto seen = [](const Scene& scene, int bounces) {
        const Light* light = scene.beyond(bounces);
        return light ? light->radiance(nullptr, {0, 0, -1}, Wavelengths::rgb_bands())[1] : -1.f;
    };
    const Scene usual = staged({});
    EXPECT_NEAR(seen(usual, 0), 0.14f, 1e-6f);
    EXPECT_EQ(usual.shapes.size(), 4u);  // two lamps, floor, object
    const Scene grey = staged({.background = parse_background("0.1,0.5,0.9")});
    EXPECT_NEAR(seen(grey, 0), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(grey, 1), 0.14f, 1e-6f);
    EXPECT_EQ(grey.lights.size(), usual.lights.size());
    EXPECT_EQ(grey.shapes.size(), 3u) << "a floor would hide it";
    EXPECT_EQ(seen(staged({.background = parse_background("none")}), 0), 0.f);
    EXPECT_FALSE(parse_background("env"));
    // References of different backgrounds are different.
    const Scene other = staged({.background = parse_background("0.1,0.5,0.8")});
    EXPECT_NE(content_key(grey), content_key(other));
    EXPECT_EQ(content_key(grey),
              content_key(staged({.background = parse_background("0.1,0.5,0.9")})));
    EXPECT_EQ(staged({.floor = false}).shapes.size(), 3u);
}

TEST_F(Stage, RefusesWrongWords) {
    const auto view = [](const char* text) { parse_view(text); };
    const auto camera = [](const char* text) { parse_stage_camera(text); };
    const auto light = [](const char* text) { parse_stage_light(text); };
    const auto env = [](const char* text) { parse_stage_environment(text); };
    const auto background = [](const char* text) { parse_background(text); };
    const struct {
        void (*parse)(const char*);
        const char *text, *said;
    } cases[] = {
        {view, "frnt", "--view: unknown view 'frnt'; did you mean 'front'?"},
        {view, "",
         "--view: unknown view ''; known are: front, back, left, right, top, "
         "three-quarter"},
        {view, "10,x",
         "--view: '10,x' is no view; write AZIMUTH,ELEVATION in degrees, such as "
         "30,15"},
        {view, "10,95",
         "--view: an elevation of 95 degrees is out of range: must lie within "
         "[-90, 90]"},
        {camera, "target=0,0,0", "--camera: origin is missing, such as origin=0,60,400"},
        {camera, "orgin=0,0,0", "--camera: unknown parameter 'orgin'; did you mean 'origin'?"},
        {camera, "origin=5", "--camera: origin takes three numbers, such as origin=0,100,300"},
        {camera, "origin=1,2",
         "--camera: 'origin=1,2' must have one number or three "
         "(red,green,blue)"},
        {camera, "origin=0,0,9 origin=0,0,8", "--camera: origin is given twice"},
        {camera, "origin=0,0,9 fov=0",
         "--camera: fov = 0 is out of range: must lie within "
         "(0, 175]"},
        {light, "", "--light: unknown light ''; known are: point, spot, directional, sphere, area"},
        {light, "pint position=1,2,3", "--light: unknown light 'pint'; did you mean 'point'?"},
        {light, "point", "--light point: position is missing, such as position=-200,300,300"},
        {light, "directional",
         "--light directional: direction is missing, such as "
         "direction=-1,-1,-1"},
        {light, "directional direction=0,0,0", "--light directional: direction must not be 0,0,0"},
        {light, "point position=1,2,3 radius=2",
         "--light point: unknown parameter 'radius'; known are: position, color, white, intensity"},
        {light, "point position=1,2,3 white=-1",
         "--light point: white = -1 is out of range: must lie within [0, inf)"},
        {light, "point position=1,2,3 white=1 intensity=1,1,1",
         "--light point: give either intensity, or white and color"},
        {light, "area position=1,2,3 radiance=1,-1,1",
         "--light area: radiance = -1 is out of range: must lie within [0, inf)"},
        {light, "point position=1,2,3 color=1,-1,1",
         "--light point: color = -1 is out of range: "
         "must lie within [0, inf)"},
        {light, "spot position=1,2,3 cutoff_angle=10 beam_width=11",
         "--light spot: beam_width = 11 is more than cutoff_angle = 10"},
        {light, "point 5",
         "--light point: '5' does not set a parameter; write name=value, such as "
         "alpha=0.2"},
        {env, "a.hdr rotat=9", "--env: unknown parameter 'rotat'; did you mean 'rotate'?"},
        {env, "a.hdr scale=-1", "--env: scale = -1 is out of range: must lie within [0, inf)"},
        {background, "white",
         "--background: 'white' is no colour; write R,G,B (linear, not "
         "negative), env or none"},
        {background, "1,-1,1",
         "--background: '1,-1,1' is no colour; write R,G,B (linear, not "
         "negative), env or none"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of([&] { c.parse(c.text); }), c.said) << c.text;
}

TEST_F(Stage, RefusesWhatShowsNothing) {
    EXPECT_EQ(error_of([&] { staged({.environment = StageEnvironment{"no.hdr"}}); }),
              "--env: cannot find 'no.hdr'");
    EXPECT_EQ(error_of([&] { staged({.view = parse_view("0,-40")}); }),
              "the viewer is below the floor and sees nothing of the object; leave the floor out "
              "(--no-floor)");
    EXPECT_EQ(error_of([&] { staged({.view = parse_view("0,-40"), .floor = false}); }), "no error");
    EXPECT_EQ(error_of([&] { staged({.lights = {parse_stage_light("area position=0,-90,0")}}); }),
              "--light: it stands below the floor, which keeps its light from the object; move it, "
              "or leave the floor out (--no-floor)");
    EXPECT_EQ(error_of([&] { staged({.lights = {parse_stage_light("point position=0,50,0")}}); }),
              "--light: it stands in the middle of what it is to light; move it away");
    EXPECT_EQ(
        error_of([&] { staged({.camera = parse_stage_camera("origin=0,9,9 target=0,9,9")}); }),
        "--camera: origin and target are the same place");
}

}  // namespace
}  // namespace nacre
