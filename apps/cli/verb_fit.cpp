// nacre fit: reflectance models fitted to a measured BRDF.
#include <CLI/CLI.hpp>
#include <cctype>
#include <nlohmann/json.hpp>

#include "apps/cli/fit_output.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/model_list.h"
#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/compare/model_comparison.h"
#include "nacre/math/error.h"
#include "nacre/render/threads.h"
#include "nacre/text/names.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct FitArguments {
    std::string target, models = "all", metric = "log", shape = "shared", held_out = "half";
    int lobes = 1, threads = 0;
    bool json = false, quiet = false;
    fs::path output;
};

/// One of some words, its position.
std::size_t word_among(const std::string& option, const std::string& kind, const std::string& word,
                       const std::vector<std::string>& known) {
    const auto found = std::ranges::find(known, word);
    if (found == known.end()) throw InputError(option + ": " + unknown_name(kind, word, known));
    return std::size_t(found - known.begin());
}

FitMetric metric_of(const FitArguments& o) {
    return FitMetric(word_among("--metric", "metric", o.metric, {"cosine", "log", "cuberoot"}));
}

/// All of the list, or those that are named.
std::vector<FittedModel> models_asked_for(const std::string& text) {
    std::vector<ModelSpec> specs;
    if (text == "all") {
        for (const ModelDescription* model : models())
            specs.push_back({std::string(model->name), {}});
    } else {
        specs = parse_models("--model", text);
        check_models(specs);
    }
    std::vector<FittedModel> r;
    for (ModelSpec& spec : specs) {
        std::string id = spec.name;
        if (!spec.settings.empty()) id += " " + settings_text(spec.settings);
        r.push_back(
            {.spec = std::move(spec), .id = std::move(id), .fit = {}, .held_out = {}, .why = {}});
    }
    return r;
}

struct FitData {
    TargetSamples fit;
    std::optional<TargetSamples> held_out;
};

FitData sample_halves(const Target& target, bool half) {
    if (!half) return {sample_target(target), {}};
    return {sample_target(target, {.nodes = FitGrid::Nodes::even}),
            sample_target(target, {.nodes = FitGrid::Nodes::odd})};
}

void fit_one(FittedModel& m, const FitData& data, const FitOptions& options, bool all) {
    try {
        m.fit = fit_sum(find_evaluator(m.spec.name), m.spec.settings, data.fit, options);
        if (data.held_out) m.held_out = errors_of(m.fit->sum, *data.held_out);
    } catch (const RunError& e) {
        m.why = e.what();
        m.failed = true;
    } catch (const InputError& e) {
        // Who asks for all models gets those that there are.
        if (!all) throw;
        m.why = e.what();
    }
}

void print_table(const Target& target, const std::vector<FittedModel>& fitted, const FitData& data,
                 const FitOptions& options) {
    fmt::print("{}: fitted to {} pairs of directions by the {} error", target.name(),
               data.fit.size(), name_of(options.metric));
    if (data.held_out)
        fmt::print(", tried on {} others (held out: every second node of the grid)",
                   data.held_out->size());
    const std::size_t missing = data.fit.missing + (data.held_out ? data.held_out->missing : 0);
    if (missing) fmt::print("; {} have no value", missing);
    fmt::print("\n\n{:<32}", "errors in % of a black surface's");
    for (FitMetric metric : {FitMetric::cosine, FitMetric::log, FitMetric::cuberoot})
        fmt::print(" {:>17}", name_of(metric));
    fmt::print("\n{:<32}", "");
    for (int i = 0; i < 3; ++i) fmt::print(" {:>8} {:>8}", "fit", data.held_out ? "held out" : "");
    fmt::print(" {:>8} {:>8}\n", "numbers", "seconds");
    for (const FittedModel& m : fitted) {
        fmt::print("{:<32}", m.id);
        if (!m.fit) {
            fmt::print(" {}\n", m.why.empty() ? "not fitted" : m.why);
            continue;
        }
        for (FitMetric metric : {FitMetric::cosine, FitMetric::log, FitMetric::cuberoot}) {
            fmt::print(" {:>8.3f}", 100. * m.fit->errors.relative(metric));
            if (m.held_out)
                fmt::print(" {:>8.3f}", 100. * m.held_out->relative(metric));
            else
                fmt::print(" {:>8}", "");
        }
        fmt::print(" {:>8} {:>8.2f}\n", m.fit->numbers, m.fit->seconds);
        for (const std::string& line : term_lines(m)) fmt::print("    {}\n", line);
        if (!m.fit->at_limit.empty())
            fmt::print("    at the end of its range: {}\n", fmt::join(m.fit->at_limit, ", "));
        if (!m.fit->beyond.empty()) fmt::print("    {}\n", m.fit->beyond);
        if (!m.fit->converged) fmt::print("    not converged\n");
    }
}

