#include "nacre/measured/fit.h"

#include <chrono>
#include <numeric>

#include "nacre/math/error.h"
#include "nacre/measured/fit_solver.h"

namespace nacre {
namespace {

/// To six digits, as it is printed, so that what is measured is what is printed; towards the inside
/// of the range.
double rounded(double x, const Unknown& unknown) {
    double r = std::stod(fmt::format("{:.6g}", x));
    const double digit = std::pow(10., std::floor(std::log10(std::abs(x))) - 5.);
    if (r > unknown.high) r = std::stod(fmt::format("{:.6g}", r - digit));
    if (r < unknown.low) r = std::stod(fmt::format("{:.6g}", r + digit));
    return r;
}

/// Puts what comes within a millionth of an end of its range there, unless that makes the fit worse
/// (a weight may be small and its lobe high); of each unknown whether any of it stands at an end.
std::vector<bool> snap_to_limits(const FitProblem& fit, const TargetSamples& samples,
                                 FitMetric metric, std::vector<double>& x) {
    const Layout layout = fit.layout();
    std::vector<bool> snapped(fit.unknowns.size());
    for (std::size_t u = 0; u < fit.unknowns.size(); ++u)
        for (int k = layout.first[u]; k < layout.first[u] + layout.count[u]; ++k)
            for (double end : {fit.unknowns[u].low, fit.unknowns[u].high}) {
                if (!(std::abs(x[k] - end) <= 1e-6 * std::max(1., std::abs(x[k])))) continue;
                std::vector<double> at_end = x;
                at_end[k] = end;
                if (x[k] != end && cost_at(fit, at_end, samples, metric) >
                                       cost_at(fit, x, samples, metric) * (1. + 1e-4) + 1e-10)
                    continue;
                x[k] = end;
                snapped[u] = true;
            }
    return snapped;
}

SettingValue fitted_value(const Unknown& unknown, std::span<const double> x) {
    double r[3];
    for (std::size_t k = 0; k < x.size(); ++k) r[k] = rounded(x[k], unknown);
    if (x.size() == 1 || (r[1] == r[0] && r[2] == r[0])) return r[0];
    return Vec3f(float(r[0]), float(r[1]), float(r[2]));
}

constexpr std::string_view matte = "kd";

bool has_matte(const ModelDescription& model) {
    return std::ranges::any_of(model.parameters,
                               [](const Parameter& p) { return p.name == matte; });
}

bool sets_matte(const ModelDescription& model, const Setting& setting) {
    const auto found = find_parameters(model.name, model.parameters, setting.name);
    return model.parameters[std::size_t(found.front())].name == matte;
}

/// What a lobe is given: further ones have no matte part.
Settings given_to_lobe(const ModelDescription& model, const Settings& given, int lobe) {
    if (lobe == 0) return given;
    Settings r;
    for (const Setting& s : given)
        if (!sets_matte(model, s)) r.push_back(s);
    r.push_back({std::string(matte), 0.});
    return r;
}

struct Lobe {
    Settings fitted;                    ///< without the matte part
    std::vector<std::string> at_limit;  ///< names of parameters
    double width = 0.;                  ///< mean theta_h, radians
};

/// Lobes of some bands as they were found.
struct BandsFit {
    std::vector<Lobe> lobes;
    Settings fitted_matte;
    bool matte_at_limit = false;
    int numbers = 0, iterations = 0;
    bool converged = true;
};

/// One lobe more each time, from the best sum of those before.
BandsFit fit_bands(const Evaluator& evaluator, const Settings& given, std::vector<int> bands,
                   const TargetSamples& samples, const TargetSamples& few,
                   const FitOptions& options) {
    const ModelDescription& model = evaluator.description();
    FitProblem fit{model, bands};
    FitSolution best{{}, 0., 0, true};
    for (int lobe = 0; lobe < options.lobes; ++lobe) {
        const Settings fixed = given_to_lobe(model, given, lobe);
        fit.lobes.push_back(band_values(AnyModel(evaluator, fixed, Bounds::ranges_only)));
        const FitProblem alone{
            model, bands, {fit.lobes.back()}, plan_unknowns(model, fixed, samples.isotropic)};
        std::vector<Unknown> active = active_unknowns(alone, few, options.metric);
        if (lobe > 0 && active.empty())
            throw InputError(fmt::format(
                "{}: nothing is left to fit in a further lobe; ask for one lobe", model.name));
        std::vector<std::vector<double>> starts;
        for (const auto& start : plan_starts(active)) {
            starts.push_back(best.x);
            const std::vector<double> own = spread(active, int(bands.size()), start);
            starts.back().insert(starts.back().end(), own.begin(), own.end());
        }
        std::vector<int> held(best.x.size());
        std::iota(held.begin(), held.end(), 0);
        for (Unknown& u : active) {
            u.lobe = lobe;
            fit.unknowns.push_back(std::move(u));
        }
        if (!fit.unknowns.empty()) best = solve_from(fit, starts, held, samples, few, options);
    }

    BandsFit r{.lobes = std::vector<Lobe>(std::size_t(options.lobes)),
               .fitted_matte = {},
               .numbers = int(best.x.size()),
               .iterations = best.iterations,
               .converged = best.converged};
    const Layout layout = fit.layout();
    const std::vector<bool> at_end = snap_to_limits(fit, samples, options.metric, best.x);
    for (std::size_t u = 0; u < fit.unknowns.size(); ++u) {
        const Unknown& unknown = fit.unknowns[u];
        const std::span<const double> x(&best.x[std::size_t(layout.first[u])],
                                        std::size_t(layout.count[u]));
        const SettingValue value = fitted_value(unknown, x);
        Lobe& lobe = r.lobes[std::size_t(unknown.lobe)];
        if (unknown.name == matte) {
            r.fitted_matte.push_back({unknown.name, value});
            r.matte_at_limit = at_end[u];
            continue;
        }
        if (at_end[u]) lobe.at_limit.push_back(unknown.name);
        // Lafortune's cx and cy move together, but no name means both.
        if (find_parameters(model.name, model.parameters, unknown.name).size() ==
            unknown.parameters.size())
            lobe.fitted.push_back({unknown.name, value});
        else
            for (int i : unknown.parameters)
                lobe.fitted.push_back({std::string(model.parameters[i].name), value});
    }
    return r;
}

/// The mean angle of half vectors to the normal, by the light that comes out.
double width_of(const AnyModel& lobe, const TargetSamples& samples) {
    const ModelTarget target(lobe, {});
    double sum = 0., weight = 0.;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Vec3d f = *target.value(samples.wi[i], samples.wo[i]);
        const double w = samples.weight[i] * samples.wi[i].z * (f.x + f.y + f.z);
        sum += w * std::acos(std::min(1., normalize(samples.wi[i] + samples.wo[i]).z));
        weight += w;
    }
    return weight > 0. ? sum / weight : 0.;
}

/// The widest lobe first.
void sort_lobes(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
                std::vector<Lobe>& lobes) {
    if (lobes.size() < 2) return;
    for (Lobe& lobe : lobes) {
        Settings settings = given_to_lobe(evaluator.description(), given, 1);
        settings.insert(settings.end(), lobe.fitted.begin(), lobe.fitted.end());
        lobe.width = width_of(AnyModel(evaluator, settings, Bounds::ranges_only), samples);
    }
    std::ranges::stable_sort(lobes, std::greater(), &Lobe::width);
}

/// What exceeds a bound, a sum over all lobes; empty if nothing does.
std::string what_exceeds(const ModelSum& sum) {
    const ModelDescription& model = sum.terms().front().model.description();
    try {
        for (const ModelTerm& t : sum.terms())
            AnyModel(t.model.evaluator(), t.settings, Bounds::enforced);
        for (const SumBound& bound : model.bounds) {
            Vec3d total{};
            for (const ModelTerm& t : sum.terms())
                for (int c = 0; c < 3; ++c)
                    for (std::string_view name : bound.parameters)
                        for (int i : find_parameters(model.name, model.parameters, name))
                            total[c] += t.weight[c] * band_values(t.model)[c].scalar[i];
            check_sum(model, bound, std::max({total.x, total.y, total.z}));
        }
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

}  // namespace

SumFit fit_sum(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
               const FitOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const ModelDescription& model = evaluator.description();
    if (options.lobes > 1 && !has_matte(model))
        throw InputError(fmt::format(
            "{} has no diffuse albedo kd apart from its highlight: it has one lobe", model.name));
    const TargetSamples few = samples.thinned(std::size_t(options.stride));
    std::vector<ModelTerm> terms;
    std::vector<std::string> at_limit;
    int numbers = 0, iterations = 0;
    bool converged = !(options.stop && *options.stop);
    const std::vector<std::vector<int>> groups = options.by_channel
                                                     ? std::vector<std::vector<int>>{{0}, {1}, {2}}
                                                     : std::vector<std::vector<int>>{{0, 1, 2}};
    for (const std::vector<int>& bands : groups) {
        BandsFit f = fit_bands(evaluator, given, bands, samples, few, options);
        sort_lobes(evaluator, given, samples, f.lobes);
        constexpr const char* names[] = {" (red)", " (green)", " (blue)"};
        const std::string channel = options.by_channel ? names[bands.front()] : "";
        if (f.matte_at_limit) at_limit.push_back(std::string(matte) + channel);
        for (int l = 0; l < options.lobes; ++l) {
            const Lobe& lobe = f.lobes[std::size_t(l)];
            Settings settings = given_to_lobe(model, given, l);
            if (l == 0)
                settings.insert(settings.end(), f.fitted_matte.begin(), f.fitted_matte.end());
            settings.insert(settings.end(), lobe.fitted.begin(), lobe.fitted.end());
            Vec3d weight{};
            for (int c : bands) weight[c] = 1.;
            terms.push_back({AnyModel(evaluator, settings, Bounds::ranges_only), settings, weight});
            for (const std::string& name : lobe.at_limit)
                at_limit.push_back(name + (l > 0 ? fmt::format(" of lobe {}", l + 1) : "") +
                                   channel);
        }
        numbers += f.numbers;
        iterations += f.iterations;
        converged = converged && f.converged;
    }
    SumFit fit{.sum = ModelSum(std::move(terms), std::string(model.name)),
               .errors = {},
               .numbers = numbers,
               .iterations = iterations,
               .converged = converged && !(options.stop && *options.stop),
               .at_limit = at_limit,
               .beyond = {}};
    fit.errors = errors_of(fit.sum, samples);
    fit.beyond = what_exceeds(fit.sum);
    fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return fit;
}

ModelFit fit_model(const Evaluator& evaluator, const Settings& given, const TargetSamples& samples,
                   const FitOptions& options) {
    FitOptions one = options;
    one.lobes = 1;
    one.by_channel = false;
    const SumFit fit = fit_sum(evaluator, given, samples, one);
    const ModelTerm& term = fit.sum.terms().front();
    return {.settings = term.settings,
            .text = settings_text(term.settings),
            .model = term.model,
            .errors = fit.errors,
            .seconds = fit.seconds,
            .iterations = fit.iterations,
            .converged = fit.converged,
            .at_limit = fit.at_limit,
            .beyond = fit.beyond};
}

}  // namespace nacre
