#pragma once
// What `nacre models` says of an illumination model, from its own description.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/illumination/models.h"

namespace nacre::cli {

std::string illumination_page(const illumination::Description& model);
nlohmann::ordered_json illumination_json(const illumination::Description& model);

}  // namespace nacre::cli
