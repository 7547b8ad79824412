#include "nacre/scene/gltf/shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "nacre/scene/gltf/material_nodes.h"
#include "nacre/scene/scene_builder.h"

namespace nacre {
namespace {

/// A primitive without a material has the format's default one: a rough white metal.
GltfMaterial default_material() {
    GltfMaterial m;
    m.name = "default";
    return m;
}

/// Without coordinates textures would show one texel, whichever.
void drop_textures(GltfMaterial& m) {
    bool any = false;
    for (const auto& t : m.textures()) {
        any |= t.texture->image >= 0;
        *t.texture = {};
    }
    if (any) m.left_out.emplace_back("textures (the mesh has no coordinates for them)");
}

void warn_about_left_out(const GltfObject& object, const std::vector<GltfMaterial>& materials,
                         const std::string& name, BuildContext& context) {
    std::vector<std::string> what = object.left_out;
    for (const GltfMaterial& m : materials)
        if (!m.left_out.empty())
            what.push_back(
                fmt::format("of material '{}': {}", m.name, fmt::join(m.left_out, ", ")));
    if (!what.empty())
        context.warnings.push_back(
            fmt::format("{}: the picture leaves out {}", name, fmt::join(what, "; ")));
}

bool has_own_materials(const SceneNode& shape) {
    for (const char* tag : {"bsdf", "medium", "subsurface", "emitter"})
        if (!shape.children_of(tag).empty()) return true;
    return false;
}

/// Length of the mapped unit: the cube root of the change of volume.
double scale_of(const Transform& to_world) {
    const Vec3d x = to_world.map_vector({1, 0, 0}), y = to_world.map_vector({0, 1, 0}),
                z = to_world.map_vector({0, 0, 1});
    return std::cbrt(std::abs(dot(cross(x, y), z)));
}

}  // namespace

std::vector<NodePtr> make_gltf_shapes(const GltfObject& object, const std::string& name,
                                      double unit, BuildContext& context) {
    std::vector<NodePtr> shapes;
    std::vector<GltfMaterial> materials;
    for (const GltfPart& part : object.parts) {
        materials.push_back(part.material < 0 ? default_material()
                                              : object.materials[std::size_t(part.material)]);
        GltfMaterial& m = materials.back();
        if (part.mesh->uvs.empty()) drop_textures(m);
        auto shape = make_node("shape", "gltf");
        shape->id = object.parts.size() == 1 ? name : fmt::format("{}: {}", name, m.name);
        add_gltf_material(shape, object, m, unit, context);
        context.meshes[shape.get()] = part.mesh;
        shapes.push_back(std::move(shape));
    }
    warn_about_left_out(object, materials, name, context);
    return shapes;
}

SceneNodePtr with_gltf_shapes(const SceneNodePtr& root, BuildContext& context) {
    std::vector<SceneNode::Child> children;
    bool changed = false;
    for (const SceneNode::Child& child : root->children) {
        const SceneNode& shape = *child.node;
        if (shape.tag != "shape" || shape.type != "gltf" || context.meshes.contains(&shape) ||
            has_own_materials(shape)) {
            children.push_back(child);
            continue;
        }
        const MeshOptions options = read_mesh_options(shape);
        const GltfObject object = load_gltf(find_mesh_file(shape, context), options);
        if (!object.has_materials()) {
            children.push_back(child);
            continue;
        }
        changed = true;
        for (const NodePtr& part : make_gltf_shapes(object, name_of_shape(shape),
                                                    1. / scale_of(options.to_world), context)) {
            part->location = shape.location;
            for (const SceneValue& v : shape.values)
                if (v.name != "filename" && v.name != "to_world" && v.name != "flip_tex_coords")
                    part->values.push_back(v);
            for (const SceneNode::Child& c : shape.children) part->children.push_back(c);
            // Known here, for suggestions to those who misspell them.
            for (const char* name : {"filename", "to_world", "flip_tex_coords"}) part->has(name);
            children.push_back({child.name, part, child.location});
        }
    }
    if (!changed) return root;
    auto tree = std::make_shared<SceneNode>(*root);
    tree->children = std::move(children);
    return tree;
}

}  // namespace nacre
