#pragma once
// Rayleigh scattering (Strutt 1871) of natural light by particles much smaller than the wavelength:
// p = 3 (1 + cos^2) / (16 pi).
#include <cmath>
#include <numbers>

namespace nacre {

template <class T>
struct RayleighPhase {
    T eval(T cos_theta) const {
        return T(3. / 16. * std::numbers::inv_pi) * (T(1) + cos_theta * cos_theta);
    }
    /// The distribution function (c^3 + 3 c + 4) / 8 = u is a depressed cubic with one real root,
    /// by Cardano w - 1 / w. The cube is taken of the larger branch, so that nothing cancels.
    T sample_cos(T u) const {
        using std::abs, std::cbrt, std::copysign, std::sqrt;
        const T q = T(4) * u - T(2);
        const T w = cbrt(abs(q) + sqrt(q * q + T(1)));
        return copysign(w - T(1) / w, q);
    }
    T mean_cosine() const { return T(0); }
};

}  // namespace nacre
