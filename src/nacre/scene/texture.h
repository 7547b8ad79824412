#pragma once
// Textures: quantities that vary over a surface.
#include <memory>

#include "nacre/spectrum/spectrum.h"

namespace nacre {

/// A spectral or scalar quantity over texture coordinates.
class Texture {
  public:
    virtual ~Texture() = default;
    /// The quantity at the path's wavelengths.
    virtual Spectral eval(Vec2f uv, const Wavelengths& wavelengths) const = 0;
    /// The quantity as a plain number (roughness, opacity): the luminance of coloured textures.
    virtual float eval_scalar(Vec2f uv) const = 0;
    /// Largest value anywhere, any wavelength: how energy conservation is checked at load.
    virtual float max() const = 0;
    /// Mean over the texture as a plain number.
    virtual float mean() const = 0;
    /// Whether it is the same at all points.
    virtual bool is_constant() const { return false; }
    /// True if it carries wavelength data that three bands cannot represent.
    virtual bool is_spectral() const { return false; }
};
using TexturePtr = std::shared_ptr<const Texture>;

/// The same spectrum everywhere.
TexturePtr make_constant_texture(SpectrumPtr spectrum);
TexturePtr make_constant_texture(float value);

}  // namespace nacre
