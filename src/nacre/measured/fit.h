#pragma once
// The parameters with which a model comes closest to a target: nonlinear least squares by Ceres
// (Levenberg and Marquardt's method within bounds) with exact derivatives, from several starts.
//
// All starts take a few steps on an eighth of the directions; up to three that came to different
// places go on with all of them, and the best result is kept. No random numbers, sums in a fixed
// order: the same call gives the same result for any number of threads.
//
// The fit keeps to the range of every parameter. It does not keep to bounds of sums such as
// kd + ks <= 1: a model that loses light would be held back by them. ModelFit::beyond says so where
// the result exceeds one.
#include <atomic>

#include "nacre/measured/fit_samples.h"

namespace nacre {

struct FitOptions {
    FitMetric metric = FitMetric::log;
    int most_iterations = 100;                ///< of a start that goes on
    const std::atomic<bool>* stop = nullptr;  ///< when set, the best so far is returned
};

struct ModelFit {
    Settings settings;  ///< what was given, then what was fitted
    std::string text;   ///< the same, "variant=duer kd=0.2,0.1,0.1 alpha=0.15", six digits
    AnyModel model;     ///< with them; everything below is that of this model
    FitErrors errors;
    double seconds = 0.;
    int iterations = 0;     ///< of the start that won, on all directions
    bool converged = true;  ///< false: stopped, or no end within the iterations
    std::vector<std::string>
        at_limit;        ///< names of parameters that ended at the end of their range
    std::string beyond;  ///< "kd + ks = 1.2 ..." where a sum exceeds its bound
};

/// Fits what `given` does not set (fit_plan.h). What the model does not react to keeps its default
/// and is not in the text. Throws InputError as AnyModel does for what is given, and RunError if
/// the model has no finite values near any start.
ModelFit fit_model(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
                   const FitOptions& options = {});

}  // namespace nacre
