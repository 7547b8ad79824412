#pragma once
// What the four lanes of a path mean: four wavelengths, or the three bands of a picture given as
// RGB.
#include "nacre/math/lanes.h"

namespace nacre {

/// The visible range in which wavelengths are drawn and spectra are integrated, nm: the range of
/// the CIE 1931 colour matching functions.
inline constexpr float visible_min = 360.f;
inline constexpr float visible_max = 830.f;

/// rgb_bands: lanes 0..2 are linear red, green, blue and lane 3 is unused. spectral: each lane is a
/// wavelength.
enum class ColorMode { rgb_bands, spectral };

/// The meaning of a path's lanes, drawn once a path.
struct Wavelengths {
    ColorMode mode = ColorMode::rgb_bands;
    Spectral lambda;  ///< wavelength of each lane, nm (rgb_bands: 0)
    Spectral pdf;     ///< density with which the lane was drawn, nm^-1 (rgb_bands: 1)
    Spectral
        weight;  ///< what a lane counts in a mean over lanes; sums to 1 (rgb_bands: 1/3 x 3, 0)

    /// The three fixed bands.
    static Wavelengths rgb_bands();

    /// Four wavelengths from one uniform number u in [0, 1): the hero wavelength and three
    /// rotations of it (Wilkie et al. 2014, Hero Wavelength Spectral Sampling, EGSR), rotated in u,
    /// so that each lane by itself follows `wavelength_pdf`.
    static Wavelengths sample(float u);

    /// Given wavelengths (nm), as if drawn uniformly from the visible range.
    static Wavelengths at(Spectral lambda);
};

/// Density of a sampled wavelength, nm^-1: proportional to sech^2(0.0072 (lambda - 538)) in the
/// visible range, 0 outside; a smooth stand-in for the sum of the colour matching functions whose
/// distribution function inverts in closed form (Radziszewski, Boryczko, Alda 2009, An improved
/// technique for full spectral rendering, Journal of WSCG 17).
float wavelength_pdf(float lambda);

/// Mean of `value` over the lanes, each by its weight.
inline float mean(Spectral value, const Wavelengths& w) { return sum(value * w.weight); }

}  // namespace nacre
