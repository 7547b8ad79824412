#include "nacre/measured/fit.h"

#include <ceres/iteration_callback.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <chrono>

#include "nacre/math/error.h"
#include "nacre/measured/fit_residuals.h"

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

struct Solution {
    std::vector<double> x;
    double cost = infinite;
    int iterations = 0;
    bool converged = false;
};

/// From x within the bounds. What `held` lists stays as it is.
Solution solve(FitResiduals& residuals, const std::vector<Unknown>& unknowns, std::vector<double> x,
               int iterations, const std::atomic<bool>* stop, const std::vector<int>& held = {}) {
    ceres::Problem::Options ours;
    ours.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ours);
    problem.AddParameterBlock(x.data(), int(x.size()));
    problem.AddResidualBlock(&residuals, nullptr, x.data());
    if (!held.empty())
        problem.SetManifold(x.data(), new ceres::SubsetManifold(int(x.size()), held));
    const Layout layout(unknowns);
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        for (int k = 0; k < (unknowns[u].colour ? 3 : 1); ++k) {
            problem.SetParameterLowerBound(x.data(), layout.first[u] + k, unknowns[u].low);
            if (unknowns[u].high < infinite)
                problem.SetParameterUpperBound(x.data(), layout.first[u] + k, unknowns[u].high);
        }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-9;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    StopWhenAsked callback(stop);
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return {std::move(x)};
    return {std::move(x), summary.final_cost, int(summary.iterations.size()),
            summary.termination_type == ceres::CONVERGENCE};
}

/// Positions in x of what stands at the end of its range.
std::vector<int> at_ends(const std::vector<Unknown>& unknowns, const std::vector<double>& x) {
    std::vector<int> found;
    const Layout layout(unknowns);
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        for (int k = layout.first[u]; k < layout.first[u] + (unknowns[u].colour ? 3 : 1); ++k)
            if (x[k] <= unknowns[u].low || x[k] >= unknowns[u].high) found.push_back(k);
    return found;
}

/// Goes on from a solution. The solver's steps end at the bounds that they meet, which can be a
/// crawl along them; so what has reached one is held while the others move, and let go again.
Solution polished(FitResiduals& residuals, const std::vector<Unknown>& unknowns, Solution best,
                  int iterations, const std::atomic<bool>* stop) {
    for (int round = 0; round < 3 && best.cost < infinite && !(stop && *stop); ++round) {
        const std::vector<int> held = at_ends(unknowns, best.x);
        if (held.empty() || held.size() == best.x.size()) break;
        const double before = best.cost;
        for (const std::vector<int>& h : {held, std::vector<int>{}}) {
            Solution next = solve(residuals, unknowns, best.x, iterations, stop, h);
            next.iterations += best.iterations;
            if (next.cost < best.cost) best = std::move(next);
        }
        if (best.cost > before * (1. - 1e-5)) break;
    }
    return best;
}

std::vector<double> spread(const std::vector<Unknown>& unknowns, const std::vector<double>& start) {
    std::vector<double> x;
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        x.insert(x.end(), unknowns[u].colour ? 3 : 1, start[u]);
    return x;
}

/// Those that change anything near some start.
std::vector<Unknown> active_unknowns(const ModelDescription& model,
                                     const std::array<ValuesD, 3>& fixed,
                                     const std::vector<Unknown>& unknowns,
                                     const TargetSamples& samples, FitMetric metric) {
    std::vector<bool> active(unknowns.size());
    const FitResiduals trial(model, fixed, unknowns, samples, metric);
    for (const auto& start : plan_starts(unknowns))
        trial.note_active(spread(unknowns, start).data(), active);
    std::vector<Unknown> kept;
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        if (active[u]) kept.push_back(unknowns[u]);
    return kept;
}

/// Drops solutions that cost as much as a better one, to one part in ten thousand: the same valley.
/// Keeps at most three. They are sorted.
void keep_different(std::vector<Solution>& solutions) {
    std::vector<Solution> kept;
    for (Solution& s : solutions)
        if (kept.empty() || (kept.size() < 3 && s.cost > kept.back().cost * (1. + 1e-4)))
            kept.push_back(std::move(s));
    solutions = std::move(kept);
}

