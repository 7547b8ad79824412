#pragma once
// A reflectance model's description as a manual page and as JSON.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/reflectance/description.h"

namespace nacre::cli {

std::string model_page(const ModelDescription& model);
nlohmann::ordered_json model_json(const ModelDescription& model);
/// "spectrum", "number", ... and the default as it is written; for other pages of the same facts.
std::string_view kind_name(ParameterKind kind);
std::string default_text(const Parameter& parameter);

}  // namespace nacre::cli
