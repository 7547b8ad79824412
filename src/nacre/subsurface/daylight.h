#pragma once
// What light at fixed bands is given as a multiple of.
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// Daylight in the lanes of a path; 1 in RGB bands. Irradiance is interpolated between bands as a
/// multiple of it: the lines of the sun are in most scenes' light, and narrower than bands.
inline Spectral daylight(const Wavelengths& w) {
    if (w.mode == ColorMode::rgb_bands) return Spectral(1.f);
    Spectral r;
    for (int i = 0; i < Spectral::size; ++i) r.set(i, cie_d65(w.lambda[i]));
    return r;
}

}  // namespace nacre
