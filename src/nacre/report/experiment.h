#pragma once
// The report of an experiment.
#include <nlohmann/json_fwd.hpp>

#include "nacre/compare/experiment.h"

namespace nacre {

/// What the experiment does not know of itself.
struct ReportOrigin {
    std::string title;            ///< of the page
    std::string scene;            ///< "bunny.ply, marble"
    std::string scene_arguments;  ///< what `nacre render` needs to load it
    std::string command, version;
};

/// The document (docs/report.md).
nlohmann::ordered_json describe(const Experiment& e, const Scene& scene,
                                const ExperimentOptions& options, const ReportOrigin& origin);

/// Facts that every report states: machine, program, date.
nlohmann::ordered_json common_facts(const std::string& version, int threads);

/// The profiles that the rows use, of the first translucent shape in the middle band, beside a
/// simulation: a chart, or null if nothing is translucent.
nlohmann::ordered_json profile_chart(const Scene& scene, const std::vector<ExperimentRow>& rows);

}  // namespace nacre
