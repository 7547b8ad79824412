#pragma once
// The solver's part of a fit. Only for the .cpp files of this room.
#include "nacre/measured/fit.h"
#include "nacre/measured/fit_residuals.h"

namespace nacre {

struct FitSolution {
    std::vector<double> x;
    double cost = infinite;
    int iterations = 0;
    bool converged = false;
};

/// A value for each unknown as the solver's list.
std::vector<double> spread(const std::vector<Unknown>& unknowns, int bands,
                           const std::vector<double>& start);

/// Those unknowns that change anything near some start.
std::vector<Unknown> active_unknowns(const FitProblem& fit, const TargetSamples& samples,
                                     FitMetric metric);

/// Half the squared relative error, as solutions have it.
double cost_at(const FitProblem& fit, const std::vector<double>& x, const TargetSamples& samples,
               FitMetric metric);

/// A few steps from every start on `few` of the samples, then the best ones to their ends. The
/// first steps go by the logarithmic metric, whatever is asked for: highlights leave it smooth.
/// The very first leave the positions `held` as they are. Throws RunError if no start has finite
/// values.
FitSolution solve_from(const FitProblem& fit, std::vector<std::vector<double>> starts,
                       const std::vector<int>& held, const TargetSamples& samples,
                       const TargetSamples& few, const FitOptions& options);

}  // namespace nacre
