// The table of material types, and what their builders share.
#include "nacre/scene/material.h"

#include "nacre/reflectance/registry.h"
#include "nacre/scene/materials/types.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

using Builder = MaterialPtr (*)(const SceneNode&, BuildContext&);

struct MaterialType {
    std::string_view name;
    Builder build;
};

constexpr MaterialType types[] = {
    {"blendbsdf", make_blendbsdf},
    {"conductor", make_conductor},
    {"dielectric", make_dielectric},
    {"difftrans", make_difftrans},
    {"diffuse", make_diffuse},
    {"hk", make_hk},
    {"mask", make_mask},
    {"measured", make_measured},
    {"null", make_null},
    {"plastic", make_plastic},
    {"roughconductor", make_roughconductor},
    {"roughdielectric", make_roughdielectric},
    {"roughplastic", make_roughplastic},
    {"sumbsdf", make_sumbsdf},
    {"thindielectric", make_thindielectric},
    {"twosided", make_twosided},
};

std::vector<std::string> type_names() {
    std::vector<std::string> names;
    for (const MaterialType& type : types) names.emplace_back(type.name);
    for (const ModelDescription* model : models()) names.emplace_back(model->name);
    return names;
}

/// The first value of a colour as written that is not within [0, 1]; empty if all are.
std::optional<float> value_outside_unit(const ColorValue& color) {
    const auto outside = [](float v) { return !(v >= 0.f && v <= 1.f); };
    switch (color.kind) {
        case ColorValue::Kind::rgb:
            for (int i = 0; i < 3; ++i)
                if (outside(color.rgb[i])) return color.rgb[i];
            return std::nullopt;
        case ColorValue::Kind::constant:
            if (outside(color.value)) return color.value;
            return std::nullopt;
        case ColorValue::Kind::tabulated:
            for (float v : color.values)
                if (outside(v)) return v;
            return std::nullopt;
        case ColorValue::Kind::blackbody:
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

TexturePtr get_reflectance(const SceneNode& node, std::string_view name, float otherwise,
                           BuildContext& context) {
    const auto refuse = [&](float value) {
        node.fail_at(name, fmt::format("'{}' of {} must lie within [0, 1], lest energy appear from "
                                       "nowhere; got {}",
                                       name, node.describe(), value));
    };
    if (!node.child(name, "texture"))
        if (const ColorValue* color = node.get_color(name))
            if (const auto value = value_outside_unit(*color)) refuse(*value);
    TexturePtr texture = get_texture(node, name, ColorRole::reflectance, otherwise, context);
    // Bounds of uplifted colours may exceed one by rounding.
    if (!(texture->max() <= 1.f + 1e-5f)) refuse(texture->max());
    return texture;
}

std::vector<MaterialPtr> nested_materials(const SceneNode& node, std::size_t least,
                                          std::size_t most, BuildContext& context) {
    const auto children = node.children_of("bsdf");
    if (children.size() < least || children.size() > most)
        node.fail(
            fmt::format("{} takes {} nested <bsdf>, but {} given", node.describe(),
                        least == most       ? std::to_string(least)
                        : most == least + 1 ? fmt::format("{} or {}", least, most)
                                            : fmt::format("{} to {}", least, most),
                        children.size() == 1 ? "1 is" : fmt::format("{} are", children.size())));
    std::vector<MaterialPtr> materials;
    for (const SceneNode::Child* child : children)
        materials.push_back(make_material(*child->node, context));
    return materials;
}

std::vector<std::string> material_types() { return type_names(); }

MaterialPtr make_material(const SceneNode& node, BuildContext& context) {
    if (const auto known = context.materials.find(&node); known != context.materials.end())
        return known->second;
    const auto type = std::find_if(std::begin(types), std::end(types),
                                   [&](const MaterialType& t) { return t.name == node.type; });
    const bool is_model =
        std::any_of(models().begin(), models().end(),
                    [&](const ModelDescription* model) { return model->name == node.type; });
    if (type == std::end(types) && !is_model)
        node.fail(unknown_name("bsdf type", node.type, type_names()));
    MaterialPtr material =
        is_model ? make_reflectance_model(node, context) : type->build(node, context);
    node.check_all_used();
    context.materials.emplace(&node, material);
    return material;
}

}  // namespace nacre
