#pragma once
// Fits to Mie scattering in air by Nishita, Miyawaki, Nakamae 1987, A Shading Model for Atmospheric
// Scattering Considering Luminous Intensity Distribution of Light Sources, SIGGRAPH. With v = (1 +
// cos) / 2,
//   hazy:   p ~ 1 + 9 v^8        mean over the sphere 2
//   murky:  p ~ 1 + 50 v^32      mean over the sphere 83/33
// printed without normalisation; here p integrates to 1. A widespread variant of murky, 1/2 + 16.5
// v^32, gives both terms the same weight: mie_murky_33. All are mixtures w / (4 pi) + (1 - w) (n +
// 1) v^n / (4 pi) of isotropic scattering and a forward lobe.
#include <cmath>
#include <numbers>

namespace nacre {

template <class T>
struct MiePhase {
    int power;    ///< n, exponent of the forward lobe
    T isotropic;  ///< w, share of isotropic scattering

    static MiePhase hazy() { return {8, T(0.5)}; }
    static MiePhase murky() { return {32, T(33) / T(83)}; }
    static MiePhase murky_33() { return {32, T(0.5)}; }

    T eval(T cos_theta) const {
        T v = T(0.5) * (T(1) + cos_theta);
        for (int n = power; n > 1; n /= 2) v *= v;  // n is a power of two
        return T(0.25 * std::numbers::inv_pi) * (isotropic + (T(1) - isotropic) * T(power + 1) * v);
    }
    /// The lobe is chosen by u, which is then stretched to serve again.
    T sample_cos(T u) const {
        using std::pow;
        if (u < isotropic) return T(2) * (u / isotropic) - T(1);
        const T rest = (u - isotropic) / (T(1) - isotropic);
        return T(2) * pow(rest, T(1) / T(power + 1)) - T(1);
    }
    /// That of the lobe v^n is n / (n + 2).
    T mean_cosine() const { return (T(1) - isotropic) * T(power) / T(power + 2); }
};

}  // namespace nacre
