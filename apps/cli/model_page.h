#pragma once
// A reflectance model's description as a manual page and as JSON.
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "nacre/reflectance/description.h"

namespace nacre::cli {

std::string model_page(const ModelDescription& model);
nlohmann::ordered_json model_json(const ModelDescription& model);

// Parts of it, for pages of other kinds of models.

/// The words of a text in lines of at most 100 letters, the first after `lead`, the others below
/// it.
std::string wrapped(std::string lead, std::string_view text);
/// Lines of a formula as pages have them.
std::string indented(std::string_view lines);
/// A parameter with its range, unit, default, choices and aliases.
std::string parameter_text(const Parameter& parameter);
nlohmann::ordered_json parameters_json(std::span<const Parameter> parameters);
/// "spectrum", "number", ... and the default as it is written; for other pages of the same facts.
std::string_view kind_name(ParameterKind kind);
std::string default_text(const Parameter& parameter);

}  // namespace nacre::cli
