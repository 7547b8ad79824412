#include "nacre/bssrdf/chiang2016.h"
#include "nacre/layers/skin.h"
#include "nacre/optics/media.h"
#include "nacre/scene/subsurface.h"
#include "tests/support/error_of.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

using viewer::MaterialEdit;
using viewer::SceneParts;
using viewer::ViewerScene;
using viewer::ViewerState;
using Kind = MaterialEdit::Kind;

Scene rebuilt(const ViewerScene& scene, const ViewerState& state) {
    const SceneParts parts = scene.parts_of(state);
    return rebuild(scene.scene, parts.root, parts.meshes, scene.mode);
}

const ShapeBinding& translucent(const Scene& scene) {
    for (const ShapeBinding& s : scene.shapes)
        if (is_translucent(s)) return s;
    throw std::logic_error("no shape is translucent");
}

MediumCoefficients matter_of(const Scene& scene) {
    return translucent(scene).interior->coefficients({}, Wavelengths::rgb_bands());
}

void expect_matter(const Scene& scene, const Vec3f& sigma_s, const Vec3f& sigma_a, float eta) {
    const MediumCoefficients c = matter_of(scene);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(c.sigma_s[i], sigma_s[i], 1e-4f * sigma_s[i]);
        EXPECT_NEAR(c.sigma_t[i] - c.sigma_s[i], sigma_a[i], 1e-5f * sigma_s[i]);
    }
    EXPECT_NEAR(boundary_eta(translucent(scene)), eta, 1e-6f);
}

TEST(Rebuild, OfTheSameTreeIsTheSameScene) {
    const auto scene = ball();
    const Scene again = rebuilt(scene, scene.state());
    ASSERT_EQ(again.shapes.size(), scene.scene.shapes.size());
    EXPECT_EQ(again.lights.size(), scene.scene.lights.size());
    for (std::uint32_t i = 0; i < again.shapes.size(); ++i) {
        EXPECT_EQ(again.shapes[i].name, scene.scene.shapes[i].name);
        const Mesh *a = again.rays.mesh(i), *b = scene.scene.rays.mesh(i);
        ASSERT_EQ(!a, !b);
        if (!a) continue;
        EXPECT_EQ(a->positions, b->positions);
        EXPECT_EQ(a->normals, b->normals);
        EXPECT_EQ(a->triangles, b->triangles);
    }
    const MediumCoefficients a = matter_of(again), b = matter_of(scene.scene);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(a.sigma_s[i], b.sigma_s[i]);
}

TEST(MaterialEdits, AreOfMeasuredMediaWithTheirIndex) {
    const auto scene = ball();
    ViewerState state = scene.state();
    state.material = {.kind = Kind::measured, .name = "skim milk"};
    const MeasuredMedium& milk = measured_media().find("skimmilk");
    expect_matter(rebuilt(scene, state), milk.sigma_s_prime, milk.sigma_a, milk.eta);
    // Back to the scene's own.
    state.material.kind = Kind::scene;
    const MeasuredMedium& marble = measured_media().find("marble");
    expect_matter(rebuilt(scene, state), marble.sigma_s_prime, marble.sigma_a, marble.eta);
}

TEST(MaterialEdits, AreOfSkinByWavelength) {
    const auto scene = ball();
    ViewerState state = scene.state();
    state.material = {.kind = Kind::measured, .name = "skin"};
    const Scene skin = rebuilt(scene, state);
    EXPECT_EQ(skin.mode, ColorMode::spectral);
    EXPECT_NEAR(boundary_eta(translucent(skin)), SkinParameters{}.epidermis.eta, 1e-6);
}

TEST(MaterialEdits, AreOfCoefficientsPerMillimetreWhateverTheUnit) {
    const SceneFolder folder;
    const auto scene = folder.scene(std::string("<float name='mm_per_unit' value='10'/>") +
                                    small_sensor + marble_ball + lamp);
    ViewerState state = scene.state();
    state.material = {.kind = Kind::coefficients,
                      .sigma_s = {1, 2, 3},
                      .sigma_a = {0.1f, 0.2f, 0.3f},
                      .eta = 1.7f};
    // Scene files mean air outside.
    expect_matter(rebuilt(scene, state), {10, 20, 30}, {1, 2, 3}, 1.7f / 1.000277f);
}

