#pragma once
// Transcendental functions of packs. The four-wavelength versions are compiled once
// (lanes_math.cpp), so that the renderer does not pay for the SIMD library's headers; bulk
// evaluation includes lanes_wide.h, which inlines them.
#include "nacre/math/lanes.h"

namespace nacre {

Spectral exp(Spectral x);
Spectral log(Spectral x);
Spectral pow(Spectral x, Spectral y);
Spectral sin(Spectral x);
Spectral cos(Spectral x);

}  // namespace nacre
