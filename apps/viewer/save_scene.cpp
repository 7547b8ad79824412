#include "apps/viewer/save_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "apps/viewer/put_value.h"
#include "nacre/math/error.h"
#include "nacre/peers/mesh.h"
#include "nacre/peers/xml_values.h"
#include "nacre/scene/subsurface.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/whole_file.h"

namespace nacre::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view file_types[] = {"obj", "ply", "off", "stl", "gltf", "serialized"};

bool is_mesh_file(const SceneNode& shape) {
    return std::ranges::find(file_types, shape.type) != std::end(file_types);
}

class SceneWriter {
  public:
    SceneWriter(const ViewerScene& scene, const ViewerState& state, fs::path file)
        : scene_(scene), state_(state), file_(std::move(file)) {
        saved_.files.push_back(file_);
    }

    SavedScene write(int width, int height) {
        if (scene_.scene.environment &&
            std::ranges::none_of(scene_.scene.root->children, [](const SceneNode::Child& c) {
                return c.node->type == "constant" || c.node->type == "envmap";
            }))
            throw InputError(
                "the surroundings of the built-in scene are in no file, so that it "
                "cannot be saved");
        SceneParts parts = scene_.parts_of(state_);
        if (state_.deformation.kind != Deformation::Kind::none) {
            int left_out = 0;
            meshes_ = deformed(scene_.scene, parts.meshes, state_.deformation, &left_out);
            if (left_out > 0)
                saved_.left_out.push_back("spheres, disks and cylinders are as they are at rest");
        } else {
            meshes_ = parts.meshes;
        }
        if (scene_.scene.background)
            saved_.left_out.push_back("the background behind the scene (--background)");
        if (scene_.mode) saved_.left_out.push_back("the colour mode (--mode)");
        const TechniqueDescription& technique = techniques().find(state_.technique.technique);
        pugi::xml_document document;
        pugi::xml_node root = document.append_child("scene");
        root.append_attribute("version") = "3.0.0";
        for (const SceneValue& v : parts.root->values) append_value(root, v);
        write_integrator(root, *parts.root, technique.simulates);
        write_node(*with_film(*state_.camera.sensor(), width, height), root, "");
        std::size_t shape = 0;
        for (const SceneNode::Child& child : parts.root->children) {
            const SceneNode& node = *child.node;
            if (node.tag == "shape")
                write_shape(node, shape++, technique, root);
            else if (node.tag == "emitter")
                write_node(node, root, "");
            // What else stands there is referred to, and written where it is used.
        }
        std::ostringstream text;
        document.save(text, "    ", pugi::format_default | pugi::format_no_declaration);
        write_whole_file(file_, text.str());
        return std::move(saved_);
    }

  private:
    static void write_integrator(pugi::xml_node root, const SceneNode& tree, bool simulates) {
        pugi::xml_node element = append_object(root, "integrator", simulates ? "volpath" : "path");
        for (const SceneNode::Child& child : tree.children) {
            if (child.node->tag != "integrator") continue;
            for (const SceneValue& v : child.node->values)
                if (v.name == "max_depth" || v.name == "rr_depth" || v.name == "hide_emitters")
                    append_value(element, v);
        }
    }

    static SceneNodePtr with_film(const SceneNode& sensor, int width, int height) {
        auto node = std::make_shared<SceneNode>(sensor);
        NodePtr film = make_node("film", "hdrfilm");
        for (SceneNode::Child& child : node->children)
            if (child.node->tag == "film") film = std::make_shared<SceneNode>(*child.node);
        std::erase_if(node->children,
                      [](const SceneNode::Child& c) { return c.node->tag == "film"; });
        std::erase_if(film->values,
                      [](const SceneValue& v) { return v.name.starts_with("crop_"); });
        put(*film, "width", "integer", std::int64_t{width});
        put(*film, "height", "integer", std::int64_t{height});
        add(node, film);
        return node;
    }

