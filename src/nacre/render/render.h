#pragma once
// The render loop: tiles in parallel, passes over the samples, progress, interruption.
#include <atomic>
#include <functional>

#include "nacre/render/film.h"
#include "nacre/render/integrator.h"

namespace nacre {

struct RenderProgress {
    std::uint64_t done, total;  ///< samples
    double seconds;             ///< since the start
};

struct RenderOptions {
    int threads = 0;       ///< 0: all cores
    double timeout_s = 0;  ///< 0: none; when reached the render stops after the samples in flight
    const std::atomic<bool>* stop = nullptr;  ///< set by a signal handler
    std::function<void(const RenderProgress&)>
        progress;  ///< called from one thread at a time, a few times a second
};

struct RenderResult {
    Film film;
    bool complete = true;  ///< false: stopped or timed out; the film holds what there is
    double seconds = 0;    ///< wall time of the render without precomputation
    double cpu_seconds = 0;
    double precompute_seconds = 0;
    RayCounts counts;
};

/// Renders the scene. The same scene and seed give the same bits for any number of threads.
RenderResult render(const Scene& scene, const RenderOptions& options = {});

}  // namespace nacre
