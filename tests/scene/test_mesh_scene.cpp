// A bare mesh as a scene: what stands where, and how bright it is.
#include <numbers>

#include "nacre/geometry/mesh_build.h"
#include "nacre/optics/media.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

std::shared_ptr<Mesh> sphere_mesh() {
    auto mesh = std::make_shared<Mesh>(make_icosphere(3));
    for (Point3f& p : mesh->positions) p = p * 3.f + Vec3f{7, -2, 11};  // anywhere, any size
    mesh->name = "ball";
    return mesh;
}

std::uint32_t shape_named(const Scene& scene, const std::string& name) {
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (scene.shapes[i].name == name) return i;
    ADD_FAILURE() << "no shape " << name;
    return 0;
}

/// The ray through a point of the film in [0,1]^2.
bool hits_object(const Scene& scene, float x, float y, std::uint32_t object) {
    const auto hit = scene.rays.intersect(scene.camera->ray({x, y}, {0.5f, 0.5f}));
    return hit && hit->shape == object;
}

TEST(MeshScene, ScalesToTheHeightAndStandsOnTheFloor) {
    const auto mesh = sphere_mesh();
    const Point3f before = mesh->positions[0];
    const Scene scene = make_mesh_scene(mesh, {.material = "marble", .height_mm = 80});
    EXPECT_EQ(mesh->positions[0], before) << "the caller's mesh was changed";
    const Box3f box = scene.rays.bounds(shape_named(scene, "ball"));
    EXPECT_NEAR(box.lower.y, 0.f, 1e-3f);
    EXPECT_NEAR(box.upper.y, 80.f, 1e-3f);
    EXPECT_NEAR(box.center().x, 0.f, 0.01f);
    EXPECT_NEAR(box.center().z, 0.f, 0.01f);
    EXPECT_EQ(scene.mm_per_unit, 1.0);
    EXPECT_TRUE(scene.warnings.empty());
    // The floor is just below, and carries no medium.
    const auto hit = scene.rays.intersect({{150, 50, 0}, {0, -1, 0}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 50.08f, 1e-3f);
    EXPECT_FALSE(scene.shapes[hit->shape].separates_media);
}

TEST(MeshScene, ObjectHoldsTheMeasuredMedium) {
    const Scene scene = make_mesh_scene(sphere_mesh(), {.material = "Marble"});
    const ShapeBinding& object = scene.shapes[shape_named(scene, "ball")];
    ASSERT_NE(object.interior, nullptr);
    EXPECT_EQ(object.exterior, nullptr);
    // Jensen et al. 2001, table: marble 2.19, 2.62, 3.00 and .0021, .0041, .0071 mm^-1, eta 1.5.
    const MediumCoefficients c = object.interior->coefficients({}, Wavelengths::rgb_bands());
    EXPECT_NEAR(c.sigma_s[0], 2.19f, 1e-4f);
    EXPECT_NEAR(c.sigma_s[1], 2.62f, 1e-4f);
    EXPECT_NEAR(c.sigma_s[2], 3.00f, 1e-4f);
    EXPECT_NEAR(c.sigma_t[0] - c.sigma_s[0], 0.0021f, 1e-5f);
    EXPECT_NEAR(c.sigma_t[2] - c.sigma_s[2], 0.0071f, 1e-5f);
    EXPECT_EQ(object.interior->phase.kind(), PhaseFunction::Kind::isotropic);
    EXPECT_NEAR(object.material->smooth_boundary_eta(), 1.5f, 1e-6f);
    EXPECT_EQ(scene.mode, ColorMode::rgb_bands);
    EXPECT_EQ(scene.integrator.type, "volpath");
}

TEST(MeshScene, ObjectMayBeSkin) {
    for (const char* name : {"skin", "Skin"}) {
        const Scene scene = make_mesh_scene(sphere_mesh(), {.material = name});
        const ShapeBinding& object = scene.shapes[shape_named(scene, "ball")];
        ASSERT_NE(object.interior, nullptr);
        EXPECT_TRUE(object.interior->is_spectral());
        EXPECT_EQ(scene.mode, ColorMode::spectral);
        EXPECT_NEAR(object.material->smooth_boundary_eta(), 1.4f, 1e-6f);
        // Jacques 1998: 2e5 600^-1.5 + 2e12 600^-4 cm^-1 of reduced scattering at 600 nm.
        const Wavelengths w = Wavelengths::at(Spectral(600.f));
        EXPECT_NEAR(object.interior->coefficients({}, w).sigma_s[0], 2.9040375f, 1e-5f);
    }
    const Scene rgb =
        make_mesh_scene(sphere_mesh(), {.material = "skin", .mode = ColorMode::rgb_bands});
    EXPECT_EQ(rgb.mode, ColorMode::rgb_bands);
}

TEST(MeshScene, CameraFramesTheBoundingSphere) {
    const Scene scene = make_mesh_scene(sphere_mesh(), {});
    const auto object = shape_named(scene, "ball");
    EXPECT_TRUE(hits_object(scene, 0.5f, 0.5f, object));
    // The bounding box's sphere, sqrt(3) times as wide as the ball in it, fills 1/1.08 of the angle
    // (in sines: sin of the half angle is sin 13 deg / 1.08, and the ball's is that over sqrt 3).
    const double half = std::asin(std::sin(13 * std::numbers::pi / 180) / 1.08 / std::sqrt(3.0));
    const double edge = 0.5 * std::tan(half) / std::tan(13 * std::numbers::pi / 180);
    for (const float side : {-1.f, 1.f}) {
        EXPECT_TRUE(hits_object(scene, float(0.5 + side * (edge - 0.01)), 0.5f, object));
        EXPECT_FALSE(hits_object(scene, float(0.5 + side * (edge + 0.01)), 0.5f, object));
        EXPECT_TRUE(hits_object(scene, 0.5f, float(0.5 + side * (edge - 0.01)), object));
        EXPECT_FALSE(hits_object(scene, 0.5f, float(0.5 + side * (edge + 0.01)), object));
    }
    const Ray ray = scene.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f});
    EXPECT_GT(ray.o.z, 0.f);  // from the front,
    EXPECT_LT(ray.d.y, 0.f);  // slightly above
}

