#pragma once
// What is done to a picture once its samples are there: auxiliary images, noise taken out.
#include <atomic>
#include <filesystem>

#include "nacre/image/image.h"
#include "nacre/render/render.h"

namespace CLI {
class App;
}

namespace nacre::cli {

struct FinishOptions {
    bool auxiliary = false;  ///< albedo, normal and depth as layers
    bool denoise = false;    ///< the render must have kept its halves
};

/// What was done.
struct Finish {
    bool denoised = false;
    double seconds = 0, cpu_seconds = 0;
};

/// Declares --denoise and --aovs.
void add_finish_options(CLI::App& app, FinishOptions& options);

/// Throws InputError for layers in a file that has none.
void check_finish(const FinishOptions& options, const std::filesystem::path& output);

/// Throws InputError for too few samples to tell noise from picture.
void check_samples(const FinishOptions& options, int samples);

/// Adds to `picture` (render_image) what is asked for; left as it is if `stop` is set meanwhile.
Finish finish_picture(Image& picture, const RenderResult& result, const Scene& scene,
                      const FinishOptions& options, int threads, const std::atomic<bool>& stop);

}  // namespace nacre::cli
