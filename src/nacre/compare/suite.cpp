#include "nacre/compare/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "nacre/compare/suite_objects.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/scene/media/volume_grid.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

struct Word {
    std::string_view word, label;
};
constexpr Word objects[] = {{"ball", "thick: ball"},
                            {"sheet", "thin: sheet of 2 mm"},
                            {"bowl", "concave: bowl"},
                            {"bust", "curved: bust"},
                            {"slab", "flat: slab"}};
constexpr Word albedos[] = {{"high", "high albedo"}, {"low", "low albedo"}};
constexpr Word matters[] = {{"homogeneous", "homogeneous"}, {"veined", "veined 1:10"}};
constexpr Word lights[] = {
    {"front", "front light"}, {"side", "side light"}, {"back", "back light"}};

std::string label(std::span<const Word> words, std::string_view word) {
    return std::string(std::ranges::find(words, word, &Word::word)->label);
}

constexpr double radius = 30;  // mm, of the sphere that holds the object
constexpr double dim = 0.03;   // radiance of the surroundings, so that nothing is quite black

Vec3f grey(double value) { return {float(value), float(value), float(value)}; }

NodePtr camera(int width, int height) {
    constexpr double fov = 22;
    auto camera = make_node("sensor", "perspective");
    set(camera, "fov", "float", fov);
    set(camera, "fov_axis", "string", std::string("smaller"));
    const double distance = radius / std::sin(fov / 2 * std::numbers::pi / 180);
    set(camera, "to_world", "transform",
        Transform::look_at(direction(0, 20) * distance, {0, 0, 0}, {0, 1, 0}));
    auto film = make_node("film", "hdrfilm");
    set(film, "width", "integer", std::int64_t{width});
    set(film, "height", "integer", std::int64_t{height});
    add(camera, film);
    add(camera, make_node("sampler", "independent"));
    return camera;
}

/// Seven radii away, as large as a cloudy sky's bright part, for soft shadows.
NodePtr light(const std::string& where) {
    const Vec3d from = where == "front"  ? direction(-30, 35)
                       : where == "side" ? direction(-95, 25)
                                         : direction(165, 30);
    const double distance = 7 * radius;
    return ball_light(from * distance, 3 * radius, distance, grey(1), where == "back" ? 3 : 1);
}

NodePtr object(const SuiteCase& which) {
    auto boundary = make_node("bsdf", which.matter == "veined" ? "null" : "dielectric");
    if (which.matter != "veined") {
        set(boundary, "int_ior", "float", 1.5);
        set(boundary, "ext_ior", "float", 1.0);
    }
    auto medium = make_node("medium", "homogeneous");
    if (which.albedo == "high") {
        set_rgb(medium, "sigma_s", {2.19f, 2.62f, 3.00f});
        set_rgb(medium, "sigma_a", {0.0021f, 0.0041f, 0.0071f});
    } else {
        set_rgb(medium, "sigma_s", {2.f, 2.f, 2.f});
        set_rgb(medium, "sigma_a", {0.2f, 0.5f, 1.f});
    }
    add(medium, make_node("phase", "isotropic"));
    auto shape = make_node("shape", "obj");
    shape->id = which.object;
    add(shape, boundary);
    add(shape, medium, "interior");
    return shape;
}

/// Smooth noise in [-1, 1]: random values on a lattice, between them cubic.
float noise(Vec3f p) {
    const auto at = [](int x, int y, int z) {
        return 2.f * to_unit_float(
                         std::uint32_t(stream_key(std::uint64_t(x + 1000), std::uint64_t(y + 1000),
                                                  std::uint64_t(z + 1000), 7) >>
                                       32)) -
               1.f;
    };
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const auto ease = [](float t) { return t * t * (3.f - 2.f * t); };
    const float tx = ease(p.x - fx), ty = ease(p.y - fy), tz = ease(p.z - fz);
    const int x = int(fx), y = int(fy), z = int(fz);
    const auto line = [&](int j, int k) {
        return at(x, y + j, z + k) * (1 - tx) + at(x + 1, y + j, z + k) * tx;
    };
    const auto plane = [&](int k) { return line(0, k) * (1 - ty) + line(1, k) * ty; };
    return plane(0) * (1 - tz) + plane(1) * tz;
}

/// Relative density, `ground` and a tenth of it in the veins, which are 2 to 4 mm wide: where a
/// warped wave passes through 0.
constexpr float thin = 0.1f, ground = 0.25f;
float density(const Vec3f& p) {
    const float warp = 2.2f * noise(p * 0.09f) + 0.9f * noise(p * 0.22f);
    const float wave = std::abs(std::sin(0.16f * (p.x + 0.6f * p.y - 0.4f * p.z) + warp));
    const float t = std::clamp((wave - 0.12f) / 0.25f, 0.f, 1.f);
    return ground * (thin + (1.f - thin) * t * t * (3.f - 2.f * t));
}

