#pragma once
// Quantities of a glTF material over its surface: factors times textures, as parameters of nodes.
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/scene/build.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre {

/// What a material says of one point.
struct GltfTexel {
    Vec3f base_color, emissive, diffuse_transmission_color;
    float alpha, metallic, roughness, transmission, diffuse_transmission;
};

/// The fields of one material. What a parameter needs is computed texel by texel from all textures
/// that it depends on, once, so that materials take plain numbers and pictures.
class GltfFields {
  public:
    /// `material` is changed: textures that cannot be laid on with the others are left out and told
    /// in its `left_out`. The object and the context outlive the fields.
    GltfFields(const GltfObject& object, GltfMaterial& material, BuildContext& context);

    using Color = std::function<Vec3f(const GltfTexel&)>;
    using Number = std::function<float(const GltfTexel&)>;

    /// Gives `node` the parameter `name`: a colour or number where no texture that it depends on
    /// varies, else a bitmap.
    void put(const NodePtr& node, const char* name, const Color& of);
    void put(const NodePtr& node, const char* name, const Number& of);
    /// The range of a number over the surface.
    struct Range {
        float low, high;
    };
    Range range(const Number& of) const;

  private:
    void read_textures();
    GltfTexel texel(int x, int y) const;
    template <class F>
    bool varies(const F& of) const;
    void put_bitmap(const NodePtr& node, const char* name, std::shared_ptr<const Image> image);

    struct Layer {
        std::shared_ptr<const Image> linear, raw;  ///< sRGB decoded, as stored
    };
    const Image& pixels(int index, bool raw);
    std::array<float, 4> sample(const Image* image, int x, int y) const;

    const GltfObject& object_;
    GltfMaterial& m_;
    BuildContext& context_;
    std::map<int, Layer> layers_;
    const GltfTexture* layout_ = nullptr;  ///< of all textures; null: there is none
    int width_ = 1, height_ = 1;
    std::array<const Image*, 6> pixels_{};  ///< of GltfMaterial::textures, null: none
};

}  // namespace nacre
