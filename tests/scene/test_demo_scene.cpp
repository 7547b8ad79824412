// The built-in scene: what it promises, seen by rays; and every scene file that is shipped loads.
#include "nacre/scene/demo_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/scene/load.h"
#include "nacre/scene/media/volume_grid.h"

namespace nacre {
namespace {

const Scene& portrait() {
    static const Scene scene = make_demo_scene(120, 160);
    return scene;
}

/// The shape that the camera sees at a point of the film; empty for the background.
std::string seen(const Scene& scene, float x, float y) {
    const auto hit = scene.rays.intersect(scene.camera->ray({x, y}, {0.5f, 0.5f}));
    return hit ? scene.shapes[hit->shape].name : "";
}

TEST(DemoScene, IsTranslucentAndReadyToRender) {
    const Scene& scene = portrait();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.film.width, 120);
    EXPECT_EQ(scene.film.height, 160);
    EXPECT_EQ(scene.integrator.type, "volpath");
    ASSERT_EQ(scene.media.size(), 1u);
    EXPECT_TRUE(scene.media[0]->homogeneous());
    int translucent = 0;
    for (const ShapeBinding& shape : scene.shapes)
        if (shape.interior == scene.media[0].get()) {
            ++translucent;
            EXPECT_FLOAT_EQ(shape.material->smooth_boundary_eta(), 1.35f);
        }
    EXPECT_EQ(translucent, 1);
}

// Light gets inside through a refracting boundary from lights that have an extent only.
TEST(DemoScene, HasNoLightsOfNoExtent) {
    const Scene& scene = portrait();
    EXPECT_EQ(scene.lights.size(), 4u);
    EXPECT_NE(scene.environment, nullptr);
    for (const LightPtr& light : scene.lights) EXPECT_FALSE(light->is_delta());
}

TEST(DemoScene, ShowsTheBustAndNoLight) {
    const Scene& scene = portrait();
    int bust = 0;
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 60; ++x) {
            const std::string name = seen(scene, (x + 0.5f) / 60, (y + 0.5f) / 80);
            EXPECT_TRUE(name.empty() || name == "figure") << name << " at " << x << ", " << y;
            bust += name == "figure";
        }
    // A portrait fills a good part of the film, with air on three sides.
    EXPECT_GT(bust, 80 * 60 / 4);
    EXPECT_LT(bust, 80 * 60 / 2);
    for (int i = 0; i < 80; ++i) {
        const float t = (i + 0.5f) / 80;
        EXPECT_EQ(seen(scene, 0.01f, t), "");
        EXPECT_EQ(seen(scene, 0.99f, t), "");
        EXPECT_EQ(seen(scene, t, 0.01f), "");
    }
}

// A point on the face is lit by the key light; the ears are in view of the lights behind.
TEST(DemoScene, LightsTheFaceFromInFrontAndTheEarsFromBehind) {
    const Scene& scene = portrait();
    const Wavelengths bands = Wavelengths::rgb_bands();
    int in_front = 0, behind = 0;
    for (const LightPtr& light : scene.lights) {
        if (light->is_infinite()) continue;
        const LightSample s = light->sample({0, 290, 0}, {0.5f, 0.5f}, bands);
        ASSERT_GT(s.pdf, 0.f);
        (s.wi.z > 0 ? in_front : behind) += 1;
    }
    EXPECT_EQ(in_front, 1);
    EXPECT_EQ(behind, 2);
}

TEST(DemoScene, TakesSamplesByTheSizeOfTheFilm) {
    EXPECT_EQ(make_demo_scene(480, 640).sampler.samples, 48);  // 15e6 / 307200
    EXPECT_EQ(portrait().sampler.samples, 256);
}

TEST(DemoScene, KeepsTheBustInViewOnNarrowFilms) {
    const Scene narrow = make_demo_scene(40, 160);
    for (int i = 0; i < 160; ++i) {
        EXPECT_EQ(seen(narrow, 0.01f, (i + 0.5f) / 160), "");
        EXPECT_EQ(seen(narrow, 0.99f, (i + 0.5f) / 160), "");
    }
    EXPECT_EQ(seen(narrow, 0.5f, 0.5f), "figure");
}

TEST(DemoScene, RefusesFilmsWithoutArea) {
    for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {65537, 10}}) {
        try {
            make_demo_scene(width, height);
            ADD_FAILURE() << width << " x " << height;
        } catch (const InputError& e) {
            EXPECT_EQ(std::string(e.what()),
                      fmt::format("the film of the built-in scene must have sides of 1 to 65536 "
                                  "pixels; got {} x {}",
                                  width, height));
        }
    }
}

/// The smoke of scenes/smoke.vol in the unit cube: two strands that wind about the axis, widen and
/// thin out on their way up, and fade at both ends.
double smoke(double x, double y, double z) {
    double density = 0;
    for (const int strand : {0, 1}) {
        const double angle = 9 * y + std::numbers::pi * strand, away = 0.02 + 0.2 * y;
        const double radius = 0.07 + 0.1 * y;
        const double dx = x - 0.5 - away * std::cos(angle), dz = z - 0.5 - away * std::sin(angle);
        density += std::exp(-(dx * dx + dz * dz) / (radius * radius)) * 0.07 / radius;
    }
    return density * std::min(1.0, y / 0.1) * std::min(1.0, (1 - y) / 0.35);
}

TEST(ShippedScenes, SmokeIsWhatItsFormulaSays) {
    const auto grid = read_vol(std::filesystem::path(NACRE_SOURCE_DIR) / "scenes/smoke.vol");
    ASSERT_EQ(grid->channels, 1);
    ASSERT_EQ(grid->nx, 24);
    ASSERT_EQ(grid->ny, 24);
    ASSERT_EQ(grid->nz, 24);
    for (int z = 0; z < 24; ++z)
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
                ASSERT_NEAR(grid->data[static_cast<std::size_t>((z * 24 + y) * 24 + x)],
                            smoke((x + 0.5) / 24, (y + 0.5) / 24, (z + 0.5) / 24), 1e-6)
                    << x << ", " << y << ", " << z;
}

TEST(ShippedScenes, LoadWithoutWarnings) {
    int scenes = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(NACRE_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".xml") continue;
        SCOPED_TRACE(entry.path().filename().string());
        ++scenes;
        const Scene scene = load_scene(entry.path());
        EXPECT_EQ(scene.warnings, std::vector<std::string>{});
    }
    EXPECT_GE(scenes, 3);
}

}  // namespace
}  // namespace nacre
