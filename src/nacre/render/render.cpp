#include "nacre/render/render.h"

#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "nacre/math/error.h"
#include "nacre/render/filter.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/photometry.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double process_cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Denormal numbers become zero while it lives (Embree's advice: they cost a hundred times an
/// ordinary operation). Set for every tile on whatever thread runs it, so that a number does not
/// depend on the thread.
class FlushDenormals {
  public:
    FlushDenormals() : before_(_mm_getcsr()) {
        constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
        _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
    }
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned before_;
};

/// Solid angle of the triangle of three unit vectors (Van Oosterom and Strackee 1983, The Solid
/// Angle of a Plane Triangle, IEEE Transactions on Biomedical Engineering 30(2)).
double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Side of a tile. Small enough that the last tiles of a pass keep all threads busy, large enough
/// that neighbouring rays share the caches.
constexpr int tile_side = 16;
/// Samples a pixel gets in one pass at most: an interrupted picture is even to within that many.
constexpr int largest_pass = 16;

/// When a render that begins now has to end.
Clock::time_point deadline_of(const RenderOptions& options) {
    // A hundred years are for ever, and fit the clock.
    constexpr double longest_s = 3e9;
    if (!(options.timeout_s > 0)) return Clock::time_point::max();
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                              std::min(options.timeout_s, longest_s)));
}

class RenderJob {
  public:
    /// Without a deadline the timeout counts from the start of `run`.
    RenderJob(const Scene& scene, const Integrator& integrator, const RenderOptions& options,
              std::optional<Clock::time_point> deadline = {})
        : scene_(scene),
          integrator_(integrator),
          options_(options),
          deadline_(deadline),
          film_(scene.film),
          filter_(scene.film.filter),
          sampler_(Sampler::kind_from_name(scene.sampler.type), scene.sampler.seed,
                   scene.sampler.samples) {
        if (!scene.camera) throw InputError("the scene has no camera; add a <sensor>");
        if (scene.sampler.samples < 1)
            throw InputError(fmt::format("{} samples a pixel make no picture; ask for at least 1",
                                         scene.sampler.samples));
        if (scene.film.quantity == FilmQuantity::illuminance &&
            !(pixel_solid_angle(film_.settings().crop_x, film_.settings().crop_y) > 0))
            throw InputError(
                "illuminance needs a camera whose pixels see a solid angle: its rays are "
                "parallel; use a perspective camera or ask for luminance");
    }

    RenderResult run() {
        if (!deadline_) deadline_ = deadline_of(options_);
        const double cpu = process_cpu_seconds();
        const int columns = (film_.width() + tile_side - 1) / tile_side;
        const int rows = (film_.height() + tile_side - 1) / tile_side;
        const int samples = scene_.sampler.samples;
        total_ = std::uint64_t(film_.width()) * film_.height() * samples;
        for (int first = 0; first < samples && !interrupted();) {
            const int last = std::min({samples, std::max(1, 2 * first), first + largest_pass});
            // Each tile by itself: a thread that is done takes the next one.
            tbb::parallel_for(
                tbb::blocked_range<int>(0, columns * rows, 1),
                [&](const tbb::blocked_range<int>& range) {
                    for (int t = range.begin(); t < range.end(); ++t)
                        render_tile(t % columns * tile_side, t / columns * tile_side, first, last);
                },
                tbb::simple_partitioner());
            first = last;
        }
        report(true);
        RenderResult result{.film = std::move(film_), .counts = counts_};
        result.complete = done_ == total_;
        result.seconds = seconds_since(start_);
        result.cpu_seconds = process_cpu_seconds() - cpu;
        return result;
    }

  private:
    bool interrupted() {
        if (options_.stop && options_.stop->load(std::memory_order_relaxed)) stopped_ = true;
        if (*deadline_ != Clock::time_point::max() && Clock::now() >= *deadline_) stopped_ = true;
        return stopped_;
    }

    void render_tile(int x0, int y0, int first, int last) {
        const FlushDenormals guard;
        RayCounts counts;
        Sampler sampler = sampler_;
        for (int y = y0; y < std::min(y0 + tile_side, film_.height()); ++y)
            for (int x = x0; x < std::min(x0 + tile_side, film_.width()); ++x) {
                for (int s = first; s < last; ++s) {
                    // A path below a dense surface may take a millisecond: asked at every one.
                    if (interrupted()) break;
                    render_sample(x, y, static_cast<std::uint32_t>(s), sampler, counts);
                    ++done_;
                }
                report(false);
            }
        const std::lock_guard lock(mutex_);
        counts_ += counts;
    }

