#pragma once
// A model's claims at random parameters and at the rim, beside the examples of its description.
#include "nacre/reflectance/check.h"

namespace nacre {

/// Draws parameters from the ranges and conditions of the behaviour (draw_parameters.h), every
/// second set near the brightest so far, and looks whether
/// - values are numbers, finite and not negative, in double and single precision and in packs, for
///   random pairs of directions and for opposite, equal, mirrored and grazing ones;
/// - the albedo is at most 1, or the behaviour's `at_most`, to 1e-6 and four times the quadrature's
///   error, at 0, 45, 80, 89, 89.9 and a random angle up to 89.99 degrees, by the model's own
///   samples and, unless these lie more than four standard errors below, by quadrature;
/// - exchanged directions give the same value to 1e-9, if that is claimed.
/// One outcome, whose detail names parameters and angle of the first failure or the largest albedo.
CheckOutcome check_random_parameters(const Evaluator& evaluator, const Behaviour& behaviour,
                                     const CheckOptions& options);

}  // namespace nacre
