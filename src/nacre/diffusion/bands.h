#pragma once
// Up to four bands are solved for at once: each has matter of its own and shares the grid, so the
// lanes of one pack are the same cell's values in all of them. What must be exact is double; what
// only has to be good, such as corrections, is float.
#include "nacre/math/lanes.h"

namespace nacre {

using BandFloats = Lanes<float, 4>;
using BandDoubles = Lanes<double, 4>;

inline BandDoubles to_double(BandFloats a) {
    return BandDoubles::from(__builtin_convertvector(a.v, BandDoubles::Native));
}
inline BandFloats to_float(BandDoubles a) {
    return BandFloats::from(__builtin_convertvector(a.v, BandFloats::Native));
}

}  // namespace nacre
