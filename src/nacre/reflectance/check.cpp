#include "nacre/reflectance/check.h"

#include <tbb/parallel_for.h>

#include "nacre/math/random.h"
#include "nacre/math/statistics.h"
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/check_random.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;
constexpr double incidences[] = {0., 30., 60., 80.};

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
/// Light at an angle of incidence, at an azimuth that no symmetry of a model favours.
Vec3d incident(double degrees) { return direction(degrees * degree, 0.4); }

/// One behaviour of a model at one of its examples.
struct Case {
    AnyModel model;
    std::string settings;
};

struct Verdict {
    bool passed = true;
    std::string detail;
    /// Keeps the first failure, else the last thing said.
    void say(bool ok, std::string what) {
        if (!passed) return;
        passed = ok;
        detail = std::move(what);
    }
};

struct Fit {
    double p = 1.;      ///< probability of a worse fit by chance
    double mass = 0.;   ///< of the density over the hemisphere
    double drawn = 0.;  ///< share of samples above the horizon
};

Fit fit_of_sampler(const AnyModel& model, const Vec3d& wo, const CheckOptions& options,
                   std::uint64_t stream) {
    constexpr int rows = 16, columns = 16;
    const Evaluator& e = model.evaluator();
    const ValuesD exact = model.values_double(550.);
    const ValuesS values = model.values(Wavelengths::at(Spectral(550.f)));
    const double dt = 0.5 * std::numbers::pi / rows, dp = 2. * std::numbers::pi / columns;
    std::vector<double> expected(rows * columns), found(rows * columns);
    Fit fit;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double mass =
                integrate_cell([&](const Vec3d& wi) { return e.pdf(exact, wi, wo); }, r * dt,
                               (r + 1) * dt, c * dp, (c + 1) * dp, 1e-7);
            fit.mass += mass;
            expected[r * columns + c] = mass * options.samples;
        }
    Random random(stream_key(options.seed, stream));
    int lost = 0;
    for (int i = 0; i < options.samples; ++i) {
        const float u1 = random.next();
        const Vec3f w = e.sample(values, Vec3f(wo), u1, random.next2());
        if (!(w.z > 0.f)) {
            ++lost;
            continue;
        }
        const double theta = std::atan2(std::hypot(w.x, w.y), w.z);
        double phi = std::atan2(w.y, w.x);
        if (phi < 0.) phi += 2. * std::numbers::pi;
        const int r = std::min(int(theta / dt), rows - 1), c = std::min(int(phi / dp), columns - 1);
        found[r * columns + c] += 1.;
    }
    fit.drawn = 1. - double(lost) / options.samples;
    expected.push_back(std::max(0., 1. - fit.mass) * options.samples);
    found.push_back(lost);

    double statistic = 0., pooled_expected = 0., pooled_found = 0.;
    int terms = 0;
    const auto add = [&](double x, double n) {
        statistic += (n - x) * (n - x) / x;
        ++terms;
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] >= 5.) {
            add(expected[i], found[i]);
        } else {
            pooled_expected += expected[i];
            pooled_found += found[i];
        }
    }
    if (pooled_expected >= 1.)
        add(pooled_expected, pooled_found);
    else if (pooled_found > 12.)  // where at most one is expected
        fit.p = 0.;
    if (terms > 1) fit.p = std::min(fit.p, chi_square_probability(statistic, terms - 1));
    return fit;
}

Verdict check_sampling(const std::vector<Case>& cases, const CheckOptions& options, int tests,
                       std::uint64_t stream) {
    Verdict verdict;
    // Sidak: all tests of the model together fail by chance with the probability asked for.
    const double least = 1. - std::pow(1. - options.significance, 1. / tests);
    double smallest = 1.;
    for (const Case& c : cases)
        for (double angle : incidences) {
            const Fit fit = fit_of_sampler(c.model, incident(angle), options, ++stream);
            const auto where = fmt::format("at {} degrees, {}", angle, c.settings);
            const double sigma =
                std::sqrt(std::max(fit.mass * (1. - fit.mass), 1e-9) / options.samples);
            verdict.say(fit.mass <= 1. + 1e-3,
                        fmt::format("the density integrates to {:.5f} {}", fit.mass, where));
            verdict.say(std::abs(fit.mass - fit.drawn) <= 1e-3 + 5. * sigma,
                        fmt::format("the density holds {:.5f}, but {:.5f} are drawn {}", fit.mass,
                                    fit.drawn, where));
            smallest = std::min(smallest, fit.p);
            verdict.say(fit.p >= least, fmt::format("chi-square p = {:.2g} {}", fit.p, where));
        }
    if (verdict.passed)
        verdict.detail = fmt::format("smallest p of {} chi-square tests {:.2g}",
                                     cases.size() * std::size(incidences), smallest);
    return verdict;
}

