#pragma once
// Isotropic scattering: p = 1 / (4 pi).
#include <numbers>

namespace nacre {

template <class T>
struct IsotropicPhase {
    T eval(T) const { return T(0.25 * std::numbers::inv_pi); }
    T sample_cos(T u) const { return T(2) * u - T(1); }
    T mean_cosine() const { return T(0); }
};

}  // namespace nacre
