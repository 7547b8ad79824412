// glTF 2.0 (Khronos 2021): geometry of the default scene, in the scene's own frame.
#include <fmt/format.h>

#include "nacre/geometry/gltf_document.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// A file may reach any node once; a tree deeper than this is a loop or an attack on the stack.
constexpr int kDeepest = 256;

Transform local_transform(const MeshSource& source, const tinygltf::Node& node, std::size_t index) {
    try {
        if (node.matrix.size() == 16) {
            Transform::Matrix m;
            for (int row = 0; row < 4; ++row)
                for (int col = 0; col < 4; ++col) m[row * 4 + col] = node.matrix[col * 4 + row];
            return Transform(m);
        }
        Transform t;
        if (const auto& d = node.translation; d.size() == 3)
            t = t * Transform::translate({d[0], d[1], d[2]});
        if (const auto& q = node.rotation; q.size() == 4) {
            const double x = q[0], y = q[1], z = q[2], w = q[3];
            t = t * Transform(Transform::Matrix{1 - 2 * (y * y + z * z), 2 * (x * y - z * w),
                                                2 * (x * z + y * w), 0, 2 * (x * y + z * w),
                                                1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0,
                                                2 * (x * z - y * w), 2 * (y * z + x * w),
                                                1 - 2 * (x * x + y * y), 0, 0, 0, 0, 1});
        }
        if (const auto& s = node.scale; s.size() == 3) t = t * Transform::scale({s[0], s[1], s[2]});
        return t;
    } catch (const InputError& error) {
        source.fail(fmt::format("node {}: {}", index, error.what()));
    }
}

/// Where triangles of that material go.
int part_of(int material, std::size_t materials) {
    return material >= 0 && static_cast<std::size_t>(material) < materials ? material + 1 : 0;
}

class GltfBuilder {
  public:
    /// One mesh, or one for each entry of `uv_sets`: materials, the first of which is none.
    GltfBuilder(const MeshSource& source, const tinygltf::Model& model, std::vector<int> uv_sets)
        : source_(source),
          model_(model),
          reached_(model.nodes.size(), false),
          uv_sets_(std::move(uv_sets)),
          meshes_(uv_sets_.size()) {}

    std::vector<Mesh> build() {
        if (model_.nodes.empty()) {
            for (const auto& mesh : model_.meshes) add(mesh, Transform());
        } else if (!model_.scenes.empty()) {
            const auto& scene =
                entry(source_, model_.scenes, std::max(model_.defaultScene, 0), "scene");
            for (const int node : scene.nodes) visit(node, Transform(), 0);
        } else {
            std::vector<bool> child(model_.nodes.size(), false);
            for (const auto& node : model_.nodes)
                for (const int c : node.children)
                    if (c >= 0 && std::size_t(c) < child.size()) child[std::size_t(c)] = true;
            for (std::size_t i = 0; i < child.size(); ++i)
                if (!child[i]) visit(static_cast<int>(i), Transform(), 0);
        }
        // One primitive with normals is enough; the others' zeros are computed later.
        for (Mesh& mesh : meshes_) {
            if (!mesh.normals.empty()) mesh.normals.resize(mesh.positions.size());
            if (!mesh.uvs.empty()) mesh.uvs.resize(mesh.positions.size());
        }
        return std::move(meshes_);
    }

  private:
    void visit(int index, const Transform& parent, int depth) {
        const auto& node = entry(source_, model_.nodes, index, "node");
        if (reached_[static_cast<std::size_t>(index)] || depth > kDeepest)
            source_.fail(
                fmt::format("node {} is its own ancestor or a child twice; glTF nodes form "
                            "a tree",
                            index));
        reached_[static_cast<std::size_t>(index)] = true;
        if (node.extensions.contains("EXT_mesh_gpu_instancing"))
            source_.fail(
                fmt::format("node {} is placed many times by EXT_mesh_gpu_instancing, which is not "
                            "read; export every copy as a node of its own",
                            index));
        const Transform to_world =
            parent * local_transform(source_, node, static_cast<std::size_t>(index));
        if (node.mesh >= 0) add(entry(source_, model_.meshes, node.mesh, "mesh"), to_world);
        for (const int child : node.children) visit(child, to_world, depth + 1);
    }

