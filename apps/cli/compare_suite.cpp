// nacre compare --suite translucency: every technique on the project's own scenes.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/compare.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/streams.h"
#include "nacre/math/error.h"
#include "nacre/report/report.h"
#include "nacre/report/suite.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

// 60 cases: small pictures, and blocks so small that enough of them lie wholly on the object.
constexpr std::pair suite_size{112, 112};
constexpr int suite_block = 8;

std::string folder_name(const SuiteCase& c) {
    return fmt::format("{}_{}_{}_{}", c.object, c.albedo, c.matter, c.light);
}

}  // namespace

int compare_suite(const CompareOptions& o, const CLI::App& app, const Invocation& invocation) {
    if (o.suite != "translucency")
        throw InputError("--suite: " + unknown_name("suite", o.suite, {"translucency"}));
    for (const char* option : {"scene", "-D", "--mode", "--material", "--height-mm", "--peer"})
        if (app.count(option))
            throw InputError(fmt::format("--suite brings its own scenes: leave out {}", option));
    std::pair<int, int> size = suite_size;
    if (!o.input.size.empty()) size = parse_size("--size", o.input.size);
    const std::vector<SuiteCase> cases = suite_cases(o.cases);
    ExperimentOptions options = experiment_options(o);
    if (!app.count("--spp")) options.settings = parse_techniques(o.techniques, {8});
    if (!app.count("--reference-error")) options.reference.error = 0.03;
    if (!app.count("--repeats")) options.repeats = 2;
    for (const TechniqueSetting& s : options.settings)
        if (s.samples != options.settings.front().samples)
            throw InputError("--suite takes one number of samples; give one to --spp");
    options.block = suite_block;
    const std::atomic<bool>& stop = interrupt_flag();
    options.stop = &stop;
    options.warn = [](const std::string& message) { say("nacre: warning: {}\n", message); };

    std::vector<SuiteResult> results;
    bool complete = true, failed = false;
    PartProgress progress(o.quiet);
    for (std::size_t i = 0; i < cases.size() && complete; ++i) {
        Scene scene = make_suite_scene(cases[i], size.first, size.second);
        std::unique_ptr<Scene> even;
        if (cases[i].matter == "veined") {
            even =
                std::make_unique<Scene>(make_suite_scene(cases[i], size.first, size.second, true));
            options.simplified = even.get();
        }
        options.folder = o.output / "pictures" / folder_name(cases[i]);
        options.progress = [&](const ExperimentProgress& p) {
            ExperimentProgress shown = p;
            shown.part += int(i) * p.parts;
            shown.parts *= int(cases.size());
            shown.what = fmt::format("{}: {}", cases[i].id(), p.what);
            progress.show(shown);
        };
        const Experiment e = run_experiment(scene, options);
        options.simplified = nullptr;
        complete = e.complete;
        failed |= e.any_failed();
        if (!e.complete) break;
        write_image(e.reference.picture, options.folder / "reference.exr");
        results.push_back(summarise(cases[i], e));
    }
    if (!results.empty()) {
        write_report(describe_suite(results, int(cases.size()), size.first, size.second, options,
                                    {"Translucency: every technique on every kind of object", "",
                                     "", invocation.command_line, options.build}),
                     o.output);
        if (!o.quiet)
            fmt::print("{}\n",
                       fmt::join(advise(results, options.reference.technique.technique), "\n"));
        fmt::print("{}\n",
                   std::filesystem::absolute(o.output / "index.html").lexically_normal().string());
    }
    if (!complete) {
        say("nacre: interrupted after {} of {} cases; what is finished is kept, the "
            "same command goes on\n",
            results.size(), cases.size());
        return interrupted;
    }
    return failed ? failure : success;
}

}  // namespace nacre::cli
