#pragma once
// Spectra of many RGB reflectances at the same wavelengths, quickly: a mixture of seven smooth
// spectra that are uplifted once (uplift.h), of white, the primaries and the secondaries.
//
//   B. Smits 1999, An RGB-to-Spectrum Conversion for Reflectances, Journal of Graphics Tools 4(4):
//   as much white as the smallest component, then as much of the secondary colour of the two larger
//   ones, the rest of the primary.
//
// Linear in scale, and of any size; the colour of a mixture is exactly that of its parts, so the
// round trip is uplift.h's. Less smooth over colours than fit_rgb, which is to be preferred where a
// colour is used often.
#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

class RgbBasis {
  public:
    RgbBasis() = default;
    /// The seven spectra at the wavelengths `lambda` (nm).
    explicit RgbBasis(Spectral lambda);
    /// Of linear components, at least 0.
    Spectral eval(const Vec3f& rgb) const;

  private:
    Spectral white_{}, primary_[3]{}, secondary_[3]{};  ///< secondary c has no component c
};

}  // namespace nacre
