#pragma once
// A reflectance model's description as a manual page and as JSON.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/reflectance/description.h"

namespace nacre::cli {

std::string model_page(const ModelDescription& model);
nlohmann::ordered_json model_json(const ModelDescription& model);

/// Lines of a formula as pages have them.
std::string indented(std::string_view lines);

}  // namespace nacre::cli
