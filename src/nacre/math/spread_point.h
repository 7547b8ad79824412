#pragma once
// Points spread evenly over the unit square, the same every time.
#include <algorithm>
#include <cmath>

#include "nacre/math/vec.h"

namespace nacre {

/// Point i of an additive recurrence of the plastic number, in [0, 1) x [0, 1): of any number of
/// points the first ones are even (M. Roberts 2018, The Unreasonable Effectiveness of Quasirandom
/// Sequences, R2).
inline Vec2f spread_point(int i) {
    const auto part = [&](double step) {
        const double x = 0.5 + step * i;
        return std::min(float(x - std::floor(x)), 0x1.fffffep-1f);
    };
    return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace nacre
