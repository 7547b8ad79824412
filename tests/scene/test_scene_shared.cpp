// Scenes of other renderers' authors, which nacre must read as they are.
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class SharedScenes : public SceneFiles {
  protected:
    void SetUp() override {
        SceneFiles::SetUp();
        if (!fs::exists(shared_ / "data/scene"))
            GTEST_SKIP() << "no scenes at " << shared_ / "data/scene";
    }
    fs::path shared_ = NACRE_SHARED_DIR;
};

TEST_F(SharedScenes, BenchmarksLoad) {
    const Scene diffuse = load_scene(shared_ / "bench/diffuse_bunny.xml");
    EXPECT_EQ(diffuse.shapes.size(), 3u);
    EXPECT_EQ(diffuse.lights.size(), 2u);
    EXPECT_EQ(diffuse.integrator.type, "path");
    EXPECT_EQ(diffuse.integrator.max_depth, 6);
    EXPECT_EQ(diffuse.integrator.rr_depth, 100000);
    EXPECT_EQ(diffuse.film.filter.type, "box");
    EXPECT_EQ(diffuse.sampler.samples, 16);
    EXPECT_TRUE(diffuse.warnings.empty());
    EXPECT_EQ(load_scene(shared_ / "bench/diffuse_bunny.xml", {.defines = {{"spp", "3"}}})
                  .sampler.samples,
              3);

    const Scene marble = load_scene(shared_ / "bench/marble_bunny.xml");
    ASSERT_EQ(marble.media.size(), 1u);
    EXPECT_EQ(marble.shapes[2].interior, marble.media[0].get());
    EXPECT_EQ(marble.mode, ColorMode::rgb_bands);
    EXPECT_TRUE(marble.warnings.empty());
    EXPECT_NEAR(marble.media[0]->coefficients({}, Wavelengths::rgb_bands()).sigma_t[2], 3.0071f,
                1e-4f);
    // From Mitsuba's own description: the camera stands at (0, 70, 330) and looks along -z.
    const Ray ray = marble.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f});
    EXPECT_NEAR(ray.o.y, 70.f, 1e-4f);
    EXPECT_LT(ray.d.z, -0.99f);
    // Its light hangs behind the bunny's left and shines towards it.
    const auto hit = marble.rays.intersect({{0, 50, 0}, normalize(Vec3f{-250, 200, -200})});
    ASSERT_TRUE(hit);
}

TEST_F(SharedScenes, MitsubaMediaLoad) {
    const struct {
        const char* name;
        std::size_t shapes, lights, media;
    } scenes[] = {
        {"test_hetero_sigmat_albedo_volpath", 3, 1, 1},
        {"test_homo_area_light_volpath", 4, 1, 1},
        {"test_homo_null_envmap_volpath", 3, 1, 1},
        {"test_homo_obj_inside_medium_volpath", 5, 1, 1},
        {"test_surf_area_light_volpath", 4, 2, 0},
    };
    for (const auto& s : scenes) {
        SCOPED_TRACE(s.name);
        const Scene scene =
            load_scene(shared_ / "data/scene/mitsuba_media" / fmt::format("{}.xml", s.name),
                       {.defines = {{"spp", "2"}, {"res", "16"}}});
        EXPECT_EQ(scene.shapes.size(), s.shapes);
        EXPECT_EQ(scene.lights.size(), s.lights);
        EXPECT_EQ(scene.media.size(), s.media);
        EXPECT_EQ(scene.integrator.type, "volpath");
        EXPECT_TRUE(scene.integrator.moment);
        EXPECT_EQ(scene.integrator.max_depth, 6);
        EXPECT_EQ(scene.film.width, 16);
        EXPECT_EQ(scene.sampler.samples, 2);
    }
}

TEST_F(SharedScenes, MitsubaSubsurfaceNeedsItsBunny) {
    const fs::path folder = shared_ / "data/scene/mitsuba_sss";
    const std::string message =
        error_of([&] { load_scene(folder / "medium_homogeneous_sss.xml"); });
    EXPECT_EQ(message, fmt::format("{0}/medium_homogeneous_sss.xml:26:9: cannot find "
                                   "'meshes/bunny.ply'; searched in: {0}, {0}/../../common",
                                   folder.string()));
    // With the mesh and the picture that it names elsewhere it loads.
    fs::copy(folder, folder_, fs::copy_options::recursive);
    fs::permissions(folder_ / "meshes", fs::perms::owner_all);
    fs::create_directory(folder_ / "textures");
    fs::copy_file(shared_ / "data/mesh/mitsuba_bunny.ply", folder_ / "meshes/bunny.ply");
    fs::copy_file(shared_ / "data/scene/mitsuba_media/textures/museum.exr",
                  folder_ / "textures/museum.exr");
    const Scene scene = load_scene(folder_ / "medium_homogeneous_sss.xml");
    EXPECT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.film.width, 960);
    EXPECT_EQ(scene.integrator.max_depth, 64);  // the outer file's defaults come first
    ASSERT_EQ(scene.media.size(), 1u);
    // sigma_t 10 times scale 5; the blue albedo is 0.999999.
    const MediumCoefficients c = scene.media[0]->coefficients({}, Wavelengths::rgb_bands());
    EXPECT_NEAR(c.sigma_t[0], 50.f, 1e-3f);
    EXPECT_NEAR(c.sigma_s[0], 42.5f, 1e-3f);
}

TEST_F(SharedScenes, LajollaLoadsAfterItsNamesAreUpgraded) {
    const Scene scene = load_scene(shared_ / "data/scene/lajolla/volpath_test4.xml");
    ASSERT_EQ(scene.media.size(), 2u);
    // sigma_a 1, sigma_s 5, scale 0.05.
    const MediumCoefficients c = scene.media[0]->coefficients({}, Wavelengths::rgb_bands());
    EXPECT_NEAR(c.sigma_t[1], 0.3f, 1e-6f);
    EXPECT_NEAR(c.sigma_s[1], 0.25f, 1e-6f);
    EXPECT_EQ(scene.camera_medium, scene.media[0].get());
    EXPECT_EQ(scene.integrator.max_depth, 6);
    EXPECT_EQ(scene.sampler.samples, 1024);
    EXPECT_TRUE(scene.shapes[0].material->flags() & has_null);
    EXPECT_EQ(scene.shapes[0].interior, scene.media[1].get());
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_NO_THROW(load_scene(shared_ / "data/scene/lajolla/volpath_test5.xml"));
}

TEST_F(SharedScenes, PbrtIsRefused) {
    const fs::path file = shared_ / "data/scene/pbrt2/killeroo-simple.pbrt";
    EXPECT_EQ(error_of([&] { load_scene(file); }),
              file.string() +
                  ":1:1: is a pbrt scene, not an XML scene; nacre reads Mitsuba 3's "
                  "XML, so convert it first");
}

}  // namespace
}  // namespace nacre