TEST(MeshScene, LightsStayOutOfThePictureOfAnyShape) {
    for (const auto& [width, height] : {std::pair{512, 512}, {1920, 1080}, {600, 900}}) {
        const Scene scene = make_mesh_scene(sphere_mesh(), {.width = width, .height = height});
        for (int i = 0; i < 64 * 64; ++i) {
            const auto hit = scene.rays.intersect(
                scene.camera->ray({(i % 64 + 0.5f) / 64, (i / 64 + 0.5f) / 64}, {0.5f, 0.5f}));
            ASSERT_FALSE(hit && scene.shapes[hit->shape].light) << width << " x " << height;
        }
    }
}

/// Radiance of a white diffuse surface at the object's middle if nothing is in the way.
float white(const Scene& scene, const Vec3f& normal) {
    const Point3f middle{0, 50, 0};
    double sum = 0;
    constexpr int side = 64;
    for (const LightPtr& light : scene.lights)
        for (int i = 0; i < side * side; ++i) {
            const Vec2f u{(i % side + 0.5f) / side, (i / side + 0.5f) / side};
            const LightSample s = light->sample(middle, u, Wavelengths::rgb_bands());
            const float cosine = dot(s.wi, normal);
            if (s.pdf <= 0 || cosine <= 0) continue;
            sum += luminance({s.radiance[0], s.radiance[1], s.radiance[2]}) * cosine / s.pdf /
                   std::numbers::pi / (side * side);
        }
    return static_cast<float>(sum);
}

TEST(MeshScene, ExposureKeepsWhiteJustBelowOne) {
    const Scene scene = make_mesh_scene(sphere_mesh(), {});
    ASSERT_NE(scene.environment, nullptr);
    const float front = white(scene, normalize(Vec3f{-0.42f, 0.64f, 0.64f}));
    EXPECT_GT(front, 0.7f);
    EXPECT_LT(front, 1.f);
    const float back = white(scene, normalize(Vec3f{0.3f, 0.64f, -0.7f}));
    EXPECT_GT(back, 2 * front);  // light from behind for translucency
}

TEST(MeshScene, TurnsInsideOutMeshesRound) {
    auto mesh = sphere_mesh();
    for (Mesh::Triangle& t : mesh->triangles) std::swap(t[0], t[1]);
    const Scene scene = make_mesh_scene(mesh, {});
    const Ray ray{{0, 50, 300}, {0, 0, -1}};
    const auto hit = scene.rays.intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_GT(scene.rays.surface_point(ray, *hit).ng.z, 0.9f);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(MeshScene, WarnsAboutOpenMeshes) {
    auto mesh = sphere_mesh();
    mesh->triangles.pop_back();
    const Scene scene = make_mesh_scene(mesh, {});
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].starts_with("'ball': ")) << scene.warnings[0];
}

