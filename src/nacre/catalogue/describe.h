#pragma once
// Parameters as help, documentation and programs get to read them.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "nacre/catalogue/parameter.h"

namespace nacre {

/// "spectrum", "number", "choice", "whole number", "wavelength".
std::string_view kind_name(ParameterKind kind);

/// A parameter as lines of a page, six blanks in: its meaning, then kind, range, unit and default,
/// its choices and aliases.
std::string parameter_text(const Parameter& parameter);

/// A list of objects: name, meaning, kind, unit (if any), default, aliases; of a choice its
/// choices, of the others low, low_allowed, high (null: no end) and high_allowed (only if false).
nlohmann::ordered_json parameters_json(std::span<const Parameter> parameters);

/// What every description begins with as JSON: these, in this order; what is not known is null or
/// empty, and `parameters` is a list as of parameters_json.
struct Heading {
    std::string_view name, kind, title;
    std::string_view authors = "";
    int year = 0;  ///< 0: not known
    std::string_view paper = "";
    std::span<const Parameter> parameters = {};
};
nlohmann::ordered_json heading_json(const Heading& heading);

/// The words of a text in lines of at most 100 letters, the first after `lead`, the others below
/// it.
std::string wrapped(std::string lead, std::string_view text);

}  // namespace nacre
