#pragma once
// By how much the numbers that a pixel draws move from one frame of an average to the next.
#include <cmath>
#include <cstdint>

#include "nacre/math/vec.h"

namespace nacre {

/// Points of the R2 sequence (Roberts 2018): any run of frames is spread evenly. Frame 0 is (0, 0):
/// pictures that all have that number do not boil.
inline Vec2f frame_shift(std::uint32_t frame) {
    const auto fraction = [&](double a) { return float(std::fmod(a * frame, 1.)); };
    return {fraction(0.7548776662466927), fraction(0.5698402909980532)};
}

}  // namespace nacre
