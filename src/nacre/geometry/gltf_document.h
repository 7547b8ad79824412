#pragma once
// glTF 2.0 (Khronos 2021) through tinygltf: the document and its accessors. Only for the .cpp files
// that read glTF. Every offset is checked here: tinygltf hands over what the file says.
#include <fmt/format.h>

// Only the interface: the implementation, with its image decoders, stays in the library.
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <vector>

#include "nacre/geometry/mesh_source.h"

namespace nacre {

/// The document with its buffers. Pictures inside it are kept as they are (PNG, JPEG: in
/// Image::image) if asked for; those in files of their own are not looked at. Files that need an
/// extension which nacre does not know are refused by its name before anything else is judged.
tinygltf::Model parse_gltf(const MeshSource& source, bool keep_pictures = false);

/// The triangles of the default scene, in its frame, by material: [0] those without, [m + 1] those
/// of material m, whose texture coordinates are the set TEXCOORD_n, n = uv_sets[m + 1].
std::vector<Mesh> read_gltf_parts(const MeshSource& source, const tinygltf::Model& model,
                                  const std::vector<int>& uv_sets);

template <class T>
const T& entry(const MeshSource& source, const std::vector<T>& list, int index, const char* what) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        source.fail(fmt::format("names {} {}, but there are {}", what, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

/// Elements of an accessor as numbers, sparse replacements made.
class GltfElements {
  public:
    /// Throws InputError unless it holds `width` numbers an element, all inside its buffer.
    GltfElements(const MeshSource& source, const tinygltf::Model& model, int accessor, int width,
                 const char* what);
    GltfElements(const GltfElements&) = delete;
    GltfElements& operator=(const GltfElements&) = delete;

    std::size_t count() const { return count_; }
    double value(std::size_t i, int component) const;
    Vec3d vector(std::size_t i) const { return {value(i, 0), value(i, 1), value(i, 2)}; }

  private:
    void replace_sparse(const MeshSource& source, const tinygltf::Model& model,
                        const tinygltf::Accessor& accessor, int index, const char* what);

    int width_, type_ = 0;
    bool normalized_ = false;
    std::size_t size_ = 0, stride_ = 0, count_ = 0;
    const unsigned char* data_ = nullptr;
    std::vector<unsigned char> own_;  ///< of sparse accessors and of those that are all zero
};

}  // namespace nacre
