#pragma once
// What one isotropic point source in an infinite diffusive medium, at height z from the plane z =
// 0, does to that plane at distance r: the brick that all profiles of the dipole family are laid
// with. Templates over the number type; the factor 1 / (4 pi) is left to the caller.
#include <cmath>
#include <type_traits>

#include "nacre/math/lanes.h"
#include "nacre/math/lanes_math.h"

namespace nacre::point_source {

/// With d^2 = r^2 + z^2 and a source of unit power: `fluence` is 4 pi D phi = e^(-s d) / d (mm^-1),
/// `flux` is 4 pi times the net flux through the plane away from the source, z (1 + s d) e^(-s d) /
/// d^3 (mm^-2), for s = sigma_tr.
template <class T>
struct OnPlane {
    T fluence, flux;
};

/// One root, one exponential and two divisions, of which the compiler drops what the caller does
/// not use. `r2` + z^2 > 0.
template <class T>
OnPlane<T> at(T r2, T z, T sigma_tr) {
    using std::exp, std::sqrt;
    const T d2 = r2 + z * z, d = sqrt(d2), sd = sigma_tr * d;
    const T e = exp(-sd);
    return {e / d, z * (T(1) + sd) * e / (d2 * d)};
}

/// Mean of e^(-t) over t in [0, x], x >= 0: (1 - e^(-x)) / x without cancellation. Packs have no
/// expm1 of their own: their series is exact to 1e-7 where the quotient loses more.
template <class T>
T mean_attenuation(T x) {
    using std::exp, std::expm1;
    if constexpr (std::is_floating_point_v<T>) {
        return x > T(0) ? -expm1(-x) / x : T(1);
    } else {
        const auto small = x < T(0.25);
        const T inner = T(1) - x * T(0.25) * (T(1) - x * T(0.2) * (T(1) - x * T(1. / 6)));
        const T series = T(1) - x * T(0.5) * (T(1) - x * T(1. / 3) * inner);
        const T safe = select(small, T(1), x);
        return select(small, series, (T(1) - exp(-safe)) / safe);
    }
}

/// Integral of 2 pi r `flux` / (4 pi) over r from 0 to sqrt(r2), for z > 0:
///   (e^(-s z) - z e^(-s d) / d) / 2, written so that small r keep their digits.
template <class T>
T flux_within(T r2, T z, T sigma_tr) {
    using std::exp, std::sqrt;
    const T d = sqrt(r2 + z * z), further = r2 / (d + z);  // d - z
    return T(0.5) * exp(-sigma_tr * z) * (further / d) *
           (T(1) + sigma_tr * z * mean_attenuation(T(sigma_tr * further)));
}
/// The same for all r: e^(-s z) / 2.
template <class T>
T flux_everywhere(T z, T sigma_tr) {
    using std::exp;
    return T(0.5) * exp(-sigma_tr * z);
}

/// Integral of 2 pi r `fluence` / (4 pi) over r from 0 to sqrt(r2): (e^(-s z) - e^(-s d)) / (2 s).
/// For all r it is e^(-s z) / (2 s), infinite without absorption; a pair of sources stays finite.
template <class T>
T fluence_within(T r2, T z, T sigma_tr) {
    using std::exp, std::sqrt;
    const T further = r2 / (sqrt(r2 + z * z) + z);
    return T(0.5) * exp(-sigma_tr * z) * further * mean_attenuation(T(sigma_tr * further));
}
/// Of a source at z_r less one at z_v >= z_r, for all r: (e^(-s z_r) - e^(-s z_v)) / (2 s).
template <class T>
T fluence_of_pair_everywhere(T z_r, T z_v, T sigma_tr) {
    using std::exp;
    const T apart = z_v - z_r;
    return T(0.5) * exp(-sigma_tr * z_r) * apart * mean_attenuation(T(sigma_tr * apart));
}

}  // namespace nacre::point_source
