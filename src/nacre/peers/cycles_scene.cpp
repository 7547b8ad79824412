#include "nacre/peers/cycles_scene.h"

#include <fmt/format.h>

#include <numbers>

#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/peers/mesh.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr int most_bounces = 1024;  // Cycles allows no more

/// nacre counts segments of a path: 2 show light that was scattered once. Cycles counts
/// scatterings without that first one.
int max_bounces(const Scene& scene, Substitutions& substitutions) {
    const int depth = scene.integrator.max_depth;
    if (depth == 0 || depth == 1)
        throw InputError(
            "Blender Cycles always shows light that was scattered once; compare with a max_depth "
            "of 2 or more");
    const bool media = std::ranges::any_of(
        scene.shapes, [](const ShapeBinding& s) { return s.interior != nullptr; });
    if (depth > 0 && depth - 2 <= most_bounces) return depth - 2;
    if (media) substitutions.add(fmt::format("paths end after {} scatterings", most_bounces));
    return most_bounces;
}

json film(const Scene& scene, const std::string& output, bool mirrored,
          Substitutions& substitutions) {
    const FilmSettings& f = scene.film;
    const FilterSettings& filter = f.filter;
    const auto as_gaussian = [&](double deviation) -> json {
        substitutions.add(fmt::format("the {} filter is a Gaussian of standard deviation {:.4g}",
                                      filter.type, deviation));
        return {"GAUSSIAN", 4 * deviation};
    };
    json shape;
    // Cycles' Gaussian of width w is exp(-8 x^2 / w^2), so its deviation is w / 4.
    if (filter.type == "gaussian") {
        shape = {"GAUSSIAN", 4 * double(filter.stddev)};
    } else if (filter.type == "box") {
        const double radius = filter.radius > 0 ? filter.radius : 0.5;
        shape = radius == 0.5 ? json{"BOX", 1.0} : as_gaussian(radius / std::sqrt(3.));
    } else if (filter.type == "tent") {
        shape = as_gaussian((filter.radius > 0 ? filter.radius : 1.) / std::sqrt(6.));
    } else {
        shape = as_gaussian(0.5);
    }
    const int width = f.crop_width > 0 ? f.crop_width : f.width,
              height = f.crop_width > 0 ? f.crop_height : f.height;
    const int x = mirrored ? f.width - f.crop_x - width : f.crop_x;
    return {{"width", f.width},
            {"height", f.height},
            {"crop", {x, f.crop_y, width, height}},
            {"filter", shape},
            {"output", output}};
}

json camera(const PeerView& view) {
    // A mirror image is rendered the right way round and turned over afterwards.
    const Vec3d right = view.mirrored ? view.right * -1.0 : view.right;
    const double shift = view.mirrored ? -view.shift.x : view.shift.x;
    const Vec3d &up = view.up, back = view.forward * -1.0, &o = view.origin;
    return {{"type", view.orthographic ? "orthographic" : "perspective"},
            {"to_world",
             {right.x, up.x, back.x, o.x, right.y, up.y, back.y, o.y, right.z, up.z, back.z, o.z,
              0., 0., 0., 1.}},
            {"width", 2 * view.half_width},
            {"shift", {shift, view.shift.y * view.half_height / view.half_width}},
            {"clip", {view.near, std::min(view.far, 1e9)}},
            {"aperture_radius", view.aperture_radius},
            {"focus_distance", view.focus_distance}};
}

json lights(const Scene& scene) {
    json list = json::array();
    for (const SceneNode::Child* child : scene.root->children_of("emitter")) {
        const SceneNode& node = *child->node;
        const auto emission = [&](const char* name) {
            const SpectrumPtr given =
                get_spectrum(node, name, ColorRole::illuminant, make_rgb_illuminant({1, 1, 1}));
            return color_and_strength(given->rgb());
        };
        json light;
        if (node.type == "point") {
            light = emission("intensity");
            light["type"] = "point";
            light["position"] =
                triple(node.has("position") ? Point3f(node.get_vector("position", {}))
                                            : node.get_transform("to_world").point({}));
        } else if (node.type == "spot") {
            const Transform to_world = node.get_transform("to_world");
            const double cutoff = node.get_float("cutoff_angle", 20.),
                         beam = node.get_float("beam_width", 0.75 * cutoff);
            constexpr double degree = std::numbers::pi / 180;
            light = emission("intensity");
            light["type"] = "spot";
            light["position"] = triple(to_world.point({}));
            light["direction"] = triple(normalize(to_world.vector({0, 0, 1})));
            light["cutoff"] = cutoff * degree;
            light["beam"] = std::min(beam, cutoff - 1e-4) * degree;
        } else if (node.type == "directional") {
            const Vec3d direction = node.has("direction")
                                        ? node.get_vector("direction", {})
                                        : node.get_transform("to_world").map_vector({0, 0, 1});
            light = emission("irradiance");
            light["type"] = "sun";
            light["direction"] = triple(Vec3f(normalize(direction)));
        } else {
            continue;  // at infinity: Scene::environment
        }
        list.push_back(std::move(light));
    }
    return list;
}

