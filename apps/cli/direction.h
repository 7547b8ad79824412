#pragma once
// Directions on the command line.
#include <string>

#include "nacre/math/vec.h"

namespace nacre::cli {

/// A direction from "x,y,z", of any length but 0; normalised. Throws InputError "OPTION 'text' ...".
Vec3d parse_direction(const std::string& text, const char* option);

}  // namespace nacre::cli
