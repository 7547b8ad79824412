#pragma once
// d_att and a_att: what distance takes from light.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

/// The clamped quadratic of Foley et al. 1990, section 16.1.2 (and of PHIGS and OpenGL without the
/// clamp): min(1, 1 / (c1 + c2 d + c3 d^2)), c1, c2, c3 >= 0 and not all 0.
template <class D>
D distance_attenuation(D distance, D c1, D c2, D c3) {
    const D sum = c1 + distance * (c2 + distance * c3);
    return select(sum > D(1), D(1) / select(sum > D(1), sum, D(1)), D(1));
}

/// Solid angle of a small sphere of cross-section `area` at `distance`, sr.
template <class D>
D solid_angle(D area, D distance) {
    return area / (distance * distance);
}

/// Bouguer 1729, Lambert 1760: the share exp(-sigma d) of light that an absorbing medium leaves.
/// `sigma` is the absorption coefficient in 1 / unit of `distance`.
template <class D, class P>
Product<D, P> absorption_attenuation(P sigma, D distance) {
    using std::exp;
    return exp(-sigma * distance);
}

}  // namespace nacre::illumination
