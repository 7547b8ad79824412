#pragma once
// What a verb found, for people or for programs.
#include <nlohmann/json_fwd.hpp>

namespace nacre::cli {

/// To standard output: JSON, or "key: value" lines, in which what is nested is indented.
void print_found(const nlohmann::ordered_json& json, bool as_json);

}  // namespace nacre::cli
