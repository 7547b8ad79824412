#pragma once
// From radiometric to photometric quantities: watts weighted by the eye's sensitivity.
//
//   radiance   W m^-2 sr^-1  ->  luminance   cd/m^2
//   irradiance W m^-2        ->  illuminance lx
//   intensity  W sr^-1       ->  cd;     flux W -> lm
//
// Spectra are per nm of wavelength.
#include "nacre/spectrum/spectrum.h"

namespace nacre {

/// Photopic maximum, lm/W: by definition of the candela (SI 2019) 683 at 540 THz, where V is 1.
inline constexpr float km_photopic = 683.f;
/// Scotopic maximum, lm/W: the same definition applied to V' (CIE 1951), rounded as CIE and BIPM
/// do.
inline constexpr float km_scotopic = 1700.f;
/// Multiplies Y in the scale of color.h, taken of a quantity per nm, to give its photometric
/// counterpart: Km times the integral of ybar (106.857028 nm).
inline constexpr float photometric_scale = km_photopic * 106.857028f;

/// Spectral luminous efficiency V(lambda), CIE 1924, equal to ybar; nm; 0 outside 360..830.
float photopic_efficiency(float nm);
/// Scotopic luminous efficiency V'(lambda), CIE 1951; nm; 0 outside 380..780.
float scotopic_efficiency(float nm);

/// Luminance (cd/m^2) of a spectral radiance (W m^-2 sr^-1 nm^-1).
float luminance(const Spectrum& radiance);
/// Illuminance (lx) of a spectral irradiance (W m^-2 nm^-1).
float illuminance(const Spectrum& irradiance);
/// Scotopic luminance (scotopic cd/m^2) of a spectral radiance, for eyes adapted to the dark.
float scotopic_luminance(const Spectrum& radiance);

}  // namespace nacre
