#pragma once
// What every model must face: its own claims (description.h), put to the test.
#include <cstdint>
#include <string>
#include <vector>

#include "nacre/reflectance/evaluator.h"

namespace nacre {

struct CheckOutcome {
    std::string name;  ///< "ward variant=gmd: sampling"
    bool passed = false;
    std::string detail;  ///< the number that decided, and where
};

struct CheckOptions {
    std::uint64_t seed = 1;
    int samples = 40000;   ///< a chi-square test
    int random_sets = 16;  ///< sets of random parameters, a behaviour; 0: none
    /// Probability that some sampling test of the model fails although its sampler is right.
    double significance = 0.001;
};

/// For each behaviour of the model, over its examples and incidences of 0, 30, 60 and 80 degrees:
/// - sampling: Pearson's chi-square of drawn directions against the density over 16 x 16 bins of
///   the hemisphere (bins that expect fewer than five are pooled, lost samples are a bin of their
///   own), and the mass of the density against the share of samples above the horizon;
/// - furnace: values are finite and not negative, and the albedo lies within [0, 1] and above 0 if
///   anything reflects; a model that claims to exceed 1 must do so at its witness;
/// - reciprocity: largest relative difference over 200 random pairs, at most 1e-9 if claimed, and
///   more than 1e-2 if denied;
/// - horizon: exactly 0 if either direction is below it;
/// - random parameters: see check_random.h;
/// - albedo: the closed form against quadrature, if there is one.
std::vector<CheckOutcome> check_model(const Evaluator& evaluator, const CheckOptions& options = {});

}  // namespace nacre
