#pragma once
// What the solver sees of a fit: residuals and their derivatives. Only for the .cpp files of this
// room.
#include <ceres/cost_function.h>

#include "nacre/measured/fit_plan.h"
#include "nacre/measured/fit_samples.h"

namespace nacre {

/// What is fitted: a sum of lobes, each an instance of the model.
struct FitProblem {
    const ModelDescription& model;
    std::vector<int> bands;  ///< of red, green and blue
    /// Of each lobe the values of all parameters, by band; unknowns replace theirs.
    std::vector<std::array<ValuesD, 3>> lobes = {};
    std::vector<Unknown> unknowns = {};  ///< those of the first lobe before those of the second

    Layout layout() const { return {unknowns, int(bands.size())}; }
};

/// Residuals: for each pair and band what the metric sees of model and target, times the root of
/// the weight, over the target's size; half their sum of squares is half the squared relative
/// error. What is given must outlive it. Keeps its last answer, because the solver asks up to three
/// times at one place: one solver at a time.
class FitResiduals final : public ceres::CostFunction {
  public:
    FitResiduals(const FitProblem& problem, const TargetSamples& samples, FitMetric metric);

    /// False where a value is not finite.
    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;
    /// Notes which unknowns change anything at x.
    void note_active(const double* x, std::vector<bool>& active) const;

  private:
    struct Lobe {
        std::size_t first = 0;  ///< of its unknowns
        int unknowns = 0;       ///< how many
        std::vector<int> slot;  ///< of each parameter, which of them sets it; -1: none
    };
    /// All of Evaluate, without looking at what is kept.
    bool compute(const double* x, double* residuals, double* jacobian) const;
    ValuesD values_at(const double* x, std::size_t lobe, std::size_t band) const;
    bool add(const double* x, std::size_t band, std::size_t begin, std::size_t end,
             double* residuals, double* jacobian) const;

    const FitProblem& problem_;
    Layout layout_;
    const TargetSamples& samples_;
    FitMetric metric_;
    std::vector<Lobe> lobes_;
    std::vector<double> factor_;
    struct Answer {
        bool is_kept = false;
        std::vector<double> x, residuals, jacobian;  ///< the last empty where not asked for
    };
    mutable Answer last_;
};

}  // namespace nacre
