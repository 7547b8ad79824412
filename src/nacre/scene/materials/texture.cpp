// The table of texture types, and parameters that are a number, a colour or a texture.
#include "nacre/scene/texture.h"

#include "nacre/scene/materials/texture_types.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

using Builder = TexturePtr (*)(const SceneNode&, ColorRole, BuildContext&);

struct TextureType {
    std::string_view name;
    Builder build;
};

constexpr TextureType types[] = {
    {"bitmap", make_bitmap},
    {"checkerboard", make_checkerboard},
};

std::vector<std::string> type_names() {
    std::vector<std::string> names;
    for (const TextureType& type : types) names.emplace_back(type.name);
    return names;
}

}  // namespace

TexturePtr make_texture(const SceneNode& node, ColorRole role, BuildContext& context) {
    const auto key = std::make_pair(&node, role);
    if (const auto known = context.textures.find(key); known != context.textures.end())
        return known->second;
    const auto type = std::find_if(std::begin(types), std::end(types),
                                   [&](const TextureType& t) { return t.name == node.type; });
    if (type == std::end(types)) node.fail(unknown_name("texture type", node.type, type_names()));
    TexturePtr texture = type->build(node, role, context);
    node.check_all_used();
    context.textures.emplace(key, texture);
    return texture;
}

TexturePtr get_texture(const SceneNode& node, std::string_view name, ColorRole role,
                       float otherwise, BuildContext& context) {
    if (const SceneNode::Child* child = node.child(name, "texture"))
        return make_texture(*child->node, role, context);
    const ColorValue* color = node.get_color(name);
    if (!color) return make_constant_texture(otherwise);
    if (color->kind == ColorValue::Kind::constant && role != ColorRole::illuminant)
        return make_constant_texture(color->value);
    return make_constant_texture(make_spectrum(*color, role));
}

}  // namespace nacre
