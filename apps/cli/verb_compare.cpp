// nacre compare: every technique on one scene, error and cost side by side, as a report.
#include <CLI/CLI.hpp>

#include "apps/cli/compare.h"
#include "apps/cli/number_option.h"
#include "nacre/math/error.h"

namespace nacre::cli {
namespace {

int run(const CompareOptions& o, const CLI::App& app, const Invocation& invocation) {
    for (const char* option : {"--fit-to", "--metric"})
        if (app.count(option) && !app.count("--models"))
            throw InputError(fmt::format("{} belongs to --models, which is missing", option));
    if (app.count("--models") && app.count("--suite"))
        throw InputError("give either --models or --suite");
    if (app.count("--models")) return compare_models(o, app, invocation);
    if (!o.suite.empty()) return compare_suite(o, app, invocation);
    if (!o.cases.empty()) throw InputError("--cases belongs to --suite, which is missing");
    CompareOptions scene = o;
    // All techniques and the reference in a few minutes on two cores.
    if (o.input.scene == "demo" && o.input.size.empty()) scene.input.size = "240x320";
    return compare_scene(scene, app, invocation);
}

}  // namespace

Action set_up_compare(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<CompareOptions>();
    o->input.scene = "demo";
    app.add_option("scene", o->input.scene,
                   "scene (.xml), mesh, or demo, the built-in scene (default)");
    app.add_option("-o,--output", o->output, "folder of the report (report)");
    app.add_option("--techniques", o->techniques,
                   "all, or names separated by commas; settings follow a name: "
                   "two_pass:error=0.1,surface:profile=dipole")
        ->capture_default_str();
    app.add_option("--spp", o->samples, "samples a pixel of a frame; several as 4,16")
        ->capture_default_str();
    app.add_option("--reference", o->reference, "technique of the reference")
        ->capture_default_str();
    app.add_option("--reference-error", o->reference_error,
                   "noise of the reference, RMS over blocks of 16 x 16 pixels")
        ->capture_default_str();
    add_whole(app, "--repeats", o->repeats, 2, 10000,
              "times that each technique is run, at least 2")
        ->default_str("3");
    add_seed(app, o->seed, "of the random numbers (0)");
    add_threads(app, o->threads);
    add_scene_options(app, o->input);
    app.add_option("--peer", o->peers,
                   "other renderers on this machine: cycles, cycles_random_walk, mitsuba; several "
                   "separated by commas");
    app.add_option("--suite", o->suite, "translucency: the project's own 60 scenes instead of one");
    app.add_option("--cases", o->cases,
                   "of the suite only these: words of objects, albedo, matter and light, such as "
                   "ball,bust,front");
    app.add_option("--models", o->models,
                   "reflectance models instead of techniques, separated by commas; settings follow "
                   "a name: 'ward variant=duer,ggx'");
    app.add_option("--fit-to", o->target,
                   "what the models are fitted to: a measured file (see 'nacre data info') or a "
                   "model with settings, 'cook_torrance m=0.2'");
    app.add_option("--metric", o->metric, "of the fit: log or cosine")->capture_default_str();
    app.add_option("--keep", o->keep,
                   "folder where references are kept (default: the user's cache)");
    app.add_flag("--fresh", o->fresh, "use nothing that was kept");
    app.add_flag("--quiet", o->quiet, "no progress and no table, only warnings and errors");
    return [o, &app, invocation] { return run(*o, app, invocation); };
}

}  // namespace nacre::cli
