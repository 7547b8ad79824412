#pragma once
// What `nacre models` says of generated microgeometry, from its own descriptions.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/goniometer/microgeometry.h"

namespace nacre::cli {

std::string microgeometry_page(const MicrogeometryDescription& geometry);
nlohmann::ordered_json microgeometry_json(const MicrogeometryDescription& geometry);

}  // namespace nacre::cli