/// Width of the picture that an environment map was made of; 0 if it was made in memory.
int source_width(const Scene& scene, const BuildContext& context) {
    for (const SceneNode::Child* child : scene.root->children_of("emitter"))
        if (child->node->type == "envmap")
            return read_image(context.file(*child->node, "filename")).width;
    return 0;
}

json environment(const Scene& scene, const std::filesystem::path& folder, BuildContext& context,
                 Substitutions& substitutions) {
    const Wavelengths w = Wavelengths::rgb_bands();
    if (!scene.environment) return json::object();
    const auto towards = [&](const Vec3f& d) {
        const Spectral radiance = scene.environment->radiance(nullptr, d, w);
        return Vec3f{radiance[0], radiance[1], radiance[2]};
    };
    if (scene.environment->is_uniform()) return color_and_strength(towards({0, 0, 1}));
    const int width = std::clamp(source_width(scene, context), 1024, 8192), height = width / 2;
    constexpr double pi = std::numbers::pi;
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // Blender: the middle of the picture is +x, its left +y, its top +z.
            const double azimuth = (1 - 2 * (x + 0.5) / width) * pi,
                         elevation = (0.5 - (y + 0.5) / height) * pi;
            const double c = std::cos(elevation);
            const Vec3f rgb = towards(
                Vec3f(Vec3d{c * std::cos(azimuth), c * std::sin(azimuth), std::sin(elevation)}));
            for (int i = 0; i < 3; ++i) image.at(x, y, i) = rgb[std::size_t(i)];
        }
    write_image(image, folder / "environment.exr");
    substitutions.add(
        fmt::format("the environment is an image of {} x {} pixels, +z up", width, height));
    return {{"image", "environment.exr"}, {"strength", 1.0}};
}

json meshes(const Scene& scene, const std::filesystem::path& folder, bool random_walk,
            Substitutions& substitutions) {
    CyclesMaterials materials(scene, folder, random_walk, substitutions);
    json list = json::array();
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
        Mesh mesh = peer_mesh(scene, i);
        json spec = {{"name", scene.shapes[i].name},
                     {"file", fmt::format("mesh_{:03}.bin", i)},
                     {"vertices", mesh.positions.size()},
                     {"triangles", mesh.triangles.size()},
                     {"normals", !mesh.normals.empty()}};
        materials.add_to(spec, i, mesh);
        spec["uvs"] = !mesh.uvs.empty();
        write_mesh_arrays(mesh, folder / spec["file"].get<std::string>());
        list.push_back(std::move(spec));
    }
    return list;
}

}  // namespace

nlohmann::json triple(const Vec3f& v) { return {v.x, v.y, v.z}; }

json cycles_scene(const PeerRequest& request, const std::string& output, bool random_walk,
                  Substitutions& substitutions) {
    const Scene& scene = request.scene;
    if (!scene.root)
        throw RunError("the scene does not know what it was built from, so no peer can render it");
    BuildContext context;
    context.search_path = scene.search_path;
    if (scene.mode == ColorMode::spectral)
        substitutions.add("wavelengths are the three bands of linear RGB");
    if (scene.camera_medium) substitutions.add("the medium around the camera is left out");
    if (scene.integrator.hide_emitters) substitutions.add("'hide_emitters' has no effect");
    if (scene.background) substitutions.add("the background is what lights the scene");
    const PeerView view = view_of(*scene.camera);
    return {{"film", film(scene, output, view.mirrored, substitutions)},
            {"camera", camera(view)},
            {"render",
             {{"samples", request.samples},
              {"seed", request.seed & 0x7fffffffu},
              {"threads", request.threads},
              {"max_bounces", max_bounces(scene, substitutions)}}},
            {"meshes", meshes(scene, request.folder, random_walk, substitutions)},
            {"lights", lights(scene)},
            {"environment", environment(scene, request.folder, context, substitutions)}};
}

}  // namespace nacre
