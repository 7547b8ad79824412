#pragma once
// Parameters of nodes that the viewer changes.
#include "nacre/scene/xml/scene_node.h"

namespace nacre::viewer {

/// Gives the node a parameter, instead of the one of that name that it may have.
template <class T>
void put(SceneNode& node, const char* name, const char* tag, T value) {
    std::erase_if(node.values, [&](const SceneValue& v) { return v.name == name; });
    node.values.push_back({name, tag, std::move(value), {}});
}

}  // namespace nacre::viewer
