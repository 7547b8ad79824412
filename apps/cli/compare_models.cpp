// nacre compare --models: reflectance models, each fitted to one target.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/compare.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/model_list.h"
#include "apps/cli/streams.h"
#include "nacre/math/error.h"
#include "nacre/report/experiment.h"
#include "nacre/report/model_document.h"
#include "nacre/report/report.h"
#include "nacre/text/names.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

FitMetric parse_metric(const std::string& text) {
    if (text == "log") return FitMetric::log;
    if (text == "cosine") return FitMetric::cosine;
    throw InputError("--metric: " + unknown_name("metric", text, {"log", "cosine"}));
}

void print_table(const ModelComparison& c) {
    fmt::print("{:<36} {:>9} {:>9} {:>9}  {}\n", "", "error", "log error", "albedo", "parameters");
    for (const ComparedModel& m : c.models) {
        if (m.fit)
            fmt::print("{:<36} {:>7.2f} % {:>7.2f} % {:>7.2f} %  {}\n", m.id,
                       100 * m.fit->errors.cosine_relative, 100 * m.fit->errors.log_relative,
                       100 * m.albedo_difference, m.fit->text);
        else
            fmt::print("{:<36} {}\n", m.id, m.why.empty() ? "not run" : "failed: " + m.why);
    }
}

}  // namespace

int compare_models(const CompareOptions& o, const CLI::App& app, const Invocation& invocation) {
    if (o.target.empty())
        throw InputError("--models needs --fit-to: a measured file or a model, 'ggx alpha=0.2'");
    for (const char* option : {"scene", "-D", "--size", "--mode", "--material", "--height-mm",
                               "--techniques", "--spp", "--reference", "--repeats", "--peer"})
        if (app.count(option))
            throw InputError(fmt::format("{} has no meaning for --models", option));
    const std::vector<ModelSpec> models = parse_models("--models", o.models);
    const std::unique_ptr<Target> target = make_target(o.target);
    check_models(models);
    make_output_folder(o.output / "pictures");
    const std::atomic<bool>& stop = interrupt_flag();
    ModelComparisonOptions options;
    options.metric = parse_metric(o.metric);
    options.threads = o.threads;
    options.stop = &stop;
    const ModelComparison c = [&] {
        PartProgress progress(o.quiet);
        options.progress = [&](const std::string& model, int done, int total) {
            if (done < total) progress.show({model, done + 1, total, 0, ""});
        };
        return nacre::compare_models(models, *target, options);
    }();
    nlohmann::ordered_json document = describe(c);
    document["command"] = invocation.command_line;
    for (auto& fact : common_facts(build_id(), o.threads)) document["facts"].push_back(fact);
    for (const auto& [name, image] : c.pictures) {
        document["pictures"][name] = rgbe_picture(image);
        std::string file = name;
        std::ranges::replace(file, ' ', '_');
        std::ranges::replace(file, '/', '_');
        write_image(image, o.output / "pictures" / (file + ".exr"));
    }
    write_report(document, o.output);
    if (!o.quiet) {
        print_table(c);
        fmt::print("\n{}\n", fmt::join(advise(c), "\n"));
    }
    fmt::print("{}\n",
               std::filesystem::absolute(o.output / "index.html").lexically_normal().string());
    if (!c.complete) {
        say("nacre: interrupted: models without numbers were not fitted\n");
        return interrupted;
    }
    const bool failed = std::ranges::any_of(
        c.models, [](const ComparedModel& m) { return m.status == ComparedModel::Status::failed; });
    return failed ? failure : success;
}

}  // namespace nacre::cli