TEST(MeshScene, WideThingsAreNoLandscapes) {
    const auto size = [](const Vec3f& half, std::optional<double> height = {}) {
        auto mesh = std::make_shared<Mesh>(make_cube());
        mesh->name = "box";
        for (Point3f& p : mesh->positions) p = {p.x * half.x, p.y * half.y, p.z * half.z};
        const Scene scene = make_mesh_scene(mesh, {.height_mm = height});
        return scene.rays.bounds(shape_named(scene, "box")).diagonal();
    };
    EXPECT_NEAR(size({2.4f, 1, 1}).y, 100, 1e-3f);
    EXPECT_NEAR(size({5, 1, 2}).x, 250, 1e-3f);
    EXPECT_NEAR(size({5, 1, 2}).y, 50, 1e-3f);
    EXPECT_NEAR(size({1, 0.1f, 10}).z, 250, 1e-3f);
    EXPECT_NEAR(size({5, 1, 2}, 100).x, 500, 1e-3f);
    EXPECT_NEAR(size({1e-5f, 2e-5f, 1e-5f}).x, 50, 1e-3f);
    EXPECT_NEAR(size({1e5f, 2e5f, 1e5f}).x, 50, 1e-3f);
}

class MeshSceneFiles : public SceneFiles {};

TEST_F(MeshSceneFiles, StandsAsTheFormatHasItOrTheShapeTells) {
    // A cube says nothing; a pyramid stands on its base, which is at +x.
    const std::string cube =
        "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\n"
        "v -1 1 1\nv 1 1 1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\n"
        "f 1 5 7 3\nf 2 4 8 6\n";
    const std::string pyramid =
        "v 1 -1 -1\nv 1 1 -1\nv 1 1 1\nv 1 -1 1\nv -2 0 0\nf 1 2 3 4\n"
        "f 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";
    const auto pose_of = [&](const std::filesystem::path& file, std::optional<SignedAxis> up = {}) {
        MeshPose pose;
        load_mesh_scene(file, {.up = up, .pose = &pose});
        return name_of(pose.up) + name_of(pose.front);
    };
    EXPECT_EQ(pose_of(write("cube.obj", cube)), "+y+z");
    EXPECT_EQ(pose_of(folder_ / "cube.obj", SignedAxis{2, -1}), "-z+y");
    EXPECT_EQ(pose_of(write("pyramid.obj", pyramid)), "-x+z");
    const std::string facet =
        "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n"
        "endloop\nendfacet\nendsolid a\n";
    EXPECT_EQ(pose_of(write("a.stl", facet)), "+z-y");
    EXPECT_EQ(pose_of(write("b.STL", facet)), "+z-y");
}

TEST_F(MeshSceneFiles, TurnsPositionsAndNormals) {
    const auto file = write("cone.obj",
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 3\nvn 0 0 1\nf 1//1 3//1 2//1\n"
                            "f 1//1 2//1 4//1\nf 2//1 3//1 4//1\nf 3//1 1//1 4//1\n");
    const Scene scene = load_mesh_scene(file, {.height_mm = 3, .up = SignedAxis{2, 1}});
    const std::uint32_t shape = shape_named(scene, "cone.obj");
    EXPECT_NEAR(length(scene.rays.bounds(shape).diagonal() - Vec3f(1, 3, 1)), 0, 1e-5f);
    for (const Vec3f& n : scene.rays.mesh(shape)->normals) EXPECT_EQ(n, Vec3f(0, 1, 0));
}

TEST_F(MeshSceneFiles, RefusesWrongInput) {
    const auto file = write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n");
    EXPECT_EQ(error_of([&] { load_mesh_scene(file); }),
              "flat.off: has no height along +y, which is up; turn it upright (--up)");
    EXPECT_EQ(error_of([&] { load_mesh_scene(file, {.height_mm = -1}); }),
              "the height of the object must be positive; got -1 mm");
    // The name of the medium is checked before the file is opened.
    const std::string message =
        error_of([&] { load_mesh_scene(folder_ / "no.obj", {.material = "marbel"}); });
    EXPECT_TRUE(message.starts_with("unknown measured medium 'marbel'; did you mean 'Marble'?"))
        << message;
}

}  // namespace
}  // namespace nacre
