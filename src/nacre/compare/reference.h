#pragma once
// The picture that others are measured against: rendered until its noise is small enough, and kept.
#include <filesystem>
#include <functional>

#include "nacre/compare/technique_setting.h"
#include "nacre/metrics/pictures.h"
#include "nacre/render/render.h"

namespace nacre {

struct ReferenceOptions {
    TechniqueChoice technique{"volpath"};
    /// The noise that is small enough: root mean square of the relative standard errors of the
    /// means of `block` x `block` pixels (metrics.h), so that errors of that size can be told from
    /// noise wherever they stand in the picture.
    double error = 0.005;
    int block = 16;
    std::filesystem::path store;  ///< folder where references are kept; empty: nowhere
    bool fresh = false;           ///< do not take up one that was kept
    int threads = 0;
    const std::atomic<bool>* stop = nullptr;
    /// Share of the samples that are thought to be needed, and the noise so far.
    std::function<void(double share, double error)> progress = {};
    /// Told what is odd and does not end the work: a kept reference that is damaged.
    std::function<void(const std::string& message)> warn = {};
};

struct Reference {
    Image picture;   ///< with variances, as `variance_of_mean` reads them
    Image variance;  ///< of the mean
    int samples = 0;
    double error = 0;            ///< as in the options
    bool reached = false;        ///< false: stopped before
    bool reused = false;         ///< no sample was added to what was kept
    double cpu_seconds = 0;      ///< of all rounds
    std::filesystem::path file;  ///< where it is kept; empty: nowhere
};

/// Renders in rounds of independent samples with seeds of their own, and keeps the sum after each
/// as STORE/KEY.exr (film_state.h), where KEY stands for content_key and technique: a render that
/// is stopped, or that wants less noise later, goes on from there. A file there that is damaged is set aside as
/// KEY.exr.damaged and made anew. Whoever changes how that technique computes
/// asks for a `fresh` one. Throws InputError for unknown techniques and a store that cannot be
/// made, RunError if it cannot be written.
Reference make_reference(const Scene& scene, const PixelMask& mask,
                         const ReferenceOptions& options);

/// Root mean square over blocks and channels of the relative standard error of a block's mean.
double block_standard_error(const Image& picture, const Image& variance, const PixelMask& mask,
                            int block);

}  // namespace nacre