    void add(const tinygltf::Mesh& mesh, const Transform& to_world) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const int mode = primitive.mode == -1 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
            if (mode >= TINYGLTF_MODE_TRIANGLES && mode <= TINYGLTF_MODE_TRIANGLE_FAN)
                add(primitive, mode, to_world);
        }
    }

    const int* attribute(const tinygltf::Primitive& primitive, const char* name) const {
        const auto found = primitive.attributes.find(name);
        return found == primitive.attributes.end() ? nullptr : &found->second;
    }

    void add(const tinygltf::Primitive& primitive, int mode, const Transform& to_world) {
        const int* position = attribute(primitive, "POSITION");
        if (!position) source_.fail("has a primitive without POSITION; export it with positions");
        const GltfElements positions(source_, model_, *position, 3, "POSITION");
        const std::size_t part =
            meshes_.size() > 1
                ? static_cast<std::size_t>(part_of(primitive.material, model_.materials.size()))
                : 0;
        Mesh& mesh = meshes_[part];
        const std::size_t first = mesh.positions.size(), count = positions.count();
        if (first + count > 0xffffffffu)
            source_.fail("has more than 2^32 vertices; split it into several files");
        for (std::size_t i = 0; i < count; ++i)
            mesh.positions.emplace_back(to_world.map_point(positions.vector(i)));
        if (const int* normal = attribute(primitive, "NORMAL")) {
            const GltfElements normals(source_, model_, *normal, 3, "NORMAL");
            match("NORMAL", normals.count(), count);
            mesh.normals.resize(first);
            for (std::size_t i = 0; i < count; ++i)
                mesh.normals.emplace_back(to_world.map_normal(normals.vector(i)));
        }
        const std::string set = fmt::format("TEXCOORD_{}", uv_sets_[part]);
        if (const int* uv = attribute(primitive, set.c_str())) {
            const GltfElements uvs(source_, model_, *uv, 2, set.c_str());
            match(set.c_str(), uvs.count(), count);
            mesh.uvs.resize(first);
            for (std::size_t i = 0; i < count; ++i)
                mesh.uvs.push_back({float(uvs.value(i, 0)), float(uvs.value(i, 1))});
        }
        const std::vector<std::uint32_t> corners = corners_of(primitive, first, count);
        const std::size_t before = mesh.triangles.size();
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            add_strip(mesh, corners);
        } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            add_polygon(mesh, corners);
        } else {
            if (corners.size() % 3 != 0)
                source_.fail(
                    fmt::format("has a primitive of {} corners, which is not a multiple of "
                                "three; export it again",
                                corners.size()));
            for (std::size_t i = 0; i < corners.size(); i += 3)
                mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        }
        if (to_world.swaps_handedness())
            for (std::size_t i = before; i < mesh.triangles.size(); ++i)
                std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    }

    void match(const char* what, std::size_t got, std::size_t want) const {
        if (got != want)
            source_.fail(fmt::format("has {} values of {} for {} positions; export it again", got,
                                     what, want));
    }

    std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, std::size_t first,
                                          std::size_t count) const {
        std::vector<std::uint32_t> corners;
        if (primitive.indices < 0) {
            corners.resize(count);
            for (std::size_t i = 0; i < count; ++i)
                corners[i] = static_cast<std::uint32_t>(first + i);
            return corners;
        }
        const GltfElements indices(source_, model_, primitive.indices, 1, "indices");
        corners.reserve(indices.count());
        for (std::size_t i = 0; i < indices.count(); ++i) {
            const double index = indices.value(i, 0);
            if (!(index >= 0 && index < double(count)))
                source_.fail(
                    fmt::format("corner {} of a primitive names vertex {}, but it has {} "
                                "vertices (counted from 0)",
                                i, index, count));
            corners.push_back(static_cast<std::uint32_t>(first + std::size_t(index)));
        }
        return corners;
    }

    const MeshSource& source_;
    const tinygltf::Model& model_;
    std::vector<bool> reached_;
    std::vector<int> uv_sets_;
    std::vector<Mesh> meshes_;
};

}  // namespace

Mesh read_gltf(const MeshSource& source) {
    const tinygltf::Model model = parse_gltf(source);
    return std::move(GltfBuilder(source, model, {0}).build().front());
}

std::vector<Mesh> read_gltf_parts(const MeshSource& source, const tinygltf::Model& model,
                                  const std::vector<int>& uv_sets) {
    return GltfBuilder(source, model, uv_sets).build();
}

}  // namespace nacre
