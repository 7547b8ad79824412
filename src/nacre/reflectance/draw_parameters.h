#pragma once
// Random parameters within the ranges that a model allows and the conditions of one of its claims.
#include "nacre/math/random.h"
#include "nacre/reflectance/description.h"

namespace nacre {

/// Numbers of all parameters but those that the behaviour's options set and wavelengths, as often
/// as not corners of their ranges or, over wide ranges, drawn by their logarithms. With a `parent`,
/// which has those of an earlier call, most are taken from there, others moved a little or drawn
/// anew.
NamedNumbers draw_parameters(const ModelDescription& model, const Behaviour& behaviour,
                             Random& random, const NamedNumbers* parent = nullptr);

/// As settings, "variant=full sigma=0.3".
std::string settings_text(const ModelDescription& model, const NamedNumbers& numbers);

}  // namespace nacre
