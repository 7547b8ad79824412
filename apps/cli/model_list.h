#pragma once
// Lists of reflectance models with settings, as options take them.
#include <string>
#include <vector>

#include "nacre/measured/target.h"

namespace nacre::cli {

/// "ward variant=duer,ggx" or "ward:variant=duer,ggx": what begins like a number goes on with the
/// colour before the comma. Throws InputError that names the option if there is none; names and
/// settings are not checked.
std::vector<ModelSpec> parse_models(const std::string& option, const std::string& text);

}  // namespace nacre::cli
