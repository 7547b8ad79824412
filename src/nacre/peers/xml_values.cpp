#include "nacre/peers/xml_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre {
namespace {

void append_color(pugi::xml_node parent, std::string_view name, const std::string& tag,
                  const ColorValue& color) {
    switch (color.kind) {
        case ColorValue::Kind::rgb:
            append_rgb(parent, name, color.rgb);
            break;
        case ColorValue::Kind::constant:
            append_value(parent, tag == "float" ? "float" : "spectrum", name,
                         fmt::format("{}", color.value));
            break;
        case ColorValue::Kind::tabulated: {
            std::string text;
            for (std::size_t i = 0; i < color.nm.size(); ++i)
                text += fmt::format("{}{}:{}", i ? ", " : "", color.nm[i], color.values[i]);
            append_value(parent, "spectrum", name, text);
            break;
        }
        case ColorValue::Kind::blackbody: {
            pugi::xml_node element = append_object(parent, "spectrum", "blackbody", name);
            append_value(element, "float", "temperature", fmt::format("{}", color.kelvin));
            append_value(element, "float", "scale", fmt::format("{}", color.value));
            break;
        }
    }
}

}  // namespace

pugi::xml_node append_object(pugi::xml_node parent, std::string_view tag, std::string_view type,
                             std::string_view name) {
    pugi::xml_node element = parent.append_child(std::string(tag).c_str());
    element.append_attribute("type") = std::string(type).c_str();
    if (!name.empty()) element.append_attribute("name") = std::string(name).c_str();
    return element;
}

void append_value(pugi::xml_node parent, const char* tag, std::string_view name,
                  const std::string& value) {
    pugi::xml_node element = parent.append_child(tag);
    element.append_attribute("name") = std::string(name).c_str();
    element.append_attribute("value") = value.c_str();
}

void append_rgb(pugi::xml_node parent, std::string_view name, const Vec3f& rgb) {
    append_value(parent, "rgb", name, fmt::format("{}, {}, {}", rgb.x, rgb.y, rgb.z));
}

void append_transform(pugi::xml_node parent, std::string_view name, const Transform& transform) {
    pugi::xml_node element = parent.append_child("transform");
    element.append_attribute("name") = std::string(name).c_str();
    element.append_child("matrix").append_attribute("value") =
        fmt::format("{}", fmt::join(transform.matrix(), " ")).c_str();
}

void append_value(pugi::xml_node parent, const SceneValue& value) {
    const char* tag = value.tag.c_str();
    if (const auto* number = std::get_if<double>(&value.value))
        append_value(parent, "float", value.name, fmt::format("{}", *number));
    else if (const auto* whole = std::get_if<std::int64_t>(&value.value))
        append_value(parent, "integer", value.name, fmt::format("{}", *whole));
    else if (const auto* truth = std::get_if<bool>(&value.value))
        append_value(parent, "boolean", value.name, *truth ? "true" : "false");
    else if (const auto* text = std::get_if<std::string>(&value.value))
        append_value(parent, "string", value.name, *text);
    else if (const auto* v = std::get_if<Vec3d>(&value.value))
        append_value(parent, tag, value.name, fmt::format("{}, {}, {}", v->x, v->y, v->z));
    else if (const auto* transform = std::get_if<Transform>(&value.value))
        append_transform(parent, value.name, *transform);
    else
        append_color(parent, value.name, value.tag, std::get<ColorValue>(value.value));
}

}  // namespace nacre
