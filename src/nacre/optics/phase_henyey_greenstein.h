#pragma once
// Henyey and Greenstein 1941, Diffuse radiation in the galaxy, Astrophysical Journal 93:
//   p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)),   -1 < g < 1, mean cosine g.
// And the sum of two of them.
#include <cmath>
#include <numbers>

namespace nacre {

template <class T>
struct HenyeyGreensteinPhase {
    T g;

    T eval(T cos_theta) const {
        using std::abs, std::copysign, std::sqrt;
        // 1 + g^2 - 2 g cos, written so that it keeps its digits in the peak of a narrow lobe.
        const T a = abs(g), m = T(1) - a;
        const T d = m * m + T(2) * a * (T(1) - copysign(T(1), g) * cos_theta);
        return T(0.25 * std::numbers::inv_pi) * (T(1) - g * g) / (d * sqrt(d));
    }
    /// The inverse distribution function, increasing in u. The textbook form divides by 2 g; with a
    /// = 1 - g + 2 g u it becomes
    ///   cos = 1 - 2 (1 - g)^2 (1 - u) (1 + g u) / a^2,
    /// which holds for every g, 0 included, and loses no digits at either end.
    T sample_cos(T u) const {
        const T m = (T(1) - g) / (T(1) - g + T(2) * g * u);
        return T(1) - T(2) * m * m * (T(1) - u) * (T(1) + g * u);
    }
    T mean_cosine() const { return g; }
};

/// A share `first` of g1 and the rest of g2.
template <class T>
struct TwoTermHenyeyGreensteinPhase {
    T first, g1, g2;

    T eval(T cos_theta) const {
        return first * HenyeyGreensteinPhase<T>{g1}.eval(cos_theta) +
               (T(1) - first) * HenyeyGreensteinPhase<T>{g2}.eval(cos_theta);
    }
    /// The term is chosen by u, which is then stretched to serve again.
    T sample_cos(T u) const {
        if (u < first) return HenyeyGreensteinPhase<T>{g1}.sample_cos(u / first);
        return HenyeyGreensteinPhase<T>{g2}.sample_cos((u - first) / (T(1) - first));
    }
    T mean_cosine() const { return first * g1 + (T(1) - first) * g2; }
};

}  // namespace nacre
