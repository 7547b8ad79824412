#include "nacre/scene/subsurface.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

constexpr SubsurfaceOption options[] = {
    {"exit_fresnel", "the transmittance at the exit, over its mean or as in the paper",
     "normalised paper"},
    {"single_scattering", "whether light scattered once is added", "auto on off"},
    {"spacing", "of surface points, in transport mean free paths", "", 0.01, 100.},
    {"error", "largest solid angle of points that count as one, sr", "", 0., 10.},
    {"irradiance_samples", "paths at each surface point", "", 1., 65536., true},
    {"points", "how they are spread", "elimination repulsion random"},
    {"free_path", "the object's mean free path that random walks keep", "transport diffuse"},
};

std::vector<std::string> words_of(const SubsurfaceOption& option) {
    std::istringstream in{std::string(option.words)};
    return {std::istream_iterator<std::string>(in), {}};
}

std::string* word_of(SubsurfaceSettings& s, std::string_view name) {
    return name == "exit_fresnel"        ? &s.exit
           : name == "single_scattering" ? &s.single_scattering
           : name == "free_path"         ? &s.free_path
                                         : &s.points;
}

void set_number(SubsurfaceSettings& s, std::string_view name, double value) {
    if (name == "spacing") s.spacing = value;
    if (name == "error") s.error = value;
    if (name == "irradiance_samples") s.irradiance_samples = static_cast<int>(value);
}

// The parameters that the medium inside is made of.
constexpr std::string_view medium_parameters[] = {"material", "sigma_s",       "sigma_a", "sigma_t",
                                                  "albedo",   "surface_color", "radius",  "scale"};

const Medium* add_medium_of(const SceneNode& node, Scene& scene, BuildContext& context) {
    auto medium = make_node("medium", "homogeneous");
    medium->location = node.location;
    for (const SceneValue& v : node.values)
        for (const std::string_view name : medium_parameters)
            if (v.name == name && node.has(name)) medium->values.push_back(v);
    for (const SceneNode::Child* phase : node.children_of("phase"))
        medium->children.push_back(*phase);
    if (medium->values.empty())
        node.fail("say what the object is made of: 'material', or 'sigma_s' and 'sigma_a'");
    const Medium* made = add_medium(*medium, scene, context);
    context.media.erase(medium.get());  // the key is about to go
    return made;
}

MaterialPtr boundary_of(const SceneNode& node, BuildContext& context) {
    auto boundary = make_node("bsdf", "dielectric");
    boundary->location = node.location;
    for (const SceneValue& v : node.values)
        if ((v.name == "int_ior" || v.name == "ext_ior") && node.has(v.name))
            boundary->values.push_back(v);
    if (!node.has("int_ior") && node.has("material"))
        set(boundary, "int_ior", "float", double{measured_medium(node.get_string("material")).eta});
    const MaterialPtr made = make_material(*boundary, context);
    context.materials.erase(boundary.get());
    return made;
}

}  // namespace

std::span<const SubsurfaceOption> subsurface_options() { return options; }

void set_option(SubsurfaceSettings& settings, std::string_view name, std::string_view text) {
    std::vector<std::string> known;
    for (const SubsurfaceOption& o : options) {
        known.emplace_back(o.name);
        if (o.name != name) continue;
        if (!o.words.empty()) {
            const std::vector<std::string> words = words_of(o);
            if (std::find(words.begin(), words.end(), text) == words.end())
                throw InputError(fmt::format("option '{}' has no value '{}'{}", name, text,
                                             suggestion(std::string(text), words)));
            *word_of(settings, name) = text;
            return;
        }
        double value = 0.;
        const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (wrong != std::errc() || end != text.data() + text.size() || !(value >= o.low) ||
            !(value <= o.high) || (o.whole && value != std::floor(value)))
            throw InputError(fmt::format("option '{}' = {} must be {} within [{:g}, {:g}]", name,
                                         text, o.whole ? "a whole number" : "a number", o.low,
                                         o.high));
        set_number(settings, name, value);
        return;
    }
    throw InputError(unknown_name("option", name, known));
}

void read_subsurface(const SceneNode& node, ShapeBinding& shape, bool has_material, Scene& scene,
                     BuildContext& context) {
    if (shape.interior) node.fail("a shape has either a <subsurface> or a medium inside, not both");
    auto settings = std::make_shared<SubsurfaceSettings>();
    settings->profile = node.type;
    settings->technique = node.get_string("method", settings->technique);
    if (node.location.file) settings->where = node.location.str();
    for (const SubsurfaceOption& o : options) {
        // Mitsuba 0.6 writes irrSamples.
        const bool other = o.name == "irradiance_samples" && node.has("irr_samples");
        const std::string_view name = other ? "irr_samples" : o.name;
        if (!node.has(name)) continue;
        const std::string text =
            o.words.empty() ? fmt::format("{}", node.get_float(name)) : node.get_string(name);
        try {
            set_option(*settings, o.name, text);
        } catch (const InputError& error) {
            node.fail_at(name, error.what());
        }
    }
    shape.interior = add_medium_of(node, scene, context);
    shape.separates_media = true;
    if (!has_material)
        shape.material = boundary_of(node, context);
    else
        for (const char* name : {"int_ior", "ext_ior"})
            if (node.has(name))
                node.fail_at(name, fmt::format("the shape's own <bsdf> says what its indices are; "
                                               "leave '{}' out",
                                               name));
    node.check_all_used();
    if (!is_translucent(shape))
        node.fail(
            "the shape's <bsdf> must be a dielectric without dispersion or tint, smooth "
            "or equally rough everywhere, or be left out");
    shape.subsurface = std::move(settings);
}

bool is_translucent(const ShapeBinding& shape) {
    return shape.interior && !shape.exterior && shape.interior->homogeneous() &&
           (boundary_eta(shape) != 1.f || shape.material->smooth_boundary_eta() > 0.f ||
            shape.material->flags() == has_null);
}

float boundary_eta(const ShapeBinding& shape) {
    const float eta =
        std::max(shape.material->smooth_boundary_eta(), shape.material->rough_boundary_eta());
    return eta > 0.f ? eta : 1.f;
}

void use_technique(Scene& scene, const std::function<void(SubsurfaceSettings&)>& change) {
    bool any = false;
    for (ShapeBinding& shape : scene.shapes) {
        if (!is_translucent(shape)) continue;
        auto settings = shape.subsurface ? *shape.subsurface : SubsurfaceSettings{};
        change(settings);
        shape.subsurface = std::make_shared<const SubsurfaceSettings>(std::move(settings));
        any = true;
    }
    if (!any) {
        SubsurfaceSettings asked;
        change(asked);
        throw InputError(fmt::format(
            "technique '{}' has nothing to do: no shape has a homogeneous medium inside behind a "
            "dielectric boundary, smooth or equally rough everywhere, without dispersion or tint",
            asked.technique));
    }
    scene.integrator.type = "path";
}

}  // namespace nacre
