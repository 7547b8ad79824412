#pragma once
// Scenes written by our own code: nodes as the reader would make them from a file.
#include <memory>
#include <utility>

#include "nacre/scene/scene_node.h"

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

}  // namespace nacre
