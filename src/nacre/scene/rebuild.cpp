#include "nacre/scene/rebuild.h"

#include "nacre/scene/scene_builder.h"

namespace nacre {
namespace {

/// The shape without what was heeded when its mesh was read: where it stands, its file, its edges.
SceneNodePtr in_memory(const SceneNode& shape) {
    auto node = std::make_shared<SceneNode>(shape);
    std::erase_if(node->values, [](const SceneValue& v) {
        return v.name != "face_normals" && v.name != "flip_normals";
    });
    // Of the types of files, this one reads what its caller has.
    node->type = "obj";
    if (node->id.empty()) node->id = name_of_shape(shape);
    return node;
}

/// Materials and media whose nodes are those of the old scene are taken from there: what they hold
/// may have been in memory only (pictures of a glTF).
void take_over(const Scene& like, BuildContext& context) {
    std::size_t i = 0;
    for (const SceneNode::Child* shape : like.root->children_of("shape")) {
        const ShapeBinding& binding = like.shapes[i++];
        const auto bsdfs = shape->node->children_of("bsdf");
        if (bsdfs.size() == 1) context.materials[bsdfs[0]->node.get()] = binding.material;
        const SceneNode::Child* inside = shape->node->child("interior", "medium");
        for (const MediumPtr& medium : like.media)
            if (inside && medium.get() == binding.interior)
                context.media[inside->node.get()] = medium;
    }
}

}  // namespace

SceneMeshes meshes_of(const Scene& scene) {
    SceneMeshes meshes;
    for (std::uint32_t i = 0; i < scene.rays.shape_count(); ++i) {
        const Mesh* mesh = scene.rays.mesh(i);
        if (!mesh) {
            meshes.push_back(nullptr);
            continue;
        }
        auto copy = std::make_shared<Mesh>();
        copy->name = mesh->name;
        copy->positions.reserve(mesh->positions.size() + 1);  // for Embree
        copy->positions.assign(mesh->positions.begin(), mesh->positions.end());
        copy->normals = mesh->normals;
        copy->uvs = mesh->uvs;
        copy->triangles = mesh->triangles;
        meshes.push_back(std::move(copy));
    }
    return meshes;
}

Scene rebuild(const Scene& like, const SceneNodePtr& root, const SceneMeshes& meshes,
              std::optional<ColorMode> mode) {
    BuildContext context;
    context.search_path = like.search_path;
    context.film_width = like.film.width;
    context.film_height = like.film.height;
    take_over(like, context);
    auto tree = std::make_shared<SceneNode>(*root);
    std::size_t shape = 0;
    for (SceneNode::Child& child : tree->children) {
        if (child.node->tag != "shape") continue;
        if (const auto& mesh = meshes.at(shape++)) {
            child.node = in_memory(*child.node);
            context.meshes[child.node.get()] = mesh;
        }
    }
    Scene scene = build_scene(tree, context, mode);
    scene.root = root;
    scene.background = like.background;
    if (like.environment && !scene.environment) {
        for (const LightPtr& light : like.lights)
            if (light.get() == like.environment) scene.lights.push_back(light);
        scene.environment = like.environment;
    }
    return scene;
}

}  // namespace nacre
