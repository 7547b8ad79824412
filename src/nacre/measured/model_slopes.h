#pragma once
// Values of a model with exact derivatives by its parameters: the models' own source on dual
// numbers.
#include <span>

#include "nacre/reflectance/evaluator.h"

namespace nacre {

/// For each pair of directions the BRDF (sr^-1) and its derivatives. `slot[i]` says which
/// derivative parameter i contributes to, -1: none; parameters that share one move together.
/// `slopes` holds `slots` numbers a pair. Derivatives that do not exist (a root at 0) may be
/// infinite or NaN. Throws InputError if the model is not in the list of models.h.
void eval_with_slopes(const ModelDescription& model, const ValuesD& values,
                      std::span<const int> slot, int slots, std::span<const Vec3d> wi,
                      std::span<const Vec3d> wo, std::span<double> value, std::span<double> slopes);

}  // namespace nacre
