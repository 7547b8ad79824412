#pragma once
// The render loop: tiles in parallel, passes over the samples, progress, interruption.
#include <atomic>
#include <functional>
#include <optional>
#include <string_view>

#include "nacre/render/film.h"
#include "nacre/render/frame_settings.h"
#include "nacre/render/integrator.h"

namespace nacre {

struct RenderProgress {
    std::uint64_t done, total;    ///< samples; of precomputation, whatever its phase counts
    double seconds;               ///< since the start of the render or of the phase
    std::string_view phase = {};  ///< of precomputation; empty while samples are drawn

    double share() const { return total ? double(done) / double(total) : 0.; }
};

/// A render in the making, for who keeps it.
struct RenderCheckpoint {
    const Film& film;  ///< of each pixel its first samples, as many as there are so far
    RayCounts counts;
    double seconds, cpu_seconds;  ///< since the start of the render
};

struct RenderOptions {
    int threads = 0;  ///< 0: all cores
    /// 0: none; when reached, from the start of precomputation on, the render stops after the
    /// samples in flight.
    double timeout_s = 0;
    const std::atomic<bool>* stop = nullptr;  ///< set by a signal handler
    bool halves = false;                      ///< also keep two films of half the samples each
    /// Called from one thread at a time, a few times a second and at the end.
    std::function<void(const RenderProgress&)> progress = {};

    /// What an earlier render of the same frame left: each pixel goes on behind the samples that it
    /// has, to the bits of one render of all of them. The samplers `independent` and `sobol` do so
    /// from any number of samples, `stratified` from the same alone. Null: from the start.
    const Film* begun = nullptr;
    /// Ends when film_noise (noise.h) is no more than this, after a batch of samples of all pixels
    /// and at least `least_noise_samples`; 0: all samples. Which batch that is does not depend on
    /// threads or on where the render was begun.
    double noise = 0;
    /// Called every `checkpoint_s` seconds from a thread of its own, while others go on to render.
    /// Must not throw.
    std::function<void(const RenderCheckpoint&)> checkpoint = {};
    double checkpoint_s = 0;
};
inline constexpr int least_noise_samples = 32;  ///< a pixel: of fewer, noise is hard to estimate

struct RenderResult {
    Film film;
    SamplerSettings sampler = {};  ///< of the frame; its samples those at which noise ended it
    std::string integrator = {};   ///< what rendered it, for the picture's metadata
    /// False: stopped or timed out; the film holds what there is, nothing if that was in
    /// precomputation.
    bool complete = true;
    double seconds = 0;  ///< wall time of the render without precomputation
    double cpu_seconds = 0;
    double precompute_seconds = 0, precompute_cpu_seconds = 0;
    std::optional<double> noise = {};  ///< film_noise, if it was asked for and all have samples
    RayCounts counts = {};
    Statistics statistics = {};  ///< of precomputation
    /// If asked for, two films of about half the samples each, which together are `film`: what is
    /// noise and what is picture can be told from them (render/denoised.h). Else empty.
    std::vector<Film> halves = {};
};

/// Renders a frame. The same scene and seed give the same bits for any number of threads, and a
/// pixel has the same bits in a crop window as in the whole film.
///
/// What the film holds (its `quantity`): radiance, linear RGB; luminance, cd/m^2 in all three
/// channels, where a radiance of 1 is 1 W m^-2 sr^-1 nm^-1 at every wavelength; illuminance, the
/// lux that a surface facing the pixel's direction receives from within the pixel (luminance times
/// the pixel's solid angle as seen from the middle of the lens), so that the sum over a region
/// around a lamp is the lux from that lamp. Throws InputError as RenderJob does.
RenderResult render(const Scene& scene, const Integrator& integrator, const FrameSettings& frame,
                    const RenderOptions& options = {});
/// The scene's own frame.
RenderResult render(const Scene& scene, const Integrator& integrator,
                    const RenderOptions& options = {});
/// With the integrator that the scene names; making it is precomputation.
RenderResult render(const Scene& scene, const RenderOptions& options = {});

/// Renders with what is prepared first: `prepare` returns it, and its precomputation counts as such
/// and is stopped and timed out too (the film is empty then).
using RenderPrepared = std::function<RenderResult(const RenderOptions& options)>;
RenderResult prepare_and_render(const std::function<RenderPrepared(const Work& work)>& prepare,
                                const FrameSettings& frame, const RenderOptions& options = {});

}  // namespace nacre
