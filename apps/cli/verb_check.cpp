// nacre check: models against reference values and against their own claims.
#include <CLI/CLI.hpp>
#include <fstream>
#include <set>

#include "apps/cli/number_option.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/vector_file.h"
#include "apps/cli/vector_functions.h"
#include "apps/cli/vector_scattering.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/reflectance/check.h"

namespace nacre::cli {

extern const char* const built_in_vectors;  // vectors.cpp, made at build time

namespace {

using nlohmann::json;

/// Beyond this relative deviation, in double precision, a model is wrong.
constexpr double tolerance = 1e-6;

struct Options {
    std::string model, vectors;
    std::uint64_t seed = 1;
    int samples = 40000, random_sets = CheckOptions().random_sets;
};

struct GroupResult {
    int count = 0;
    double largest = 0.;
    std::string where;
};

GroupResult compare(const GroupModel& who, const json& group) {
    GroupResult result;
    for (const auto& v : group.at("vectors")) {
        const AnyModel model = model_of_vector(who, v.at("params"));
        const double value = answer(who, model, direction_of(v.at("wi")), direction_of(v.at("wo")));
        double deviation = relative_deviation(value, v.at("value").get<double>());
        if (!std::isfinite(deviation)) deviation = infinite;
        if (deviation >= result.largest) {
            result.largest = deviation;
            result.where = v.value("id", "");
        }
        ++result.count;
    }
    return result;
}

/// The same for functions; what they leave out of a vector's values is named in `omitted`.
GroupResult compare(const VectorFunction& answer, const json& group,
                    std::set<std::string>& omitted) {
    GroupResult result;
    for (const auto& v : group.at("vectors")) {
        const auto values = answer(v);
        const json expected = v.contains("values") ? v["values"] : json{{"value", v.at("value")}};
        for (const auto& [name, number] : expected.items()) {
            const auto found = values.find(name);
            if (found == values.end()) {
                omitted.insert(name);
                continue;
            }
            double deviation = relative_deviation(found->second, number.get<double>());
            // A quotient of rounded sums that should vanish (total reflection, Brewster's angle).
            if (number.get<double>() == 0. && std::abs(found->second) < 1e-12) deviation = 0.;
            if (!std::isfinite(deviation)) deviation = infinite;
            if (deviation >= result.largest) {
                result.largest = deviation;
                result.where = v.value("id", "") + " " + name;
            }
            ++result.count;
        }
    }
    return result;
}

void print_group(const std::string& name, std::string_view who, const GroupResult& r) {
    fmt::print("{:<24} {:<30} {:>4}  {:<10.3g}{}\n", name, who, r.count, r.largest,
               r.largest > tolerance ? " WRONG at " + r.where : "");
}

json parse_vectors(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("cannot read '{}'", path));
    try {
        return json::parse(file);
    } catch (const json::exception& error) {
        throw InputError(fmt::format("'{}' is not JSON: {}", path, error.what()));
    }
}

int check_vectors(const std::string& path) {
    const json all = parse_vectors(path);
    if (!all.contains("models") && is_scattering_file(all))
        return check_scattering(all, path) ? success : failure;
    if (!all.contains("models"))
        throw InputError(
            fmt::format("'{}' has neither \"models\", groups of reflectance vectors by name, nor a "
                        "known group of "
                        "scattering vectors",
                        path));
    fmt::print("{:<24} {:<30} {:>4}  {}\n", "group", "answered by", "n",
               "largest relative deviation");
    std::vector<std::string> missing;
    bool good = true;
    const auto check = [&](const std::string& name, const json& group) {
        const GroupModel who = model_of_group(name);
        const auto function = function_of_group(name);
        if (!who.evaluator && !function) {
            missing.push_back(name);
            return;
        }
        try {
            std::set<std::string> omitted;
            const GroupResult r =
                who.evaluator ? compare(who, group) : compare(function->answer, group, omitted);
            print_group(name, who.evaluator ? who.evaluator->description().name : function->who, r);
            for (const std::string& o : omitted) missing.push_back(name + "." + o);
            good = good && r.largest <= tolerance;
        } catch (const json::exception& error) {
            throw InputError(fmt::format("group '{}' of '{}': {}", name, path, error.what()));
        }
    };
    for (const char* kind : {"models", "scalars"})
        if (all.contains(kind))
            for (const auto& [name, group] : all[kind].items()) check(name, group);
    for (const char* name : {"merl", "svd"})
        if (all.contains(name)) missing.push_back(name);
    if (!missing.empty()) fmt::print("\nnot covered: {}\n", fmt::join(missing, ", "));
    return good ? success : failure;
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

int check_models(const Options& o) {
    std::vector<const ModelDescription*> chosen;
    if (o.model == "all")
        chosen = models();
    else
        chosen = {&find_evaluator(o.model).description()};
    const json vectors = json::parse(built_in_vectors);
    bool good = true;
    const auto report = [&](bool passed, const std::string& name, const std::string& detail) {
        fmt::print("{:<5} {:<44} {}\n", passed ? "ok" : "WRONG", name, detail);
        good = good && passed;
    };
    for (const ModelDescription* m : chosen) {
        const Evaluator& evaluator = find_evaluator(m->name);
        for (const ReferenceGroup& g : m->groups) {
            if (!vectors["models"].contains(g.name)) continue;
            const GroupResult r = compare({&evaluator, &g}, vectors["models"][std::string(g.name)]);
            report(r.largest <= std::max(g.tolerance, 1e-9),
                   fmt::format("{}: vectors {}", m->name, g.name),
                   fmt::format("largest relative deviation {:.2g}", r.largest));
        }
        CheckOptions options;
        options.seed = o.seed;
        options.samples = o.samples;
        options.random_sets = o.random_sets;
        for (const CheckOutcome& c : check_model_aloud(evaluator, options))
            report(c.passed, c.name, c.detail);
    }
    return good ? success : failure;
}

int run(const Options& o) {
    if (o.model.empty() == o.vectors.empty())
        throw InputError("give the name of a model, 'all', or --vectors FILE");
    return o.model.empty() ? check_vectors(o.vectors) : check_models(o);
}

}  // namespace

Action set_up_check(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<Options>();
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
