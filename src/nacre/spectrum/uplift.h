#pragma once
// From RGB to smooth spectra: Jakob and Hanika 2019, A Low-Dimensional Function Space for Efficient
// Spectral Upsampling, Computer Graphics Forum 38(2). A reflectance is S(c0 t^2 + c1 t + c2) with
// the sigmoid S(x) = 1/2 + x / (2 sqrt(1 + x^2)), which stays within (0, 1) by construction.
#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

/// A reflectance spectrum of three coefficients. The polynomial's variable is t = (lambda - 595) /
/// 235, which runs over [-1, 1] in the visible range and keeps single precision accurate (the paper
/// uses lambda itself).
struct SigmoidPolynomial {
    float c0 = 0, c1 = 0, c2 = 0;

    /// Reflectance at the wavelengths `lambda` (nm), in [0, 1].
    Spectral eval(Spectral lambda) const {
        const Spectral t = (lambda - 595.f) * (1.f / 235.f);
        const Spectral x = (c0 * t + c1) * t + c2;
        return 0.5f + 0.5f * x / sqrt(1.f + x * x);
    }
    /// The largest value over the visible range.
    float max() const;
};

/// The smooth reflectance whose colour under D65 is `rgb` (linear, sRGB primaries); components are
/// clamped to [0, 1]. Round trip within 3e-4 in each component. About 1 us a colour: a damped
/// Gauss-Newton in CIELAB from the nearest entry of a small table that is solved on first use
/// (about 15 ms; thread-safe, immutable afterwards).
SigmoidPolynomial fit_rgb(Vec3f rgb);

}  // namespace nacre
