#pragma once
// Scenes written by our own code: nodes as the reader would make them from a file.
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "nacre/scene/xml/scene_node.h"

namespace nacre {

using NodePtr = std::shared_ptr<SceneNode>;

inline NodePtr make_node(const char* tag, const char* type) {
    auto node = std::make_shared<SceneNode>();
    node->tag = tag;
    node->type = type;
    return node;
}

/// Gives `node` a parameter; `tag` is the element that it would have in a file.
template <class T>
void set(const NodePtr& node, const char* name, const char* tag, T value) {
    node->values.push_back({name, tag, std::move(value), {}});
}

inline void set_rgb(const NodePtr& node, const char* name, const Vec3f& rgb) {
    ColorValue color;
    color.rgb = rgb;
    set(node, name, "rgb", color);
}

inline void add(const NodePtr& parent, NodePtr child, const char* name = "") {
    parent->children.push_back({name, std::move(child), {}});
}

/// Unit vector `azimuth` degrees from +z towards +x and `elevation` degrees above the floor.
inline Vec3d direction(double azimuth, double elevation) {
    const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
    return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

/// A shining ball: unlike a panel it has no back, whose shadow would cut a floor in two. `white`
/// times `color` is the radiance that it alone gives to a white surface at that distance from its
/// middle, turned towards it.
inline NodePtr ball_light(const Vec3d& center, double radius, double distance, const Vec3f& color,
                          double white) {
    auto light = make_node("emitter", "area");
    // The irradiance is pi L (radius / distance)^2, and white shines with irradiance / pi.
    const double radiance = white * (distance / radius) * (distance / radius);
    set_rgb(light, "radiance", color * static_cast<float>(radiance));
    auto shape = make_node("shape", "sphere");
    set(shape, "center", "point", center);
    set(shape, "radius", "float", radius);
    add(shape, light);
    return shape;
}

}  // namespace nacre
