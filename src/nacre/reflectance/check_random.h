#pragma once
// A model's claims at random parameters and at the rim, beside the examples of its description.
#include "nacre/reflectance/check.h"

namespace nacre {

/// Draws parameters from the ranges and conditions of the behaviour (corners and, over wide ranges,
/// logarithms as often as not) and looks whether
/// - values are numbers, finite and not negative, in double and single precision and in packs, for
///   random pairs of directions and for opposite, equal, mirrored and grazing ones;
/// - the albedo is at most 1, or the behaviour's `at_most`, to 2e-3, at 0, 45, 80, 89 and 89.9
///   degrees, by the model's own samples and where these come close by quadrature;
/// - exchanged directions give the same value to 1e-6, if that is claimed.
/// One outcome, whose detail names parameters and angle of the first failure or the largest albedo.
CheckOutcome check_random_parameters(const Evaluator& evaluator, const Behaviour& behaviour,
                                     const CheckOptions& options);

}  // namespace nacre