    void render_sample(int x, int y, std::uint32_t s, Sampler& sampler, RayCounts& counts) {
        const FilmSettings& film = film_.settings();
        const int full_x = x + film.crop_x, full_y = y + film.crop_y;
        sampler.start(std::uint64_t(full_y) * film.width + full_x, s);
        const FilterSample position =
            filter_.sample(sampler.next2d(), filter_window(film, full_x, full_y));
        const Vec2f lens = sampler.next2d();
        const bool spectral = scene_.mode == ColorMode::spectral;
        const Wavelengths wavelengths =
            spectral ? Wavelengths::sample(sampler.next1d()) : Wavelengths::rgb_bands();
        const Ray ray = scene_.camera->ray({(full_x + 0.5f + position.offset.x) / film.width,
                                            (full_y + 0.5f + position.offset.y) / film.height},
                                           lens);
        const Spectral radiance = integrator_.radiance(ray, sampler, wavelengths, counts);
        // A colour made of a few wavelengths may well be negative; radiance may not.
        for (int lane = 0; spectral && lane < Spectral::size; ++lane)
            if (!std::isfinite(radiance[lane]) || radiance[lane] < 0.f)
                return film_.add_invalid(x, y, s, {radiance[0], radiance[1], radiance[2]});
        Vec3f rgb = to_rgb(radiance, wavelengths);
        if (film.quantity != FilmQuantity::radiance) {
            float value = luminance(rgb) * photometric_scale;
            if (film.quantity == FilmQuantity::illuminance)
                value *= static_cast<float>(pixel_solid_angle(full_x, full_y));
            rgb = {value, value, value};
        }
        film_.add(x, y, s, rgb, position.weight, spectral);
    }

    double pixel_solid_angle(int full_x, int full_y) const {
        const auto corner = [&](int dx, int dy) {
            const Vec2f at{float(full_x + dx) / film_.settings().width,
                           float(full_y + dy) / film_.settings().height};
            return normalize(Vec3d(scene_.camera->ray(at, {0.5f, 0.5f}).d));
        };
        const Vec3d a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
        return solid_angle(a, b, c) + solid_angle(a, c, d);
    }

    /// Calls the progress function if it is time and no other thread is at it.
    void report(bool last) {
        constexpr double interval_s = 0.2;
        if (!options_.progress) return;
        std::unique_lock lock(report_mutex_, std::defer_lock);
        if (last)
            lock.lock();
        else if (!lock.try_lock())
            return;
        const double now = seconds_since(start_);
        if (!last && now - last_report_ < interval_s) return;
        last_report_ = now;
        options_.progress({done_.load(), total_, now});
    }

    const Scene& scene_;
    const Integrator& integrator_;
    const RenderOptions& options_;
    std::optional<Clock::time_point> deadline_;  ///< set while it runs
    Film film_;
    const Filter filter_;
    const Sampler sampler_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> done_{0};
    std::uint64_t total_ = 0;
    std::atomic<bool> stopped_{false};
    std::mutex mutex_, report_mutex_;
    double last_report_ = 0;
    RayCounts counts_;
};

/// What precomputation tells, as progress of the render.
Work::Tell told_of(const RenderOptions& options) {
    if (!options.progress) return {};
    struct Phase {
        std::string name;
        Clock::time_point start;
    };
    return [&options, now = std::make_shared<Phase>()](std::string_view phase, double share) {
        if (phase != now->name) *now = {std::string(phase), Clock::now()};
        constexpr double parts = 1e6;
        options.progress(
            {std::uint64_t(parts * share), std::uint64_t(parts), seconds_since(now->start), phase});
    };
}

/// Runs `work` with as many threads as asked for.
RenderResult with_threads(int threads, const std::function<RenderResult()>& work) {
    if (threads <= 0) return work();
    // Lets there be more threads than cores.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(threads));
    tbb::task_arena arena(threads);
    return arena.execute(work);
}

}  // namespace

RenderResult render(const Scene& scene, const Integrator& integrator,
                    const RenderOptions& options) {
    return with_threads(options.threads,
                        [&] { return RenderJob(scene, integrator, options).run(); });
}

RenderResult render_with(const Scene& scene, MakeIntegrator make, const RenderOptions& options) {
    return with_threads(options.threads, [&] {
        const Clock::time_point start = Clock::now();
        const double cpu_start = process_cpu_seconds();
        const Clock::time_point deadline = deadline_of(options);
        std::unique_ptr<Integrator> integrator;
        try {
            const Work work(options.stop, deadline, told_of(options));
            integrator = make(scene, work);
        } catch (const Stopped&) {
            RenderResult nothing{.film = Film(scene.film), .counts = {}};
            nothing.complete = false;
            nothing.precompute_seconds = seconds_since(start);
            nothing.precompute_cpu_seconds = process_cpu_seconds() - cpu_start;
            return nothing;
        }
        const double precompute = seconds_since(start);
        const double precompute_cpu = process_cpu_seconds() - cpu_start;
        RenderResult result = RenderJob(scene, *integrator, options, deadline).run();
        result.precompute_seconds = precompute;
        result.precompute_cpu_seconds = precompute_cpu;
        result.statistics = integrator->statistics();
        return result;
    });
}

RenderResult render(const Scene& scene, const RenderOptions& options) {
    return render_with(scene, make_integrator, options);
}

}  // namespace nacre
