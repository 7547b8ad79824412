#pragma once
// A comparison of models as the document that the report page draws.
#include <nlohmann/json_fwd.hpp>

#include "nacre/compare/model_comparison.h"

namespace nacre {

/// Which model is nearest to the target, in a sentence or more.
std::vector<std::string> advise(const ModelComparison& c);

/// The document, of kind "models": rows are models, the reference is the target; charts of albedo,
/// lobes (their radius the cube root of the value) and Burley's slices. Names its pictures but does
/// not hold them: whoever writes the page encodes ModelComparison::pictures. Facts on the machine,
/// the program and the date, and "command", are left to the caller too.
nlohmann::ordered_json describe(const ModelComparison& comparison);

}  // namespace nacre
