#pragma once
// What the solver sees of a fit: residuals and their derivatives. Only for the .cpp files of this
// room.
#include <ceres/cost_function.h>

#include "nacre/measured/fit_plan.h"
#include "nacre/measured/fit_samples.h"

namespace nacre {

/// Where the numbers of the unknowns stand in the list that the solver sees: three in a row for a
/// colour.
struct Layout {
    explicit Layout(const std::vector<Unknown>& unknowns) {
        for (const Unknown& u : unknowns) {
            first.push_back(size);
            size += u.colour ? 3 : 1;
        }
    }
    std::vector<int> first;
    int size = 0;
};

/// Residuals: for each pair and band what the metric sees of model and target, times the root of
/// the weight, over the target's size; half their sum of squares is half the squared relative
/// error. What is given must outlive it.
class FitResiduals final : public ceres::CostFunction {
  public:
    /// `fixed`: the values of all parameters, by band; unknowns replace theirs.
    FitResiduals(const ModelDescription& model, const std::array<ValuesD, 3>& fixed,
                 const std::vector<Unknown>& unknowns, const TargetSamples& samples,
                 FitMetric metric);

    /// False where a value is not finite.
    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;
    /// Notes which unknowns change anything at x.
    void note_active(const double* x, std::vector<bool>& active) const;

  private:
    ValuesD values_at(const double* x, int band) const;
    bool add(const ValuesD& values, int band, std::size_t begin, std::size_t end, double* residuals,
             double* jacobian) const;

    const ModelDescription& model_;
    const std::array<ValuesD, 3>& fixed_;
    const std::vector<Unknown>& unknowns_;
    Layout layout_;
    const TargetSamples& samples_;
    FitMetric metric_;
    std::vector<int> slot_;  ///< of each parameter, the position of its unknown; -1: none
    std::vector<double> factor_;
};

}  // namespace nacre
