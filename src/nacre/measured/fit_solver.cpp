#include "nacre/measured/fit_solver.h"

#include <ceres/iteration_callback.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <tbb/parallel_for.h>

#include "nacre/math/error.h"

namespace nacre {
namespace {

class StopWhenAsked final : public ceres::IterationCallback {
  public:
    explicit StopWhenAsked(const std::atomic<bool>* stop) : stop_(stop) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
        return stop_ && *stop_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

  private:
    const std::atomic<bool>* stop_;
};

/// What is fitted to what, and by which measure.
struct Task {
    const FitProblem& fit;
    const TargetSamples& samples;
    FitMetric metric;
    const std::atomic<bool>* stop;
};

/// From x within the bounds. What `held` lists stays as it is.
FitSolution solve(const Task& task, std::vector<double> x, int iterations,
                  const std::vector<int>& held = {}) {
    const FitProblem& fit = task.fit;
    FitResiduals residuals(fit, task.samples, task.metric);
    ceres::Problem::Options ours;
    ours.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ours);
    problem.AddParameterBlock(x.data(), int(x.size()));
    problem.AddResidualBlock(&residuals, nullptr, x.data());
    if (!held.empty())
        problem.SetManifold(x.data(), new ceres::SubsetManifold(int(x.size()), held));
    const Layout layout = fit.layout();
    for (std::size_t u = 0; u < fit.unknowns.size(); ++u)
        for (int k = layout.first[u]; k < layout.first[u] + layout.count[u]; ++k) {
            problem.SetParameterLowerBound(x.data(), k, fit.unknowns[u].low);
            if (fit.unknowns[u].high < infinite)
                problem.SetParameterUpperBound(x.data(), k, fit.unknowns[u].high);
        }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-9;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    StopWhenAsked callback(task.stop);
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return {std::move(x)};
    return {std::move(x), summary.final_cost, int(summary.iterations.size()),
            summary.termination_type == ceres::CONVERGENCE};
}

/// Positions in x of what stands at the end of its range.
std::vector<int> at_ends(const FitProblem& fit, const std::vector<double>& x) {
    std::vector<int> found;
    const Layout layout = fit.layout();
    for (std::size_t u = 0; u < fit.unknowns.size(); ++u)
        for (int k = layout.first[u]; k < layout.first[u] + layout.count[u]; ++k)
            if (x[k] <= fit.unknowns[u].low || x[k] >= fit.unknowns[u].high) found.push_back(k);
    return found;
}

/// Goes on from a solution. The solver's steps end at the bounds that they meet, which can be a
/// crawl along them; so what has reached one is held while the others move, and let go again.
FitSolution polished(const Task& task, FitSolution best, int iterations) {
    const auto stopped = [&] { return task.stop && *task.stop; };
    for (int round = 0; round < 3 && best.cost < infinite && !stopped(); ++round) {
        const std::vector<int> held = at_ends(task.fit, best.x);
        if (held.empty() || held.size() == best.x.size()) break;
        const double before = best.cost;
        for (const std::vector<int>& h : {held, std::vector<int>{}}) {
            FitSolution next = solve(task, best.x, iterations, h);
            next.iterations += best.iterations;
            if (next.cost < best.cost) best = std::move(next);
        }
        if (best.cost > before * (1. - 1e-5)) break;
    }
    return best;
}

/// Drops solutions that cost as much as a better one, to one part in ten thousand: the same valley.
/// Keeps at most three. They are sorted.
void keep_different(std::vector<FitSolution>& solutions) {
    std::vector<FitSolution> kept;
    for (FitSolution& s : solutions)
        if (kept.empty() || (kept.size() < 3 && s.cost > kept.back().cost * (1. + 1e-4)))
            kept.push_back(std::move(s));
    solutions = std::move(kept);
}

}  // namespace

std::vector<double> spread(const std::vector<Unknown>& unknowns, int bands,
                           const std::vector<double>& start) {
    std::vector<double> x;
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        x.insert(x.end(), std::size_t(unknowns[u].colour ? bands : 1), start[u]);
    return x;
}

std::vector<Unknown> active_unknowns(const FitProblem& fit, const TargetSamples& samples,
                                     FitMetric metric) {
    std::vector<bool> active(fit.unknowns.size());
    const FitResiduals trial(fit, samples, metric);
    for (const auto& start : plan_starts(fit.unknowns))
        trial.note_active(spread(fit.unknowns, int(fit.bands.size()), start).data(), active);
    std::vector<Unknown> kept;
    for (std::size_t u = 0; u < fit.unknowns.size(); ++u)
        if (active[u]) kept.push_back(fit.unknowns[u]);
    return kept;
}

double cost_at(const FitProblem& fit, const std::vector<double>& x, const TargetSamples& samples,
               FitMetric metric) {
    const FitResiduals all(fit, samples, metric);
    std::vector<double> residuals(std::size_t(all.num_residuals()));
    const double* at = x.data();
    if (!all.Evaluate(&at, residuals.data(), nullptr)) return infinite;
    double sum = 0.;
    for (double r : residuals) sum += r * r;
    return 0.5 * sum;
}

FitSolution solve_from(const FitProblem& fit, std::vector<std::vector<double>> starts,
                       const std::vector<int>& held, const TargetSamples& samples,
                       const TargetSamples& few, const FitOptions& options) {
    const auto better = [](const FitSolution& a, const FitSolution& b) { return a.cost < b.cost; };
    std::vector<FitSolution> solutions(starts.size()), apart(starts.size());
    const Task coarse{fit, few, FitMetric::log, options.stop};
    tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
        if (!held.empty()) {
            apart[i] = solve(coarse, starts[i], 15, held);
            starts[i] = apart[i].x;
        }
        solutions[i] = solve(coarse, starts[i], 15);
    });
    // The best of those that leave `held` as it is.
    const FitSolution alone = *std::min_element(apart.begin(), apart.end(), better);
    std::stable_sort(solutions.begin(), solutions.end(), better);
    if (!(solutions.front().cost < infinite))
        throw RunError(
            fmt::format("{} cannot be fitted: its values are not finite", fit.model.name));
    keep_different(solutions);
    const Task fine{fit, samples, options.metric, options.stop};
    // Few pairs may lead astray what all of them have found before.
    if (alone.cost < infinite)
        solutions.push_back(solve(fine, alone.x, options.most_iterations, held));
    tbb::parallel_for(std::size_t{0}, solutions.size(), [&](std::size_t i) {
        solutions[i] = solve(fine, solutions[i].x, options.most_iterations);
    });
    return polished(fine, *std::min_element(solutions.begin(), solutions.end(), better),
                    options.most_iterations);
}

}  // namespace nacre
