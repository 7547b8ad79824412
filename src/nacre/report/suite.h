#pragma once
// The report of the suite: a matrix of cases and techniques.
#include "nacre/compare/suite.h"
#include "nacre/report/experiment.h"

namespace nacre {

/// What stays of an experiment on one case; pictures do not.
struct SuiteCell {
    std::string id, title;                                 ///< of the setting
    std::string why;                                       ///< it has no numbers
    double systematic = 0, sigma = 0, bias = 0, flip = 0;  ///< shares
    double frame = 0, precompute = 0;                      ///< s
    double memory_mb = 0;
    std::string may_change;
    std::string same_as = {};  ///< id of an earlier one whose pictures have the same bits
};
struct SuiteResult {
    SuiteCase which;
    std::vector<SuiteCell> cells;
    Image picture;  ///< the reference, small
    double reference_error = 0, reference_cpu_seconds = 0;
};

SuiteResult summarise(const SuiteCase& which, const Experiment& e);

/// Which technique is nearest over the cases, and which is fast: a sentence or more.
std::vector<std::string> advise(const std::vector<SuiteResult>& results,
                                const std::string& reference);

nlohmann::ordered_json describe_suite(const std::vector<SuiteResult>& results, int cases, int width,
                                      int height, const ExperimentOptions& options,
                                      const ReportOrigin& origin);

}  // namespace nacre
