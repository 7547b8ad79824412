// nacre info: what is in a scene, mesh, image or measured file.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/measured_page.h"
#include "apps/cli/plain_json.h"
#include "apps/cli/verb.h"
#include "nacre/geometry/gltf_materials.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/measured/formats.h"
#include "nacre/render/noise.h"
#include "nacre/scene/load.h"
#include "nacre/techniques/missing_light.h"
#include "nacre/techniques/render_state.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

ordered_json point(const Point3f& p) { return {p.x, p.y, p.z}; }

/// Of a film's state: of which renders it is, and whether it is as it was written.
void add_film(const std::filesystem::path& file, ordered_json& json) {
    json["kind"] = "film state";
    if (json["metadata"].contains("nacre.key")) {  // by `compare`, which keeps its own book
        json["kind"] = "reference of compare";
        try {
            FilmState::load(file);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", file.string(), error.what()));
        }
        return;
    }
    const RenderState state = RenderState::load(file);
    std::uint32_t least = ~0u, most = 0;
    for (int y = 0; y < state.film.height(); ++y)
        for (int x = 0; x < state.film.width(); ++x) {
            least = std::min(least, state.film.drawn(x, y));
            most = std::max(most, state.film.drawn(x, y));
        }
    ordered_json film{{"complete", state.complete}, {"fewest_samples", least},
                      {"most_samples", most},       {"samples", state.samples},
                      {"seconds", state.seconds},   {"cpu_seconds", state.cpu_seconds}};
    if (const double noise = film_noise(state.film); std::isfinite(noise)) film["noise"] = noise;
    for (const RenderPart& p : state.parts)
        film["renders"].push_back(
            {{"seed", p.seed}, {"samples", p.samples}, {"window", {p.x, p.y, p.width, p.height}}});
    for (const auto& [name, value] : state.identity) film["of"][name] = value;
    json["film"] = film;
}

ordered_json describe_image(const std::filesystem::path& file) {
    // Asked what is in a file, one shows what is there, be it a picture or not.
    const Image image = read_image(file, {.any_channels = true});
    ordered_json channels = ordered_json::array();
    const std::size_t n = image.channels.size();
    for (std::size_t c = 0; c < n; ++c) {
        float low = std::numeric_limits<float>::infinity(), high = -low;
        double sum = 0;
        std::size_t finite = 0, pixels = image.data.size() / n;
        for (std::size_t i = c; i < image.data.size(); i += n) {
            if (!std::isfinite(image.data[i])) continue;
            low = std::min(low, image.data[i]);
            high = std::max(high, image.data[i]);
            sum += image.data[i];
            ++finite;
        }
        ordered_json channel{{"name", image.channels[c]}};
        if (finite) {
            channel["min"] = low;
            channel["mean"] = sum / static_cast<double>(finite);
            channel["max"] = high;
        }
        if (finite < pixels) channel["not_finite"] = pixels - finite;
        channels.push_back(channel);
    }
    ordered_json json{{"file", file.string()}, {"kind", "image"},
                      {"width", image.width},  {"height", image.height},
                      {"channels", channels},  {"metadata", image.metadata}};
    if (image.metadata.contains("nacre.film")) add_film(file, json);
    if (!image.layers.empty()) json["layers"] = image.layers;
    if (!image.data_window.empty()) json["data_window"] = image.data_window;
    return json;
}

/// What else a glTF says: its materials in its own words, and what of it pictures leave out.
void add_gltf(const std::filesystem::path& file, ordered_json& json) {
    const GltfObject object = load_gltf(file);
    ordered_json materials = ordered_json::array();
    for (const GltfMaterial& m : object.materials) {
        ordered_json material{{"name", m.name}, {"used", m.used}, {"properties", m.properties}};
        if (!m.left_out.empty()) material["left_out"] = m.left_out;
        materials.push_back(material);
    }
    if (!materials.empty()) json["materials"] = materials;
    if (!object.left_out.empty()) json["left_out"] = object.left_out;
    if (!object.extensions_used.empty()) json["extensions_used"] = object.extensions_used;
    if (!object.extensions_required.empty())
        json["extensions_required"] = object.extensions_required;
}

ordered_json describe_mesh(const std::filesystem::path& file) {
    const std::shared_ptr<Mesh> mesh = load_mesh(file);
    const MeshReport r = inspect(*mesh);
    const MeshPose pose = pose_of_file(file, *mesh);
    ordered_json json{{"file", file.string()},
                      {"kind", "mesh"},
                      {"vertices", r.vertices},
                      {"triangles", r.triangles},
                      {"components", r.components},
                      {"closed", r.closed()},
                      {"solid", r.solid()},
                      {"boundary_edges", r.boundary_edges},
                      {"non_manifold_edges", r.non_manifold_edges},
                      {"inconsistent_edges", r.inconsistent_edges},
                      {"degenerate_triangles", r.degenerate_triangles},
                      {"area", r.area},
                      {"bounds", {point(r.bounds.lower), point(r.bounds.upper)}},
                      {"up", name_of(pose.up)},
                      {"front", name_of(pose.front)}};
    if (r.closed()) json["volume"] = r.volume;
    if (const std::string text = warning(r, true); !text.empty()) json["warning"] = text;
    if (has_gltf_extension(file)) add_gltf(file, json);
    return json;
}

ordered_json describe_scene(const std::filesystem::path& file) {
    const Scene scene = load_scene(file);
    ordered_json shapes = ordered_json::array();
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        const ShapeBinding& s = scene.shapes[i];
        const Mesh* mesh = scene.rays.mesh(static_cast<std::uint32_t>(i));
        ordered_json shape{{"name", s.name}};
        if (mesh) shape["triangles"] = mesh->triangles.size();
        if (s.light) shape["light"] = true;
        if (s.interior) shape["interior_medium"] = true;
        shapes.push_back(shape);
    }
    const FilmSettings& f = scene.film;
    return {{"file", file.string()},
            {"kind", "scene"},
            {"mode", scene.mode == ColorMode::spectral ? "spectral" : "rgb"},
            {"film", {{"width", f.width}, {"height", f.height}, {"filter", f.filter.type}}},
            {"sampler", {{"type", scene.sampler.type}, {"samples", scene.sampler.samples}}},
            {"integrator", scene.integrator.type},
            {"mm_per_unit", scene.mm_per_unit},
            {"shapes", shapes},
            {"lights", scene.lights.size()},
            {"media", scene.media.size()},
            {"warnings", warnings_of(scene, plan_of(scene))}};
}

struct InfoArguments {
    std::string file;
    bool json = false;
};

int run(const InfoArguments& o) {
    const std::filesystem::path file = o.file;
    print_found(has_image_extension(file)      ? describe_image(file)
                : recognise_measured(file)     ? describe_measured(file)
                : file.extension() == ".xml"   ? describe_scene(file)
                : has_measured_extension(file) ? describe_measured(file)
                                               : describe_mesh(file),
                o.json);
    return success;
}

}  // namespace

Action set_up_info(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<InfoArguments>();
    app.add_option("file", o->file, "scene (.xml), mesh, image or measured reflectance")
        ->required();
    app.add_flag("--json", o->json, "for programs");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