double whole_albedo(const AnyModel& model, const Vec3d& wi, double& error) {
    const Albedo a = directional_albedo(model, wi, 550., 1e-7);
    error = a.error;
    return a.value + model.mirror(wi);
}

Verdict check_furnace(const std::vector<Case>& cases, const Behaviour& behaviour,
                      const Evaluator& evaluator) {
    Verdict verdict;
    double largest = 0., error = 0.;
    for (const Case& c : cases) {
        const ValuesD values = c.model.values_double(550.);
        Random random(stream_key(7, 1));
        for (int i = 0; i < 2000; ++i) {
            const Vec3d wi = direction(std::acos(random.next()), 6.2831853 * random.next());
            const Vec3d wo = direction(std::acos(random.next()), 6.2831853 * random.next());
            const double f = evaluator.eval(values, wi, wo);
            verdict.say(std::isfinite(f) && f >= 0.,
                        fmt::format("a value of {}, {}", f, c.settings));
        }
        for (double angle : {0., 30., 60., 80., 89., 89.9}) {
            const double a = whole_albedo(c.model, incident(angle), error);
            largest = std::max(largest, a);
            const auto text = fmt::format("albedo {:.6f} at {} degrees, {}", a, angle, c.settings);
            verdict.say(a > 0., text);
            if (behaviour.energy == Energy::conserves) verdict.say(a <= 1. + 1e-6 + error, text);
        }
    }
    if (behaviour.energy == Energy::exceeds) {
        Settings s = parse_settings(behaviour.options);
        for (Setting& w : parse_settings(behaviour.witness)) s.push_back(std::move(w));
        const double a =
            whole_albedo(AnyModel(evaluator, s), incident(behaviour.witness_degrees), error);
        verdict.say(a > 1. + error && (behaviour.at_most == 0. || a <= behaviour.at_most + error),
                    fmt::format("albedo {:.6f} at {} degrees, {}; said to exceed 1{}", a,
                                behaviour.witness_degrees, behaviour.witness,
                                behaviour.at_most > 0.
                                    ? fmt::format(" and to stay below {:g}", behaviour.at_most)
                                    : ""));
    } else if (verdict.passed) {
        verdict.detail = fmt::format("largest albedo {:.6f}", largest);
    }
    return verdict;
}

Verdict check_reciprocity(const std::vector<Case>& cases, bool claimed) {
    double largest = 0.;
    Random random(stream_key(11, 2));
    for (const Case& c : cases)
        for (int i = 0; i < 200; ++i) {
            const double z = 0.02 + 0.96 * random.next(), phi = 6.2831853 * random.next();
            const Vec3d wi = direction(std::acos(z), phi);
            // Half of the pairs close to the mirror direction, where highlights are.
            Vec3d wo = direction(std::acos(0.02 + 0.96 * random.next()), 6.2831853 * random.next());
            if (i % 2) {
                const Vec3d h = direction(0.1 * random.next(), 6.2831853 * random.next());
                wo = reflect(wi, h);
                if (!(wo.z > 0.01)) continue;
            }
            const double there = c.model.eval(wi, wo), back = c.model.eval(wo, wi);
            const double size = std::max(std::abs(there), std::abs(back));
            // Below this lie the far tails of lobes, where the last digit of an exponent decides.
            if (size > 1e-12) largest = std::max(largest, std::abs(there - back) / size);
        }
    Verdict verdict;
    verdict.say(claimed ? largest <= 1e-9 : largest > 1e-2,
                fmt::format("largest relative difference {:.2g}; said {}to be reciprocal", largest,
                            claimed ? "" : "not "));
    return verdict;
}

