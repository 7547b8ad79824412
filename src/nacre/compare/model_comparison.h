#pragma once
// Reflectance models beside one another: each fitted to one target, then measured.
#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "nacre/compare/brdf_portrait.h"
#include "nacre/measured/fit.h"

namespace nacre {

struct ModelComparisonOptions {
    FitMetric metric = FitMetric::log;
    int threads = 0;                          ///< 0: all cores
    const std::atomic<bool>* stop = nullptr;  ///< set by a signal handler
    /// Called from one thread before each model and at the end.
    std::function<void(const std::string& model, int done, int total)> progress = {};
};

/// One model of a comparison.
struct ComparedModel {
    enum class Status { ok, failed, missing };

    std::string id;  ///< as asked for: "ward variant=duer"; unique
    const ModelDescription* description = nullptr;
    Status status = Status::missing;  ///< missing: stopped before it
    std::string why;                  ///< message, if failed

    // If ok:
    std::optional<ModelFit> fit;
    BrdfPortrait portrait = {};
    double albedo_difference = 0.;  ///< brdf_portrait.h
    double largest_albedo = 0.;     ///< of the curve, any band
    double largest_albedo_angle = 0.;
    /// Time of an evaluation at one wavelength, in packs of single precision, one thread: median of
    /// seven repeats over 16384 random pairs of directions.
    double seconds_per_million = 0.;
    bool reciprocal = true;  ///< as the model says of itself with these options
    Energy energy = Energy::conserves;
};

struct ModelComparison {
    std::string target;
    FitMetric metric = FitMetric::log;
    std::size_t directions = 0, missing_directions = 0;  ///< TargetSamples
    bool isotropic = true;
    BrdfPortrait reference;
    std::vector<ComparedModel> models;
    bool complete = true;  ///< false: stopped
    /// Spheres and slices by the names under which the document calls them: "reference", a model's
    /// id; "slice reference", "slice " and a model's id.
    std::map<std::string, Image> pictures;
};

/// Throws InputError for an unknown model, wrong settings, or a model given twice.
void check_models(std::span<const ModelSpec> models);

/// Fits every model to the target, in order, and measures it. A model that cannot be fitted is
/// noted and the others go on; after `stop` the rest is missing, and a model whose fit it cut short
/// is too. Throws InputError, before anything is computed, as check_models does and for a target
/// that has no values.
ModelComparison compare_models(std::span<const ModelSpec> models, const Target& target,
                               const ModelComparisonOptions& options = {});

/// What the model says of itself with the options that are set; the first behaviour if none fits.
const Behaviour& behaviour_of(const AnyModel& model);

}  // namespace nacre
