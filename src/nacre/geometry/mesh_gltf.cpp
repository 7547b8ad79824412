// glTF 2.0 (Khronos 2021) through tinygltf: geometry of the default scene, in the scene's own
// frame. Every offset is checked here: tinygltf hands over what the file says.
#include <fmt/format.h>

// Only the interface: the implementation, with its image decoders, stays in the library.
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cstring>

#include "nacre/geometry/mesh_source.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// A file may reach any node once; a tree deeper than this is a loop or an attack on the stack.
constexpr int kDeepest = 256;

template <class T>
const T& entry(const MeshSource& source, const std::vector<T>& list, int index, const char* what) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        source.fail(fmt::format("names {} {}, but there are {}", what, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

// Elements of an accessor as numbers.
class Elements {
  public:
    Elements(const MeshSource& source, const tinygltf::Model& model, int accessor, int width,
             const char* what)
        : width_(width) {
        const auto& a = entry(source, model.accessors, accessor, "accessor");
        if (a.sparse.isSparse)
            source.fail(
                fmt::format("accessor {} ({}) is sparse, which is not read; export without "
                            "sparse accessors",
                            accessor, what));
        const auto& view = entry(source, model.bufferViews, a.bufferView, "bufferView");
        const auto& buffer = entry(source, model.buffers, view.buffer, "buffer");
        const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
        const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
        if (components != width || size <= 0)
            source.fail(fmt::format("accessor {} ({}) has {} components of {} bytes; it needs {}",
                                    accessor, what, components, size, width));
        type_ = a.componentType;
        normalized_ = a.normalized;
        size_ = static_cast<std::size_t>(size);
        count_ = a.count;
        const std::size_t element = size_ * static_cast<std::size_t>(width);
        stride_ = view.byteStride ? view.byteStride : element;
        // Written so that no sum can overflow.
        const std::size_t have = buffer.data.size();
        const bool inside = view.byteOffset <= have && view.byteLength <= have - view.byteOffset &&
                            a.byteOffset <= view.byteLength;
        const std::size_t room = inside ? view.byteLength - a.byteOffset : 0;
        if (count_ > 0 && (room < element || stride_ == 0 || stride_ > 252 + element ||
                           (count_ - 1) > (room - element) / stride_))
            source.fail(
                fmt::format("accessor {} ({}) wants {} elements of {} bytes, but its buffer "
                            "view holds {} bytes of a buffer of {}; export it again",
                            accessor, what, count_, element, room, have));
        data_ = buffer.data.data() + (inside ? view.byteOffset + a.byteOffset : 0);
    }

    std::size_t count() const { return count_; }

    double value(std::size_t i, int component) const {
        const unsigned char* at = data_ + i * stride_ + static_cast<std::size_t>(component) * size_;
        switch (type_) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return scaled<std::int8_t>(at, 127);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return scaled<std::uint8_t>(at, 255);
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return scaled<std::int16_t>(at, 32767);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return scaled<std::uint16_t>(at, 65535);
            case TINYGLTF_COMPONENT_TYPE_INT:
                return scaled<std::int32_t>(at, 1);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return scaled<std::uint32_t>(at, 1);
            case TINYGLTF_COMPONENT_TYPE_DOUBLE:
                return scaled<double>(at, 1);
            default:
                return scaled<float>(at, 1);
        }
    }
    Vec3d vector(std::size_t i) const { return {value(i, 0), value(i, 1), value(i, 2)}; }

  private:
    template <class T>
    double scaled(const unsigned char* at, double one) const {
        T v;
        std::memcpy(&v, at, sizeof v);
        return normalized_ ? std::max(double(v) / one, -1.0) : double(v);
    }

    int width_, type_ = 0;
    bool normalized_ = false;
    std::size_t size_ = 0, stride_ = 0, count_ = 0;
    const unsigned char* data_ = nullptr;
};

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

class GltfBuilder {
  public:
    GltfBuilder(const MeshSource& source, const tinygltf::Model& model)
        : source_(source), model_(model), reached_(model.nodes.size(), false) {}

    Mesh build() {
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
        if (any_normals_) mesh_.normals.resize(mesh_.positions.size());
        if (any_uvs_) mesh_.uvs.resize(mesh_.positions.size());
        return std::move(mesh_);
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
        const Elements positions(source_, model_, *position, 3, "POSITION");
        const std::size_t first = mesh_.positions.size(), count = positions.count();
        if (first + count > 0xffffffffu)
            source_.fail("has more than 2^32 vertices; split it into several files");
        for (std::size_t i = 0; i < count; ++i)
            mesh_.positions.emplace_back(to_world.map_point(positions.vector(i)));
        if (const int* normal = attribute(primitive, "NORMAL")) {
            const Elements normals(source_, model_, *normal, 3, "NORMAL");
            match("NORMAL", normals.count(), count);
            any_normals_ = true;
            mesh_.normals.resize(first);
            for (std::size_t i = 0; i < count; ++i)
                mesh_.normals.emplace_back(to_world.map_normal(normals.vector(i)));
        }
        if (const int* uv = attribute(primitive, "TEXCOORD_0")) {
            const Elements uvs(source_, model_, *uv, 2, "TEXCOORD_0");
            match("TEXCOORD_0", uvs.count(), count);
            any_uvs_ = true;
            mesh_.uvs.resize(first);
            for (std::size_t i = 0; i < count; ++i)
                mesh_.uvs.push_back({float(uvs.value(i, 0)), float(uvs.value(i, 1))});
        }
        const std::vector<std::uint32_t> corners = corners_of(primitive, first, count);
        const std::size_t before = mesh_.triangles.size();
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            add_strip(mesh_, corners);
        } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            add_fan(mesh_, corners);
        } else {
            if (corners.size() % 3 != 0)
                source_.fail(
                    fmt::format("has a primitive of {} corners, which is not a multiple of "
                                "three; export it again",
                                corners.size()));
            for (std::size_t i = 0; i < corners.size(); i += 3)
                mesh_.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        }
        if (to_world.swaps_handedness())
            for (std::size_t i = before; i < mesh_.triangles.size(); ++i)
                std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
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
        const Elements indices(source_, model_, primitive.indices, 1, "indices");
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
    bool any_normals_ = false, any_uvs_ = false;
    Mesh mesh_;
};

