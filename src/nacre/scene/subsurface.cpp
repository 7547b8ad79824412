#include "nacre/scene/subsurface.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

constexpr std::string_view parameters[] = {"material", "sigma_s",       "sigma_a", "sigma_t",
                                           "albedo",   "surface_color", "radius",  "scale",
                                           "int_ior",  "ext_ior",       "method"};
// Those that the medium inside is made of.
constexpr auto medium_parameters = std::span(parameters).first(8);

/// A technique's option as text: a number or a word.
std::string text_of(const SceneNode& node, const SceneValue& v) {
    if (const auto* word = std::get_if<std::string>(&v.value)) {
        node.has(v.name);
        return *word;
    }
    return fmt::format("{}", node.get_float(v.name));
}

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
    context.made.push_back(medium);
    return add_medium(*medium, scene, context);
}

MaterialPtr boundary_of(const SceneNode& node, BuildContext& context) {
    auto boundary = make_node("bsdf", "dielectric");
    boundary->location = node.location;
    for (const SceneValue& v : node.values)
        if ((v.name == "int_ior" || v.name == "ext_ior") && node.has(v.name))
            boundary->values.push_back(v);
    if (!node.has("int_ior") && node.has("material"))
        set(boundary, "int_ior", "float",
            double{measured_media().find(node.get_string("material")).eta});
    context.made.push_back(boundary);
    return make_material(*boundary, context);
}

}  // namespace

std::span<const std::string_view> subsurface_parameters() { return parameters; }

void read_subsurface(const SceneNode& node, ShapeBinding& shape, bool has_material, Scene& scene,
                     BuildContext& context) {
    if (shape.interior) node.fail("a shape has either a <subsurface> or a medium inside, not both");
    auto settings = std::make_shared<SubsurfaceSettings>();
    settings->profile = node.type;
    settings->technique = node.get_string("method", settings->technique);
    if (node.location.file) settings->where = node.location.str();
    // What is left is for the techniques to understand.
    for (const SceneValue& v : node.values)
        if (std::ranges::find(parameters, v.name) == std::end(parameters))
            settings->options.push_back(
                {v.name, text_of(node, v), settings->where.empty() ? "" : v.location.str()});
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
    return holds_translucent_medium(shape) && shape.interior->homogeneous();
}

bool holds_translucent_medium(const ShapeBinding& shape) {
    return shape.interior && !shape.exterior &&
           (boundary_eta(shape) != 1.f || shape.material->smooth_boundary_eta() > 0.f ||
            shape.material->flags() == has_null);
}

float boundary_eta(const ShapeBinding& shape) {
    const float eta =
        std::max(shape.material->smooth_boundary_eta(), shape.material->rough_boundary_eta());
    return eta > 0.f ? eta : 1.f;
}

}  // namespace nacre
