#pragma once
// What `nacre models` says of diffusion profiles and subsurface techniques, from their own
// descriptions.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/bssrdf/profile.h"
#include "nacre/technique/technique.h"

namespace nacre::cli {

std::string profile_page(const ProfileDescription& profile);
nlohmann::ordered_json profile_json(const ProfileDescription& profile);
std::string technique_page(const TechniqueDescription& technique);
nlohmann::ordered_json technique_json(const TechniqueDescription& technique);

}  // namespace nacre::cli
