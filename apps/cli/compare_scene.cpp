// nacre compare SCENE: every technique on one scene.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/cli/compare.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/streams.h"
#include "nacre/math/error.h"
#include "nacre/report/experiment.h"
#include "nacre/report/report.h"
#include "nacre/techniques/missing_light.h"
#include "nacre/text/split_words.h"

namespace nacre::cli {
namespace {

std::string title_of(const CompareOptions& o, const Experiment& e) {
    const std::string name = o.input.scene == "demo"
                                 ? "The built-in bust"
                                 : std::filesystem::path(o.input.scene).stem().string();
    std::set<std::string> techniques, peers;
    for (const ExperimentRow& row : e.rows)
        if (row.peer)
            peers.emplace(row.peer->name);
        else
            techniques.insert(row.setting.choice.technique);
    const auto count = [](std::size_t n, const char* what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    return fmt::format("{}: {}{}", name, count(techniques.size(), "technique"),
                       peers.empty() ? "" : " and " + count(peers.size(), "other renderer"));
}

PeerSource peer_source(const SceneInput& input, int samples) {
    PeerSource source;
    if (is_scene_file(input)) source.scene_file = input.scene;
    for (const std::string& d : input.defines)
        source.defines[d.substr(0, d.find('='))] = d.substr(d.find('=') + 1);
    source.samples = samples;
    return source;
}

void print_table(const Experiment& e) {
    fmt::print("{:<48} {:>17} {:>10} {:>9} {:>7} {:>9} {:>9} {:>8}\n", "", "systematic error",
               "brightness", "frame err", "FLIP", "frame", "before", "memory");
    for (const ExperimentRow& row : e.rows) {
        const Measurement& m = row.measurement;
        if (!row.verdict) {
            fmt::print("{:<48} {}\n", m.id,
                       m.status == Measurement::Status::failed ? "failed: " + m.why : "not run");
            continue;
        }
        const Verdict& v = *row.verdict;
        fmt::print(
            "{:<48} {:>6.2f} % ± {:<5.2f} {:>+9.2f} % {:>7.1f} % {:>7.3f} {:>9} {:>9} {:>5.0f} "
            "MB\n",
            m.id, 100 * v.systematic.value, 100 * v.systematic.sigma, 100 * v.bias.value,
            100 * v.frame, v.flip, format_seconds(m.median_of(&Timing::frame)),
            format_seconds(m.median_of(&Timing::precompute)), m.memory_mb);
    }
}

}  // namespace

ExperimentOptions experiment_options(const CompareOptions& o) {
    ExperimentOptions options;
    options.settings = parse_techniques(o.techniques, parse_counts("--spp", o.samples));
    options.reference.technique = {std::string(techniques().find(o.reference).name)};
    options.reference.error = parse_share("--reference-error", o.reference_error);
    options.reference.store = reference_store(o);
    options.reference.fresh = o.fresh;
    options.repeats = o.repeats;
    options.seed = o.seed;
    options.threads = o.threads;
    options.folder = o.output / "pictures";
    options.build = build_id();
    options.fresh = o.fresh;
    for (const std::string_view name : split_words(o.peers)) {
        const PeerDescription& peer = peers().find(name);
        // Better known now than after all the techniques.
        if (!peer.find(""))
            throw InputError(fmt::format("--peer: {} is not installed; install it with: {}",
                                         peer.title, peer.how_to_install));
        options.peers.push_back(&peer);
    }
    return options;
}

int compare_scene(const CompareOptions& o, const CLI::App& app, const Invocation& invocation) {
    // What is wrong with the command line is said before anything is read.
    ExperimentOptions options = experiment_options(o);
    const Scene scene = load(o.input, app);
    options.peer_source = peer_source(o.input, options.settings.front().samples);
    for (const std::string& w : scene.warnings) say("nacre: warning: {}\n", w);
    // Every row has its own integrator; the one that may lack light is the simulation.
    for (const std::string& w : missing_in_simulation(scene)) say("nacre: warning: {}\n", w);
    const std::atomic<bool>& stop = interrupt_flag();
    options.stop = &stop;
    options.warn = [](const std::string& message) { say("nacre: warning: {}\n", message); };
    const Experiment e = [&] {
        PartProgress progress(o.quiet);
        options.progress = [&](const ExperimentProgress& p) { progress.show(p); };
        return run_experiment(scene, options);
    }();
    if (!e.reference.reached && e.reference.samples == 0) {
        say("nacre: interrupted before the reference's first round was done\n");
        return interrupted;
    }
    if (!e.reference.reached) {
        say("nacre: interrupted: the reference has a noise of {:.2f} % after {} samples a "
            "pixel and is kept; the same command goes on\n",
            100 * e.reference.error, e.reference.samples);
        return interrupted;
    }
    write_image(e.reference.picture, o.output / "reference.exr");
    const nlohmann::ordered_json document =
        describe(e, scene, options,
                 {title_of(o, e), o.input.scene, arguments_of(o.input), invocation.command_line,
                  options.build});
    write_report(document, o.output);
    if (!o.quiet) {
        print_table(e);
        fmt::print("\n");
        for (const auto& sentence : document["verdict"]["sentences"])
            fmt::print("{}\n", sentence.get<std::string>());
    }
    fmt::print("{}\n",
               std::filesystem::absolute(o.output / "index.html").lexically_normal().string());
    if (!e.complete) {
        say("nacre: interrupted: what is finished is in the report and kept; the same "
            "command goes on\n");
        return interrupted;
    }
    return e.any_failed() ? failure : success;
}

}  // namespace nacre::cli
