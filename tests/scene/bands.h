#pragma once
// The lanes of most tests of this room.
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

inline const Wavelengths bands = Wavelengths::rgb_bands();

}  // namespace nacre