TEST(MaterialEdits, AreOfColourAndRadius) {
    const auto scene = ball();
    ViewerState state = scene.state();
    state.material = {
        .kind = Kind::artist, .color = {0.8f, 0.5f, 0.3f}, .radius = {2, 1, 0.5f}, .eta = 1.33f};
    Vec3f sigma_s, sigma_a;
    for (int i = 0; i < 3; ++i) {
        const auto m = chiang2016_medium(state.material.color[i], state.material.radius[i]);
        sigma_s[i] = float(m.sigma_s);
        sigma_a[i] = float(m.sigma_t - m.sigma_s);
    }
    expect_matter(rebuilt(scene, state), sigma_s, sigma_a, 1.33f);
}

TEST(MaterialEdits, ReachSubsurfaceElementsAndKeepTheirOptions) {
    const SceneFolder folder;
    const auto scene = folder.scene(
        std::string(small_sensor) + lamp +
        R"(<shape type="sphere"><float name="radius" value="10"/><subsurface type="better_dipole">
               <string name="material" value="marble"/><string name="method" value="two_pass"/>
           </subsurface></shape>)");
    ViewerState state = scene.state();
    state.material = {.kind = Kind::measured, .name = "skin1"};
    const Scene changed = rebuilt(scene, state);
    const MeasuredMedium& skin = measured_media().find("skin1");
    expect_matter(changed, skin.sigma_s_prime, skin.sigma_a, skin.eta / 1.000277f);
    EXPECT_EQ(translucent(changed).subsurface->profile, "better_dipole");
    state.material.name = "skin";
    EXPECT_EQ(error_of([&] { scene.parts_of(state); }),
              "material 'skin' is a medium by wavelength, which <subsurface> cannot hold; choose "
              "skin1 or skin2");
}

TEST(MaterialEdits, RefuseWhatNoSceneFileHolds) {
    struct Case {
        MaterialEdit edit;
        const char* message;
    };
    const Case cases[] = {
        {{.kind = Kind::measured, .name = "marbel"},
         "unknown measured medium 'marbel'; did you mean 'Marble'?"},
        {{.kind = Kind::coefficients, .sigma_s = {1, -1, 1}},
         "sigma_s (1, -1, 1) must lie within [0, 1e6)"},
        {{.kind = Kind::coefficients, .sigma_a = {0, 0, 2e6f}},
         "sigma_a (0, 0, 2e+06) must lie within [0, 1e6)"},
        {{.kind = Kind::artist, .color = {1.5f, 0, 0}},
         "the colour (1.5, 0, 0) must lie within [0, 1]"},
        {{.kind = Kind::artist, .radius = {1, 0, 1}},
         "the radius (1, 0, 1) must lie within (0, 1e6)"},
        {{.kind = Kind::artist, .eta = 0.5f}, "the index of refraction 0.5 must lie within [1, 4]"},
    };
    for (const Case& c : cases) EXPECT_EQ(error_of([&] { check(c.edit); }), c.message);
}

