#pragma once
// What nacre fit hands over: scene snippets, JSON, plots.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/plot.h"
#include "nacre/measured/fit.h"

namespace nacre::cli {

/// A model that was asked for, and what came of it.
struct FittedModel {
    ModelSpec spec;
    std::string id;  ///< "ward variant=duer"
    std::optional<SumFit> fit;
    std::optional<FitErrors> held_out;
    std::string why;      ///< there is no fit
    bool failed = false;  ///< though there could be one

    /// What models are ordered by: on held-out data where there are any.
    double error(FitMetric metric) const {
        return (held_out ? *held_out : fit->errors).relative(metric);
    }
};

/// "ward kd=0.2", or "lobe 2: ks=0.1 alpha=0.3": a line a term.
std::vector<std::string> term_lines(const FittedModel& m);

/// A <bsdf> that scene files take: the model, or the sum of its lobes.
std::string scene_snippet(const FittedModel& m, const std::string& target);

nlohmann::ordered_json to_json(const FittedModel& m);

/// Target (points) and models (lines) in the plane of incidence, the mean of the bands, light from
/// `degrees`.
Table lobe_plot(const Target& target, const std::vector<const FittedModel*>& models,
                double degrees);

}  // namespace nacre::cli
