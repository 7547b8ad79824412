// <texture type="checkerboard">: color0 (0.4) and color1 (0.2) in the four quarters of each unit
// square of texture coordinates, color0 around (0, 0) and (1, 1); to_uv transforms the coordinates
// first.
#include "nacre/scene/materials/texture_types.h"

namespace nacre {
namespace {

class Checkerboard final : public Texture {
  public:
    Checkerboard(TexturePtr color0, TexturePtr color1, const Transform& to_uv)
        : color0_(std::move(color0)), color1_(std::move(color1)), to_uv_(to_uv) {}

    Spectral eval(Vec2f uv, const Wavelengths& w) const override { return at(uv).eval(uv, w); }
    float eval_scalar(Vec2f uv) const override { return at(uv).eval_scalar(uv); }
    float max() const override { return std::max(color0_->max(), color1_->max()); }
    float mean() const override { return 0.5f * (color0_->mean() + color1_->mean()); }
    bool is_spectral() const override { return color0_->is_spectral() || color1_->is_spectral(); }

  private:
    const Texture& at(Vec2f uv) const {
        const Point3f p = to_uv_.point({uv.x, uv.y, 0.f});
        const bool right = p.x - std::floor(p.x) > 0.5f, upper = p.y - std::floor(p.y) > 0.5f;
        return right == upper ? *color0_ : *color1_;
    }

    TexturePtr color0_, color1_;
    Transform to_uv_;
};

}  // namespace

TexturePtr make_checkerboard(const SceneNode& node, ColorRole role, BuildContext& context) {
    return std::make_shared<Checkerboard>(get_texture(node, "color0", role, 0.4f, context),
                                          get_texture(node, "color1", role, 0.2f, context),
                                          node.get_transform("to_uv"));
}

}  // namespace nacre