std::shared_ptr<VoxelGrid> veins() {
    constexpr int n = 96;  // 0.65 mm a voxel
    auto grid = std::make_shared<VoxelGrid>();
    grid->nx = grid->ny = grid->nz = n;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3f at{float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f};
                grid->data.push_back(
                    density((at * (2.f / n) - Vec3f{1.f, 1.f, 1.f}) * float(radius)));
            }
    return grid;
}

/// Makes the matter veined, or as dense everywhere as the veined one is on average.
void make_veined(Scene& scene, bool even) {
    const auto shape = std::ranges::find_if(
        scene.shapes, [](const ShapeBinding& s) { return s.interior != nullptr; });
    const auto medium = std::make_shared<Medium>(*shape->interior);
    const auto grid = veins();
    if (even) {
        double sum = 0;
        for (const float v : grid->data) sum += v;
        const double mean = sum / double(grid->data.size());
        ColorValue color;
        const Spectral t = medium->sigma_t->eval(Wavelengths::rgb_bands());
        color.rgb = Vec3f(t[0], t[1], t[2]) * float(mean);
        medium->sigma_t = make_spectrum(color, ColorRole::unbounded);
    } else {
        const Spectral t = medium->sigma_t->eval(Wavelengths::rgb_bands());
        auto colored = std::make_shared<VoxelGrid>(*grid);
        colored->channels = 3;
        colored->data.clear();
        for (const float v : grid->data)
            for (int c = 0; c < 3; ++c) colored->data.push_back(v * t[c]);
        GridVolumeOptions options;
        options.to_world = Transform::translate({-radius, -radius, -radius}) *
                           Transform::scale({2 * radius, 2 * radius, 2 * radius});
        medium->sigma_t_volume = make_grid_volume(colored, options, "veins");
    }
    scene.media.push_back(medium);
    shape->interior = medium.get();
}

}  // namespace

std::string SuiteCase::id() const {
    return fmt::format("{} {} {} {}", object, albedo, matter, light);
}

std::vector<std::string> SuiteCase::labels() const {
    return {label(objects, object), label(albedos, albedo), label(matters, matter),
            label(lights, light)};
}

std::vector<SuiteCase> suite_cases(std::string_view filter) {
    const std::vector<std::string_view> wanted = split_words(filter);
    std::vector<std::string> known;
    for (const std::span<const Word> list :
         std::initializer_list<std::span<const Word>>{objects, albedos, matters, lights})
        for (const Word& w : list) known.emplace_back(w.word);
    for (const std::string_view w : wanted)
        if (std::ranges::find(known, w) == known.end())
            throw InputError(
                fmt::format("the suite has no '{}'; its words are: {}", w, fmt::join(known, ", ")));

    // Of each list at least one of its words that are wanted, if any are: ball,bust,front means the
    // ball and the bust in front light.
    const auto passes = [&](std::span<const Word> list, std::string_view word) {
        bool any = false, this_one = false;
        for (const std::string_view w : wanted) {
            any |= std::ranges::find(list, w, &Word::word) != list.end();
            this_one |= w == word;
        }
        return !any || this_one;
    };
    std::vector<SuiteCase> cases;
    for (const Word& object : objects)
        for (const Word& albedo : albedos)
            for (const Word& matter : matters)
                for (const Word& light : lights)
                    if (passes(objects, object.word) && passes(albedos, albedo.word) &&
                        passes(matters, matter.word) && passes(lights, light.word))
                        cases.push_back({std::string(object.word), std::string(albedo.word),
                                         std::string(matter.word), std::string(light.word)});
    return cases;
}

Scene make_suite_scene(const SuiteCase& which, int width, int height, bool even) {
    auto root = make_node("scene", "");
    add(root, make_node("integrator", "volpath"));
    add(root, camera(width, height));
    auto sky = make_node("emitter", "constant");
    set_rgb(sky, "radiance", grey(dim));
    add(root, sky);
    add(root, light(which.light));
    const NodePtr shape = object(which);
    add(root, shape);
    BuildContext context;
    context.meshes[shape.get()] = make_suite_object(which.object);
    Scene scene = build_scene(root, context, ColorMode::rgb_bands);
    if (which.matter == "veined") {
        make_veined(scene, even);
        // For the key: the voxels are in no node.
        set(root, "matter", "string", std::string(even ? "even 1" : "veined 1"));
    }
    return scene;
}

}  // namespace nacre