    void write_shape(const SceneNode& node, std::size_t index,
                     const TechniqueDescription& technique, pugi::xml_node root) {
        SceneNode shape = node;
        const bool translucent = is_translucent(scene_.scene.shapes[index]);
        if (translucent && !technique.simulates) take_technique(shape, technique);
        const bool is_file = is_mesh_file(node);
        const bool bent = translucent && state_.deformation.kind != Deformation::Kind::none;
        if (meshes_[index] && (bent || (is_file && !node.has("filename")))) {
            fs::path mesh = file_;
            mesh.replace_filename(
                fmt::format("{}_{}.ply", file_.stem().string(), saved_.files.size()));
            write_ply(*meshes_[index], mesh);
            saved_.files.push_back(mesh);
            // In place and with its normals: what made them so is left out.
            std::erase_if(shape.values, [](const SceneValue& v) {
                return v.name != "face_normals" && v.name != "flip_normals";
            });
            shape.type = "ply";
            put(shape, "filename", "string", mesh.filename().string());
        }
        write_node(shape, root, "");
    }

    /// Matter inside becomes a <subsurface> by the technique.
    void take_technique(SceneNode& shape, const TechniqueDescription& technique) {
        auto subsurface = make_node("subsurface", "dipole");
        for (const SceneNode::Child& child : shape.children) {
            if (child.name != "interior" && child.node->tag != "subsurface") continue;
            if (child.node->tag == "medium" && child.node->type != "homogeneous")
                throw InputError(fmt::format(
                    "a medium of type '{}' renders by 'volpath' alone where a scene file says it: "
                    "choose that technique, or another material, and save again",
                    child.node->type));
            *subsurface = *child.node;
        }
        subsurface->tag = "subsurface";
        subsurface->id.clear();
        if (subsurface->type == "homogeneous") subsurface->type = "dipole";
        std::erase_if(subsurface->values, [&](const SceneValue& v) {
            const auto known = subsurface_parameters();
            return v.name == "method" || std::ranges::find(known, v.name) == known.end();
        });
        put(*subsurface, "method", "string", std::string(technique.name));
        for (const auto& [name, value] : state_.technique.options)
            if (name == "profile")
                subsurface->type = value;
            else
                put(*subsurface, name.c_str(), "string", value);
        std::erase_if(shape.children, [](const SceneNode::Child& c) {
            return c.name == "interior" || c.node->tag == "subsurface";
        });
        shape.children.push_back({"", subsurface, {}});
    }

    /// A node with all that is in it; files by their full path, what is shared once a use.
    void write_node(const SceneNode& node, pugi::xml_node parent, std::string_view name) {
        pugi::xml_node element = append_object(parent, node.tag, node.type, name);
        if (node.tag == "shape" && !node.id.empty())
            element.append_attribute("id") = node.id.c_str();
        if (node.tag == "texture" && node.type == "bitmap" && !node.has("filename"))
            throw InputError(
                "a picture of the glTF is in no file of its own, so that the scene "
                "cannot be saved");
        for (const SceneValue& v : node.values) {
            const auto* word = std::get_if<std::string>(&v.value);
            if (word && v.name == "filename")
                append_value(element, "string", v.name, full_path(*word));
            else
                append_value(element, v);
        }
        for (const SceneNode::Child& child : node.children)
            write_node(*child.node, element, child.name);
    }

    std::string full_path(const std::string& name) const {
        for (const fs::path& folder : scene_.scene.search_path)
            if (std::error_code error; fs::exists(folder / name, error))
                return fs::absolute(folder / name).lexically_normal().string();
        return name;
    }

    const ViewerScene& scene_;
    const ViewerState& state_;
    fs::path file_;
    SceneMeshes meshes_;
    SavedScene saved_;
};

}  // namespace

SavedScene save_scene(const ViewerScene& scene, const ViewerState& state, int width, int height,
                      const std::filesystem::path& file) {
    return SceneWriter(scene, state, file).write(width, height);
}

}  // namespace nacre::viewer