/// A few steps from every start, then the best ones to their ends. The first steps go by the
/// logarithmic metric, whatever is asked for: highlights leave it smooth.
Solution best_solution(const ModelDescription& model, const std::array<ValuesD, 3>& fixed,
                       const std::vector<Unknown>& unknowns, const TargetSamples& samples,
                       const TargetSamples& few, const FitOptions& options) {
    const auto better = [](const Solution& a, const Solution& b) { return a.cost < b.cost; };
    std::vector<Solution> solutions;
    FitResiduals coarse(model, fixed, unknowns, few, FitMetric::log);
    for (const auto& start : plan_starts(unknowns))
        solutions.push_back(solve(coarse, unknowns, spread(unknowns, start), 15, options.stop));
    std::stable_sort(solutions.begin(), solutions.end(), better);
    if (!(solutions.front().cost < infinite))
        throw RunError(fmt::format("{} cannot be fitted: its values are not finite", model.name));
    keep_different(solutions);
    FitResiduals fine(model, fixed, unknowns, samples, options.metric);
    for (Solution& s : solutions)
        s = solve(fine, unknowns, s.x, options.most_iterations, options.stop);
    return polished(fine, unknowns, *std::min_element(solutions.begin(), solutions.end(), better),
                    options.most_iterations, options.stop);
}

/// To six digits, as it is printed, so that what is measured is what is printed; towards the inside
/// of the range.
double rounded(double x, const Unknown& unknown) {
    double r = std::stod(fmt::format("{:.6g}", x));
    const double digit = std::pow(10., std::floor(std::log10(std::abs(x))) - 5.);
    if (r > unknown.high) r = std::stod(fmt::format("{:.6g}", r - digit));
    if (r < unknown.low) r = std::stod(fmt::format("{:.6g}", r + digit));
    return r;
}

/// Puts what comes within a millionth of an end of its range there; whether any does.
bool snap_to_limits(const Unknown& unknown, double* x) {
    bool any = false;
    for (int k = 0; k < (unknown.colour ? 3 : 1); ++k)
        for (double end : {unknown.low, unknown.high})
            if (std::abs(x[k] - end) <= 1e-6 * std::max(1., std::abs(x[k]))) {
                x[k] = end;
                any = true;
            }
    return any;
}

SettingValue fitted_value(const Unknown& unknown, const double* x) {
    double r[3];
    for (int k = 0; k < (unknown.colour ? 3 : 1); ++k) r[k] = rounded(x[k], unknown);
    if (!unknown.colour || (r[1] == r[0] && r[2] == r[0])) return r[0];
    return Vec3f(float(r[0]), float(r[1]), float(r[2]));
}

}  // namespace

ModelFit fit_model(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
                   const FitOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const ModelDescription& model = evaluator.description();
    const std::array<ValuesD, 3> fixed =
        band_values(AnyModel(evaluator, given, Bounds::ranges_only));
    const TargetSamples few = samples.thinned(8);
    const std::vector<Unknown> unknowns = active_unknowns(
        model, fixed, plan_unknowns(model, given, samples.isotropic), few, options.metric);
    Solution best{{}, 0., 0, true};
    if (!unknowns.empty()) best = best_solution(model, fixed, unknowns, samples, few, options);

    Settings settings = given;
    std::vector<std::string> at_limit;
    const Layout layout(unknowns);
    for (std::size_t u = 0; u < unknowns.size(); ++u) {
        const Unknown& unknown = unknowns[u];
        double* x = &best.x[layout.first[u]];
        if (snap_to_limits(unknown, x)) at_limit.push_back(unknown.name);
        const SettingValue value = fitted_value(unknown, x);
        // Lafortune's cx and cy move together, but no name means both.
        if (find_parameters(model.name, model.parameters, unknown.name).size() ==
            unknown.parameters.size())
            settings.push_back({unknown.name, value});
        else
            for (int i : unknown.parameters)
                settings.push_back({std::string(model.parameters[i].name), value});
    }
    const AnyModel fitted(evaluator, settings, Bounds::ranges_only);
    ModelFit fit{.settings = settings,
                 .text = settings_text(settings),
                 .model = fitted,
                 .errors = errors_of(fitted, samples),
                 .iterations = best.iterations,
                 .converged = best.converged && !(options.stop && *options.stop),
                 .at_limit = at_limit,
                 .beyond = {}};
    try {
        AnyModel(evaluator, settings, Bounds::enforced);
    } catch (const InputError& e) {
        fit.beyond = e.what();
    }
    fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return fit;
}

}  // namespace nacre
