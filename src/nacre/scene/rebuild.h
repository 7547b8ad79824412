#pragma once
// A scene built again from its own tree, some nodes of which were changed: for who edits scenes.
#include <optional>

#include "nacre/scene/scene.h"
#include "nacre/scene/xml/scene_node.h"

namespace nacre {

/// Meshes of a scene, one a shape; null for shapes that are built from their parameters alone
/// (spheres, disks, cylinders).
using SceneMeshes = std::vector<std::shared_ptr<Mesh>>;

/// Copies of the meshes of a scene, as they stand in it: placed, with their normals.
SceneMeshes meshes_of(const Scene& scene);

/// The scene that `root` describes: the tree of `like` (Scene::root), in which materials, media,
/// lights, the places of analytic shapes, the camera may differ, but whose shapes are the same ones
/// in the same order. Meshes are not read again: they are `meshes`, which are shared and where they
/// stand already. What `like` has besides its tree (a background, an environment made in memory)
/// stays. `mode` unset: as build_scene chooses. Throws InputError as load_scene does.
Scene rebuild(const Scene& like, const SceneNodePtr& root, const SceneMeshes& meshes,
              std::optional<ColorMode> mode = {});

}  // namespace nacre
