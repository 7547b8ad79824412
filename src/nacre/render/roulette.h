#pragma once
// Russian roulette (Arvo and Kirk 1990): ends paths that carry little, and raises the rest so that
// the mean stays.
#include <algorithm>

#include "nacre/math/lanes.h"

namespace nacre {

/// Decides with the uniform number `u` whether a path goes on, by the largest lane of `weight`, and
/// divides `throughput` by the probability if it does. `eta` undoes the factor 1/eta^2 that a path
/// carries while it is inside a refracting object and gets back when it leaves. At most 95 %
/// survive, so that paths in white surroundings end.
inline bool survives(Spectral weight, float eta, float u, Spectral& throughput) {
    const float p = std::min(0.95f, max_lane(weight) * eta * eta);
    if (!(u < p)) return false;
    throughput *= Spectral(1.f / p);
    return true;
}

}  // namespace nacre
