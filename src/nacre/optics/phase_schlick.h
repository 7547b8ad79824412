#pragma once
// Schlick's rational stand-in for Henyey-Greenstein (Blasi, Le Saec, Schlick 1993, A Rendering
// Algorithm for Discrete Volume Density Objects, Computer Graphics Forum 12(3)):
//   p = (1 - k^2) / (4 pi (1 - k cos)^2),   -1 < k < 1,   k ~ 1.55 g - 0.55 g^3.
#include <cmath>
#include <numbers>

namespace nacre {

/// The k whose lobe resembles Henyey-Greenstein's of mean cosine g (Pharr and Humphreys 2004).
template <class T>
T schlick_k(T g) {
    return T(1.55) * g - T(0.55) * g * g * g;
}

template <class T>
struct SchlickPhase {
    T k;

    T eval(T cos_theta) const {
        const T d = T(1) - k * cos_theta;
        return T(0.25 * std::numbers::inv_pi) * (T(1) - k * k) / (d * d);
    }
    T sample_cos(T u) const { return (T(2) * u - (T(1) - k)) / (T(1) - k + T(2) * k * u); }
    /// 1/k - (1 - k^2) / (2 k^2) ln((1 + k) / (1 - k)); a series where that cancels.
    T mean_cosine() const {
        using std::abs, std::log1p;
        const T k2 = k * k;
        if (abs(k) < T(0.1))
            return k *
                   (T(2) / T(3) + k2 * (T(2) / T(15) + k2 * (T(2) / T(35) + k2 * (T(2) / T(63)))));
        return T(1) / k - (T(1) - k2) / (T(2) * k2) * (log1p(k) - log1p(-k));
    }
};

}  // namespace nacre
