#pragma once
// The parameters with which a model, or a sum of lobes of it, comes closest to a target: nonlinear
// least squares by Ceres (Levenberg and Marquardt's method within bounds) with exact derivatives,
// from several starts.
//
// All starts take a few steps on every eighth pair of directions; up to three that came to different
// places go on with all of them, and the best result is kept. No random numbers, sums in a fixed
// order: the same call gives the same result for any number of threads.
//
// Lobes are further instances of the model whose diffuse albedo kd is 0, so that the matte part is
// there once. One more is first fitted to what the lobes before it leave, from the same starts as a
// single one, then all move together.
//
// The fit keeps to the range of every parameter. It does not keep to bounds of sums such as
// kd + ks <= 1: a model that loses light would be held back by them. `beyond` says so where the
// result exceeds one.
#include <atomic>

#include "nacre/measured/fit_samples.h"
#include "nacre/measured/model_sum.h"

namespace nacre {

struct FitOptions {
    FitMetric metric = FitMetric::log;
    int stride = 8;                           ///< the first steps see every so many of the pairs
    int most_iterations = 100;                ///< of a start that goes on
    const std::atomic<bool>* stop = nullptr;  ///< when set, the best so far is returned
    // Of fit_sum:
    int lobes = 1;
    /// Red, green and blue each by itself, shape parameters too: three fits.
    bool by_channel = false;
};

struct SumFit {
    /// The lobes, the widest first, by the mean angle of the half vector to the normal, and the
    /// matte part with it; by channel those of red, of green and of blue, each black elsewhere. The
    /// settings are what was given, then what was fitted.
    ModelSum sum;
    FitErrors errors;  ///< on the samples of the fit
    double seconds = 0.;
    int numbers = 0;        ///< how many were fitted
    int iterations = 0;     ///< of the start that won, on all directions
    bool converged = true;  ///< false: stopped, or no end within the iterations
    std::vector<std::string>
        at_limit;        ///< what ended at the end of its range: "ks", "n of lobe 2", "alpha (red)"
    std::string beyond;  ///< "kd + ks = 1.2 ..." where a sum exceeds its bound
};

/// Fits what `given` does not set (fit_plan.h), in every lobe. What the model does not react to
/// keeps its default and is not in the settings. Throws InputError as AnyModel does for what is
/// given, and for several lobes of a model that has no kd or whose lobes have nothing to fit;
/// RunError if the model has no finite values near any start.
SumFit fit_sum(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
               const FitOptions& options = {});

struct ModelFit {
    Settings settings;  ///< what was given, then what was fitted
    std::string text;   ///< the same, "variant=duer kd=0.2,0.1,0.1 alpha=0.15", six digits
    AnyModel model;     ///< with them; everything below is that of this model, as in SumFit
    FitErrors errors;
    double seconds = 0.;
    int iterations = 0;
    bool converged = true;
    std::vector<std::string> at_limit;
    std::string beyond;
};

/// The same with one lobe of all bands.
ModelFit fit_model(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
                   const FitOptions& options = {});

}  // namespace nacre