/// What a light gives to a white surface at the object's middle that faces it, by chance; and where
/// from.
std::pair<double, Vec3d> light_at_middle(const Light& light, const ViewerScene& scene) {
    double sum = 0;
    Vec3d from;
    constexpr int side = 64;
    for (int i = 0; i < side * side; ++i) {
        const LightSample s =
            light.sample(Point3f(Vec3d(scene.object.center())),
                         {(float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side},
                         Wavelengths::rgb_bands());
        if (!(s.pdf > 0)) continue;
        sum += double(s.radiance[1] / s.pdf) / (side * side);
        from = from + Vec3d(s.wi);
    }
    return {sum, normalize(from)};
}

TEST(LightEdits, TurnEachKindOfLightToWhereItIsAskedForAndKeepWhatItGives) {
    const SceneFolder folder;
    const struct {
        const char *name, *element;
    } cases[] = {
        {"lamp (sphere)", lamp},
        {"lamp (rectangle)",
         R"(<shape type="rectangle"><transform name="to_world"><scale value="6"/>
            <lookat origin="-30, 40, 40" target="0, 0, 0" up="0, 1, 0"/></transform>
            <emitter type="area"><rgb name="radiance" value="20, 20, 20"/></emitter></shape>)"},
        {"point", R"(<emitter type="point"><point name="position" x="30" y="40" z="-20"/>
            <rgb name="intensity" value="1e4, 1e4, 1e4"/></emitter>)"},
        {"spot", R"(<emitter type="spot"><transform name="to_world">
            <lookat origin="30, 40, 20" target="0, 0, 0" up="0, 1, 0"/></transform>
            <rgb name="intensity" value="1e4, 1e4, 1e4"/></emitter>)"},
        {"directional",
         R"(<emitter type="directional"><vector name="direction" x="1" y="-1" z="-1"/>
            <rgb name="irradiance" value="3, 3, 3"/></emitter>)"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        const auto scene = folder.scene(std::string(small_sensor) + marble_ball + c.element);
        ASSERT_EQ(scene.lights.size(), 1u);
        EXPECT_EQ(scene.lights[0].name, c.name);
        ViewerState state = scene.state();
        state.lights[0] = {100, 25, 1};
        const auto before = light_at_middle(*scene.scene.lights[0], scene);
        const Scene turned = rebuilt(scene, state);
        const auto after = light_at_middle(*turned.lights[0], scene);
        const auto [azimuth, elevation] = state.camera.compass().angles(after.second);
        EXPECT_NEAR(azimuth, 100, 0.3);
        EXPECT_NEAR(elevation, 25, 0.3);
        EXPECT_NEAR(after.first, before.first, 3e-3 * before.first);
        // The same before the scene is built anew.
        const auto moved = viewer::moved_lights(scene.scene, scene.lights, state.lights,
                                                state.camera.compass(), state.camera.middle());
        const auto at_once = light_at_middle(*moved[0], scene);
        EXPECT_NEAR(at_once.first, after.first, 3e-3 * after.first);
        EXPECT_GT(dot(at_once.second, after.second), 0.9999);
        state.lights[0].brightness = 2.5;
        const Scene bright = rebuilt(scene, state);
        EXPECT_NEAR(light_at_middle(*bright.lights[0], scene).first, 2.5 * after.first,
                    1e-4 * after.first);
        // From wherever it is, a lamp is not in the viewer's way.
        state.lights[0] = {0, 10, 1};
        const Scene front = rebuilt(scene, state);
        const Ray ahead = scene.scene.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f});
        const auto hit = front.rays.intersect(ahead);
        ASSERT_TRUE(hit);
        EXPECT_FALSE(front.shapes[hit->shape].light);
    }
}

TEST(LightEdits, LeaveASkyWhereItIsAndMakeItBrighter) {
    const SceneFolder folder;
    const auto scene = folder.scene(
        std::string(small_sensor) + marble_ball +
        R"(<emitter type="constant"><rgb name="radiance" value="0.5, 0.5, 0.5"/></emitter>)");
    EXPECT_FALSE(scene.lights[0].turns);
    ViewerState state = scene.state();
    state.lights[0].brightness = 4;
    const Spectral radiance =
        rebuilt(scene, state).environment->radiance(nullptr, {0, 1, 0}, Wavelengths::rgb_bands());
    EXPECT_NEAR(radiance[0], 2, 1e-5);
}

TEST(LightEdits, OfALampBehindAWallKeepItsDistance) {
    const SceneFolder folder;
    const std::string wall =
        R"(<shape type="sphere"><float name="radius" value="75"/><boolean name="flip_normals" value="true"/></shape>)";
    const auto scene = folder.scene(std::string(small_sensor) + marble_ball + lamp + wall);
    ViewerState state = scene.state();
    state.lights[0] = {70, 10, 1};
    const Scene turned = rebuilt(scene, state);
    EXPECT_NEAR(length(Vec3d(turned.lights[0]->bounds().center())), std::sqrt(3.) * 40, 0.01);
}

TEST(ViewerScene, RefusesScenesWithoutTranslucentShapes) {
    const SceneFolder folder;
    EXPECT_EQ(
        error_of(
            [&] { folder.scene(std::string(small_sensor) + "<shape type='sphere'/>" + lamp); }),
        "nothing in the scene is translucent: no shape has a homogeneous medium inside behind "
        "a dielectric boundary, smooth or equally rough everywhere; 'nacre render' shows it");
}

}  // namespace
}  // namespace nacre::test