Verdict check_horizon(const std::vector<Case>& cases) {
    Verdict verdict;
    verdict.say(true, "0 below the horizon");
    for (const Case& c : cases)
        for (double angle : {0., 45., 89.}) {
            const Vec3d up = incident(angle), other = direction(1., 3.3);
            const Vec3d down{other.x, other.y, -other.z}, level{1., 0., 0.};
            for (const auto& [a, b] :
                 {std::pair{up, down}, {down, up}, {down, down}, {up, level}, {level, up}})
                verdict.say(c.model.eval(a, b) == 0. && c.model.pdf(a, b) == 0.,
                            c.model.eval(a, b) == 0. && c.model.pdf(a, b) == 0.
                                ? "0 below the horizon"
                                : fmt::format("not 0 below the horizon, {}", c.settings));
        }
    return verdict;
}

std::optional<Verdict> check_albedo(const std::vector<Case>& cases) {
    Verdict verdict;
    double largest = 0.;
    for (const Case& c : cases)
        for (double angle : incidences) {
            const auto closed = c.model.albedo(incident(angle));
            if (!closed) return std::nullopt;
            const Albedo a = directional_albedo(c.model, incident(angle), 550., 1e-8);
            const double off = std::abs(*closed - a.value);
            largest = std::max(largest, off);
            verdict.say(off <= 1e-6 + 2. * a.error,
                        fmt::format("closed form {:.8f}, quadrature {:.8f} at {} degrees, {}",
                                    *closed, a.value, angle, c.settings));
        }
    if (verdict.passed)
        verdict.detail = fmt::format("closed form within {:.2g} of quadrature", largest);
    return verdict;
}

/// All checks of one behaviour; `tests` is how many chi-square tests the model faces.
std::vector<CheckOutcome> check_behaviour(const Evaluator& evaluator, const Behaviour& b,
                                          const CheckOptions& options, int tests,
                                          std::uint64_t stream) {
    std::vector<Case> cases;
    for (std::string_view example : b.examples) {
        const std::string text =
            b.options.empty() ? std::string(example) : fmt::format("{} {}", b.options, example);
        cases.push_back({AnyModel(evaluator, parse_settings(text)), std::string(example)});
    }
    const std::string claim = claim_text(b), model(evaluator.description().name);
    const std::string name = claim.empty() ? model : fmt::format("{} {}", model, claim);
    std::vector<CheckOutcome> outcomes;
    const auto add = [&](const char* what, const Verdict& v) {
        outcomes.push_back({fmt::format("{}: {}", name, what), v.passed, v.detail});
    };
    add("sampling", check_sampling(cases, options, tests, stream));
    add("furnace", check_furnace(cases, b, evaluator));
    add("reciprocity", check_reciprocity(cases, b.reciprocal));
    add("horizon", check_horizon(cases));
    if (const auto v = check_albedo(cases)) add("albedo", *v);
    if (options.random_sets <= 0) return outcomes;
    CheckOutcome tried = check_random_parameters(evaluator, b, options);
    tried.name = fmt::format("{}: random parameters", name);
    outcomes.push_back(std::move(tried));
    return outcomes;
}

}  // namespace

std::vector<CheckOutcome> check_model(const Evaluator& evaluator, const CheckOptions& options) {
    const std::vector<Behaviour>& behaviours = evaluator.description().behaviours;
    int tests = 0;
    for (const Behaviour& b : behaviours) tests += int(b.examples.size() * std::size(incidences));
    std::vector<std::vector<CheckOutcome>> of(behaviours.size());
    tbb::parallel_for(std::size_t(0), of.size(), [&](std::size_t i) {
        of[i] = check_behaviour(evaluator, behaviours[i], options, tests, 1000 * i);
    });
    std::vector<CheckOutcome> outcomes;
    for (auto& o : of) std::move(o.begin(), o.end(), std::back_inserter(outcomes));
    return outcomes;
}

}  // namespace nacre
