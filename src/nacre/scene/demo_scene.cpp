#include "nacre/scene/demo_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "nacre/geometry/figure.h"
#include "nacre/scene/lights/types.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre {
namespace {

// Where the camera stands and looks, and where the head is (mm; figure.h says how the bust stands).
const Vec3d eye{422, 260, 795}, aim{0, 228, 0}, head{0, 290, 0};

/// A square light of a half side in mm that faces the head.
NodePtr softbox(const Vec3d& at, double half, const Vec3f& radiance) {
    auto light = make_node("emitter", "area");
    set_rgb(light, "radiance", radiance);
    auto shape = make_node("shape", "rectangle");
    set(shape, "to_world", "transform",
        Transform::look_at(at, head, {0, 1, 0}) * Transform::scale({half, half, 1}));
    add(shape, light);
    return shape;
}

NodePtr camera(int width, int height) {
    auto camera = make_node("sensor", "perspective");
    // The bust fills a portrait film of 3:4; a narrower one needs a wider view.
    const double narrow = std::max(1.0, 0.75 * height / width);
    constexpr double half_angle = 13.5 * std::numbers::pi / 180;
    const double fov = 360 / std::numbers::pi * std::atan(narrow * std::tan(half_angle));
    set(camera, "fov", "float", fov);
    set(camera, "fov_axis", "string", std::string("y"));
    set(camera, "to_world", "transform", Transform::look_at(eye, aim, {0, 1, 0}));
    auto film = make_node("film", "hdrfilm");
    set(film, "width", "integer", std::int64_t{width});
    set(film, "height", "integer", std::int64_t{height});
    add(camera, film);
    auto sampler = make_node("sampler", "sobol");
    // As many as two cores make in less than a minute.
    const double samples = 15e6 / (double(width) * height);
    set(sampler, "sample_count", "integer", std::int64_t(std::clamp(samples, 16.0, 256.0)));
    add(camera, sampler);
    return camera;
}

NodePtr bust() {
    auto boundary = make_node("bsdf", "dielectric");
    set(boundary, "int_ior", "float", 1.35);
    set(boundary, "ext_ior", "float", 1.0);
    // Not a measured medium. One extinction for all colours: free paths are the same for all, so
    // that what noise there is has no colour. Absorption rises towards blue, as in wax and skin:
    // the longer light has travelled, the warmer it is. A free path of 1.25 mm lets much of it
    // through the ears, and is short beside the features of the face.
    auto medium = make_node("medium", "homogeneous");
    set(medium, "sigma_t", "float", 0.8);
    set_rgb(medium, "albedo", {0.994f, 0.976f, 0.936f});
    add(medium, make_node("phase", "isotropic"));
    auto shape = make_node("shape", "obj");
    shape->id = "figure";
    add(shape, boundary);
    add(shape, medium, "interior");
    return shape;
}

/// Surroundings that fill the shadows, and grow dark where the camera looks: the picture's
/// background.
LightPtr studio(float scene_radius) {
    const Vec3f fill{0.07f, 0.078f, 0.095f};
    constexpr float centre = 0.35f, border = 0.12f;  // background, relative to `fill`
    Image image(128, 65);
    const Vec3d ahead = normalize(aim - eye);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double phi = 2 * std::numbers::pi * (x + 0.5) / image.width,
                         theta = std::numbers::pi * y / (image.height - 1);
            const Vec3d d{std::sin(theta) * std::sin(phi), std::cos(theta),
                          -std::sin(theta) * std::cos(phi)};
            const double angle = std::acos(std::clamp(dot(d, ahead), -1.0, 1.0));
            const auto step = [&](double from, double to) {
                const double t = std::clamp((angle - from) / (to - from), 0.0, 1.0);
                return static_cast<float>(t * t * (3 - 2 * t));
            };
            const float dark = centre + (border - centre) * step(0.0, 0.3);
            const float level = dark + (1.f - dark) * step(0.5, 1.1);
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = fill[c] * level;
        }
    EnvironmentPlacement placement;
    placement.scene_radius = scene_radius;
    std::vector<std::string> warnings;
    return make_environment_map(image, placement, "studio", warnings);
}

}  // namespace

Scene make_demo_scene(int width, int height) {
    if (width < 1 || height < 1 || width > 65536 || height > 65536)
        throw InputError(fmt::format(
            "the film of the built-in scene must have sides of 1 to 65536 pixels; got {} x {}",
            width, height));
    auto root = make_node("scene", "");
    add(root, make_node("integrator", "volpath"));
    add(root, camera(width, height));
    add(root, softbox({-420, 640, 520}, 250, {2.7f, 3.0f, 3.5f}));
    add(root, softbox({600, 520, -420}, 250, {13.f, 11.4f, 9.4f}));
    add(root, softbox({-760, 500, -300}, 250, {13.f, 11.4f, 9.4f}));
    const NodePtr figure = bust();
    add(root, figure);

    BuildContext context;
    // Two and a half pixels a cell: the normals are smooth.
    context.meshes[figure.get()] = std::make_shared<Mesh>(
        make_figure(std::clamp(1050.f / static_cast<float>(height), 1.2f, 1.6f)));
    Scene scene = build_scene(root, context, ColorMode::rgb_bands);
    scene.lights.push_back(studio(0.5f * length(scene.rays.bounds().diagonal())));
    scene.environment = scene.lights.back().get();
    return scene;
}

}  // namespace nacre
