// nacre check: models against reference values and against their own claims.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/measured_page.h"
#include "apps/cli/number_option.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/reflectance/check.h"
#include "nacre/reflectance/registry.h"
#include "nacre/text/whole_file.h"
#include "nacre/vectors/check.h"

namespace nacre::cli {

namespace {

using nlohmann::json;

struct CheckArguments {
    std::string model, vectors;
    std::uint64_t seed = 1;
    int samples = 40000, random_sets = CheckOptions().random_sets;
};

json parse_vectors(const std::string& path) {
    const auto text = read_whole_file(path);
    if (!text) throw InputError(fmt::format("cannot read '{}'", path));
    try {
        return json::parse(*text);
    } catch (const json::exception& error) {
        throw InputError(fmt::format("'{}' is not JSON: {}", path, error.what()));
    }
}

void print_reflectance(const VectorGroup& g) {
    fmt::print("{:<24} {:<30} {:>4}  {:<10.3g}{}\n", g.name, g.who, g.count, g.deviation,
               g.good ? "" : " WRONG at " + g.worst);
}

void print_scattering(const VectorGroup& g) {
    constexpr const char* units[] = {"relative", "absolute", "standard errors"};
    fmt::print("{:<26} {:>5}  {:<18.3g} {:<10.3g} {}{}\n", g.name, g.count, g.deviation,
               g.tolerance, units[int(g.measure)], g.good ? "" : "  WRONG at " + g.worst);
}

int check_file(const std::string& path) {
    const json all = parse_vectors(path);
    const bool reflectance = kind_of_vectors(all, path) == VectorFile::reflectance;
    if (reflectance)
        fmt::print("{:<24} {:<30} {:>4}  {}\n", "group", "answered by", "n",
                   "largest relative deviation");
    else
        fmt::print("{:<26} {:>5}  {:<18} {:<10} {}\n", "group", "n", "largest deviation",
                   "tolerance", "in");
    const VectorReport report =
        check_vectors(all, path, reflectance ? print_reflectance : print_scattering);
    if (!report.not_covered.empty())
        fmt::print("\nnot covered: {}\n", fmt::join(report.not_covered, ", "));
    return report.good() ? success : failure;
}

/// Tells of a model that takes long.
std::vector<CheckOutcome> check_model_aloud(const Evaluator& evaluator,
                                            const CheckOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const StatusLine line(
        false,
        [&](bool) {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            return fmt::format("checking {}, {}", evaluator.description().name,
                               format_seconds(passed.count()));
        },
        3.);
    return check_model(evaluator, options);
}

int check_models(const CheckArguments& o) {
    std::vector<const ModelDescription*> chosen;
    if (o.model == "all")
        chosen.assign(models().begin(), models().end());
    else
        chosen = {&find_evaluator(o.model).description()};
    bool good = true;
    const auto report = [&](bool passed, const std::string& name, const std::string& detail) {
        fmt::print("{:<5} {:<44} {}\n", passed ? "ok" : "WRONG", name, detail);
        good = good && passed;
    };
    for (const ModelDescription* m : chosen) {
        const Evaluator& evaluator = find_evaluator(m->name);
        for (const VectorGroup& g : check_built_in_vectors(evaluator))
            report(g.good, fmt::format("{}: vectors {}", m->name, g.name),
                   fmt::format("largest relative deviation {:.2g}", g.deviation));
        CheckOptions options;
        options.seed = o.seed;
        options.samples = o.samples;
        options.random_sets = o.random_sets;
        for (const CheckOutcome& c : check_model_aloud(evaluator, options))
            report(c.passed, c.name, c.detail);
    }
    return good ? success : failure;
}

int run(const CheckArguments& o) {
    if (o.model.empty() == o.vectors.empty())
        throw InputError("give the name of a model, 'all', or --vectors FILE");
    if (o.model.empty()) return check_file(o.vectors);
    refuse_data_as_model(o.model, "audit");
    return check_models(o);
}

}  // namespace

Action set_up_check(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<CheckArguments>();
    app.add_option("model", o->model, "a reflectance model, or all");
    app.add_option("--vectors", o->vectors,
                   "JSON of reference vectors, of reflectance (exit code 1 beyond 1e-6) or "
                   "scattering (beyond the "
                   "tolerance of a group): largest deviation per group");
    add_seed(app, o->seed, "of the samplers' random numbers (1)");
    add_whole(app, "--samples", o->samples, 1000, 100'000'000, "per chi-square test (40000)");
    add_whole(app, "--random", o->random_sets, 0, 100000,
              fmt::format("tries so many sets of random parameters, near grazing too, for each "
                          "claim; 0: none ({})",
                          CheckOptions().random_sets));
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
