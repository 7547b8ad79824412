// The texture that is the same everywhere.
#include "nacre/scene/texture.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

class ConstantTexture final : public Texture {
  public:
    explicit ConstantTexture(SpectrumPtr spectrum)
        : spectrum_(std::move(spectrum)), scalar_(luminance(spectrum_->rgb())) {}
    ConstantTexture(SpectrumPtr spectrum, float scalar)
        : spectrum_(std::move(spectrum)), scalar_(scalar) {}

    Spectral eval(Vec2f, const Wavelengths& w) const override { return spectrum_->eval(w); }
    float eval_scalar(Vec2f) const override { return scalar_; }
    float max() const override { return spectrum_->max(); }
    float mean() const override { return scalar_; }
    bool is_constant() const override { return true; }
    bool is_spectral() const override { return spectrum_->is_spectral(); }

  private:
    SpectrumPtr spectrum_;
    float scalar_;
};

}  // namespace

TexturePtr make_constant_texture(SpectrumPtr spectrum) {
    return std::make_shared<ConstantTexture>(std::move(spectrum));
}

TexturePtr make_constant_texture(float value) {
    // The number itself: its luminance as grey would be off by the rounding of the RGB weights.
    return std::make_shared<ConstantTexture>(make_constant(value), value);
}

}  // namespace nacre
