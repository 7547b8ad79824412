#pragma once
// Quantities that vary with wavelength: reflectances, coefficients of media, emitted radiance.
#include <memory>
#include <vector>

#include "nacre/math/vec.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// A function of wavelength that also knows its RGB projection, so that one scene renders with
/// wavelengths and with RGB bands. Immutable.
class Spectrum {
  public:
    virtual ~Spectrum() = default;

    /// Value in each lane. In rgb_bands mode (r, g, b, 0), see `rgb`.
    virtual Spectral eval(const Wavelengths& w) const = 0;

    /// Projection to linear RGB: the colour of the reflectance under D65, or of the emission.
    virtual Vec3f rgb() const = 0;

    /// An upper bound on every value that `eval` returns in either mode.
    virtual float max() const = 0;

    /// Whether the spectrum carries genuine wavelength data (tabulated, blackbody) rather than a
    /// number or an RGB triple.
    virtual bool is_spectral() const { return false; }
};

using SpectrumPtr = std::shared_ptr<const Spectrum>;

/// How wavelength data become RGB. The same choices as Mitsuba 3's RGB variants.
enum class SpectrumRole {
    reflectance,  ///< 0..1: the colour seen under D65, clamped to [0, 1]
    unbounded,   ///< coefficients of media, indices: as reflectance, but only clamped from below at
                 ///< 0
    illuminant,  ///< emission: the colour of the light itself, clamped from below at 0
};

/// The same value at every wavelength and in every band.
SpectrumPtr make_constant(float value);

/// Values at the wavelengths `nm`, linear in between and 0 outside (as in Mitsuba 3). Throws
/// InputError unless there are at least two finite wavelengths in increasing order and as many
/// finite, non-negative values.
SpectrumPtr make_tabulated(std::vector<float> nm, std::vector<float> value, SpectrumRole role);

/// Planck's law: spectral radiance of a black body, W m^-2 sr^-1 nm^-1, times `scale`. Throws
/// InputError unless kelvin > 0 and scale >= 0.
SpectrumPtr make_blackbody(float kelvin, float scale = 1.f);

/// A reflectance from linear RGB in [0, 1] (clamped above): Jakob-Hanika uplift, see uplift.h. This
/// and the next two throw InputError on negative or non-finite components.
SpectrumPtr make_rgb_reflectance(Vec3f rgb);

/// A non-negative quantity of any size from linear RGB: twice the largest component times the
/// uplifted reflectance of rgb over that, so that greys stay constant over wavelength.
SpectrumPtr make_rgb_unbounded(Vec3f rgb);

/// Emission from linear RGB: as make_rgb_unbounded, times D65 scaled to Y = 1; rgb (1, 1, 1) is D65
/// of Y = 1 (scale of color.h).
SpectrumPtr make_rgb_illuminant(Vec3f rgb);

}  // namespace nacre
