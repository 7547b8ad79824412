#pragma once
// What the kinds of comparison share: their options, progress on standard error.
#include <filesystem>
#include <string>
#include <vector>

#include "apps/cli/progress_bar.h"
#include "apps/cli/scene_input.h"
#include "apps/cli/verb.h"
#include "nacre/compare/experiment.h"

namespace nacre::cli {

struct CompareOptions {
    SceneInput input;
    std::string techniques = "all", reference = "volpath", reference_error = "0.5%";
    std::string samples = "16", suite, cases, models, target, metric = "log", peers, keep;
    std::filesystem::path output = "report";
    int repeats = 3, threads = 0;
    std::uint64_t seed = 0;
    bool fresh = false, quiet = false;
};

/// What the options say about an experiment; throws InputError for what they get wrong.
ExperimentOptions experiment_options(const CompareOptions& o);

int compare_models(const CompareOptions& o, const CLI::App& app, const Invocation& invocation);
int compare_suite(const CompareOptions& o, const CLI::App& app, const Invocation& invocation);
int compare_scene(const CompareOptions& o, const CLI::App& app, const Invocation& invocation);

/// "0.5%" or "0.005"; throws InputError that names the option.
double parse_share(const std::string& option, const std::string& text);
/// "4,16"; throws InputError that names the option.
std::vector<int> parse_counts(const std::string& option, const std::string& text);
/// Where references are kept unless said otherwise: $XDG_CACHE_HOME/nacre/references.
std::filesystem::path reference_store(const CompareOptions& o);
/// Version, and a hash of the program itself: another build may be faster or slower.
std::string build_id();

/// A line for each part that begins and ends, and how far it is in between.
class PartProgress {
  public:
    explicit PartProgress(bool quiet)
        : line_(quiet, [this](bool terminal) { return text(terminal); }) {}
    void show(const ExperimentProgress& p);

  private:
    std::string text(bool terminal) const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    ExperimentProgress now_;
    bool ended_ = true;  ///< the part that `now_` tells of
    StatusLine line_;    ///< last: its thread uses the others
};

}  // namespace nacre::cli