ordered_json document(const Target& target, const std::vector<FittedModel>& fitted,
                      const FitData& data, const FitArguments& o) {
    ordered_json r{{"target", target.name()},
                   {"metric", o.metric},
                   {"lobes", o.lobes},
                   {"shape", o.shape},
                   {"pairs", {{"fit", data.fit.size()}}}};
    if (data.held_out) r["pairs"]["held_out"] = data.held_out->size();
    r["pairs"]["missing"] = data.fit.missing + (data.held_out ? data.held_out->missing : 0);
    r["models"] = ordered_json::array();
    for (const FittedModel& m : fitted) r["models"].push_back(to_json(m));
    return r;
}

void write_files(const Target& target, const std::vector<FittedModel>& fitted,
                 const ordered_json& json, const fs::path& folder) {
    write_whole_file(folder / "fit.json", json.dump(2) + "\n");
    std::vector<const FittedModel*> best;
    for (const FittedModel& m : fitted) {
        if (!m.fit) continue;
        std::string name = m.id;
        for (char& c : name)
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
        write_whole_file(folder / (name + ".xml"), scene_snippet(m, target.name()));
        // More lines than that nobody tells apart.
        if (best.size() < 5) best.push_back(&m);
    }
    if (best.empty()) return;
    for (double degrees : {15., 45., 70.})
        write_table(lobe_plot(target, best, degrees),
                    folder / fmt::format("lobes-{:g}.svg", degrees));
}

int run(const FitArguments& o) {
    FitOptions options;
    options.metric = metric_of(o);
    options.lobes = o.lobes;
    options.by_channel = word_among("--shape", "word", o.shape, {"shared", "channel"}) == 1;
    const bool half = word_among("--held-out", "word", o.held_out, {"half", "none"}) == 0;
    if (half) options.stride = 4;  // as many pairs as of the whole grid
    std::vector<FittedModel> fitted = models_asked_for(o.models);
    const std::unique_ptr<Target> target = make_target(o.target);
    if (!o.output.empty()) refuse_input_as_output(o.output, {o.target});
    const std::atomic<bool>& stop = interrupt_flag();
    options.stop = &stop;
    const FitData data = sample_halves(*target, half);
    if (!o.output.empty()) make_output_folder(o.output);
    {
        std::size_t now = 0;
        StatusLine line(
            o.quiet,
            [&](bool) {
                return fmt::format("{} of {}: {}", now + 1, fitted.size(), fitted[now].id);
            },
            2.);
        for (std::size_t i = 0; i < fitted.size() && !stop; ++i) {
            line.update([&] { now = i; });
            fit_one(fitted[i], data, options, o.models == "all");
        }
    }
    std::ranges::stable_sort(fitted, [&](const FittedModel& a, const FittedModel& b) {
        if (!a.fit || !b.fit) return a.fit.has_value() && !b.fit;
        return a.error(options.metric) < b.error(options.metric);
    });
    const ordered_json json = document(*target, fitted, data, o);
    if (o.json)
        fmt::print("{}\n", json.dump(2));
    else
        print_table(*target, fitted, data, options);
    if (!o.output.empty()) write_files(*target, fitted, json, o.output);
    if (stop) {
        say("nacre: interrupted: models without numbers were not fitted\n");
        return interrupted;
    }
    return std::ranges::any_of(fitted, &FittedModel::failed) ? failure : success;
}

}  // namespace

Action set_up_fit(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<FitArguments>();
    app.add_option("brdf", o->target,
                   "a measured file of any format, a folder of factors, or a model with settings, "
                   "'ggx alpha=0.2'")
        ->required();
    app.add_option("--model", o->models,
                   "all, or models separated by commas; settings that stay as given follow a name: "
                   "'ward variant=duer,ggx'")
        ->capture_default_str();
    app.add_option("--metric", o->metric,
                   "what is made small: cosine, f cos; log, log(1 + f cos); cuberoot, its cube "
                   "root")
        ->capture_default_str();
    add_whole(app, "--lobes", o->lobes, 1, 3,
              "lobes of each model, summed; the matte part once (1)");
    app.add_option("--shape", o->shape,
                   "shape parameters: shared, one for all bands; channel, one for each of red, "
                   "green and blue")
        ->capture_default_str();
    app.add_option("--held-out", o->held_out,
                   "half: fit every second node of the grid, measure the error on the others too; "
                   "none: fit all")
        ->capture_default_str();
    app.add_option("-o,--output", o->output,
                   "folder for fit.json, a scene's <bsdf> of each model (ward.xml, ...) and plots "
                   "in the plane of incidence (lobes-15.svg, ...)");
    add_threads(app, o->threads);
    app.add_flag("--quiet", o->quiet, "no progress");
    app.add_flag("--json", o->json, "for programs");
    return [o] { return with_threads(o->threads, [&] { return run(*o); }); };
}

}  // namespace nacre::cli
