#pragma once
// Colours of light: CIE 1931 XYZ and linear RGB with the primaries of ITU-R BT.709 / sRGB and white
// D65.
//
// Scale: XYZ are integrals over wavelength divided by the integral of ybar (106.857 nm), so that
// the spectrum that is 1 everywhere has Y = 1, and D65 scaled to Y = 1 is rgb (1, 1, 1). Multiply Y
// of a radiance in W m^-2 sr^-1 nm^-1 by `photometric_scale` (photometry.h) for cd/m^2.
#include "nacre/math/vec.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// Estimate of a path's linear RGB colour from the radiance in its lanes. rgb_bands: the first
/// three lanes. spectral: one-sample estimate of the integral against the colour matching
/// functions, unbiased over `Wavelengths::sample`; single estimates may be negative.
Vec3f to_rgb(Spectral radiance, const Wavelengths& w);

/// Y of linear RGB.
float luminance(Vec3f linear_rgb);

/// CIE XYZ to linear RGB and back. The matrix follows from the sRGB primaries (IEC 61966-2-1) and
/// the white of the D65 table in cie.h, so that D65 is white to the last digit; it differs from the
/// standard's four-digit matrix by less than 3e-4.
Vec3f xyz_to_rgb(Vec3f xyz);
Vec3f rgb_to_xyz(Vec3f rgb);

/// The sRGB transfer curve (IEC 61966-2-1), encode: linear light to stored value. Odd in its
/// argument, so negative values survive a round trip; nothing is clamped.
float srgb_encode(float linear);
float srgb_decode(float encoded);

}  // namespace nacre