bool is_image(std::string name) {
    for (char& c : name) c = static_cast<char>(c | 0x20);
    for (const char* ending : {".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".basis"})
        if (name.ends_with(ending)) return true;
    return false;
}

// Files beside the .gltf: buffers are read, pictures are as if they were not there.
tinygltf::FsCallbacks files_but_images() {
    tinygltf::FsCallbacks files{};
    files.FileExists = [](const std::string& name, void*) {
        std::error_code error;
        return !is_image(name) && std::filesystem::is_regular_file(name, error);
    };
    files.ExpandFilePath = [](const std::string& name, void*) { return name; };
    files.ReadWholeFile = [](std::vector<unsigned char>* to, std::string* problem,
                             const std::string& name, void*) {
        try {
            const std::string bytes = read_bytes(name);
            to->assign(bytes.begin(), bytes.end());
            return true;
        } catch (const InputError& error) {
            *problem += error.what();
            return false;
        }
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                              void*) { return false; };
    return files;
}

tinygltf::Model parse(const MeshSource& source) {
    if (source.bytes.size() > 0xffffffffu) source.fail("is larger than glTF's limit of 4 GiB");
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(files_but_images());
    loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    tinygltf::Model model;
    std::string error, warning;
    bool read = false;
    const auto size = static_cast<unsigned int>(source.bytes.size());
    const std::string folder = source.path.parent_path().string();
    try {
        read = source.bytes.starts_with("glTF")
                   ? loader.LoadBinaryFromMemory(
                         &model, &error, &warning,
                         reinterpret_cast<const unsigned char*>(source.bytes.data()), size, folder)
                   : loader.LoadASCIIFromString(&model, &error, &warning, source.bytes.data(), size,
                                                folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!read) {
        const std::string first_line = error.substr(0, error.find('\n'));
        source.fail(fmt::format("is not valid glTF ({}); check it with a glTF validator",
                                first_line.empty() ? "no reason given" : first_line));
    }
    for (const std::string& extension : model.extensionsRequired)
        if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression")
            source.fail(fmt::format("needs {}; export it without compression", extension));
    return model;
}

}  // namespace

Mesh read_gltf(const MeshSource& source) {
    const tinygltf::Model model = parse(source);
    return GltfBuilder(source, model).build();
}

}  // namespace nacre
