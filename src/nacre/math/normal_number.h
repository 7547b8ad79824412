#pragma once
// Normally distributed random numbers.
#include <cmath>
#include <numbers>

#include "nacre/math/random.h"

namespace nacre {

/// Of mean 0 and variance 1; takes two numbers (G. E. P. Box, M. E. Muller 1958, A Note on the
/// Generation of Random Normal Deviates).
inline double normal_number(Random& random) {
    const Vec2f u = random.next2();
    return std::sqrt(-2. * std::log(1. - double(u.x))) *
           std::cos(2. * std::numbers::pi * double(u.y));
}

}  // namespace nacre
