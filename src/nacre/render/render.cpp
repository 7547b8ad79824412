#include "nacre/render/render.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>

#include "nacre/render/checkpoints.h"
#include "nacre/render/noise.h"
#include "nacre/render/render_clock.h"
#include "nacre/render/render_job.h"
#include "nacre/render/threads.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

/// Drives a job's tiles on the threads at hand.
class RenderLoop {
  public:
    RenderLoop(RenderJob& job, const RenderOptions& options)
        : job_(job), options_(options), deadline_(deadline_after(options.timeout_s)) {}

    /// Returns whether all samples were rendered.
    bool run() {
        std::atomic<std::uint64_t> added{job_.drawn()};
        begun_ = added.load();
        // Batches end where they would if nothing had been begun, and so does a render at a noise.
        const int there = job_.least_drawn();
        SampleRange batch = job_.batch_after(0);
        while (batch.first < batch.last && batch.last <= there)
            batch = job_.batch_after(batch.last);
        if (job_.drawn() == job_.total(there) && clean_after(there)) return true;
        while (batch.first < batch.last && !interrupted()) {
            // Each tile by itself: a thread that is done takes the next one.
            tbb::parallel_for(
                tbb::blocked_range<int>(0, job_.tile_count(), 1),
                [&](const tbb::blocked_range<int>& range) {
                    for (int t = range.begin(); t < range.end(); ++t)
                        added += job_.render(job_.tile(t), batch, [&] { return goes_on(); });
                },
                tbb::simple_partitioner());
            if (!stopped_ && clean_after(batch.last)) break;
            batch = job_.batch_after(batch.last);
        }
        begun_ = added.load();
        report(true);
        return clean_at_ > 0 || added == job_.total();
    }
    double seconds() const { return seconds_since(start_); }
    /// Samples a pixel with which the picture was clean enough; 0: it was not, or nobody asked.
    int clean_at() const { return clean_at_; }

  private:
    /// Asked when each pixel has so many samples.
    bool clean_after(int samples) {
        if (!(options_.noise > 0) || samples < least_noise_samples) return false;
        const double noise = film_noise(job_.film());
        if (noise <= options_.noise) clean_at_ = samples;
        const double ratio = noise / options_.noise;
        needed_ = std::min(double(job_.total()), double(job_.total(samples)) * ratio * ratio);
        return clean_at_ > 0;
    }

    bool goes_on() {
        if (interrupted()) return false;
        if (const std::uint64_t n = ++begun_; n % 16 == 0) report(false);
        return true;
    }
    bool interrupted() {
        if (options_.stop && options_.stop->load(std::memory_order_relaxed)) stopped_ = true;
        if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) stopped_ = true;
        return stopped_;
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
        const double now = seconds();
        if (!last && now - last_report_ < interval_s) return;
        last_report_ = now;
        std::uint64_t done = begun_.load(), total = job_.total();
        // How many samples it takes to a noise is an estimate, known after the first.
        if (options_.noise > 0) {
            const double needed = needed_;
            total = needed > 0 ? std::max(std::uint64_t(needed), done + 1) : total;
            if (clean_at_ > 0) total = done;
        }
        options_.progress({done, total, now});
    }

    RenderJob& job_;
    const RenderOptions& options_;
    const Clock::time_point deadline_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> begun_{0};
    std::atomic<bool> stopped_{false};
    std::atomic<double> needed_{0};
    int clean_at_ = 0;
    std::mutex report_mutex_;
    double last_report_ = 0;
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

}  // namespace

RenderResult render(const Scene& scene, const Integrator& integrator, const FrameSettings& frame,
                    const RenderOptions& options) {
    return with_threads(options.threads, [&] {
        RenderJob job(scene, integrator, frame);
        if (options.begun) job.go_on_from(*options.begun);
        if (options.halves) job.keep_halves();
        const double cpu = process_cpu_seconds();
        RenderLoop loop(job, options);
        const bool complete = [&] {
            const Checkpoints checkpoints(options.checkpoint ? options.checkpoint_s : 0, [&] {
                const RayCounts counts = job.counts_so_far();
                const Film film = job.snapshot();
                options.checkpoint({film, counts, loop.seconds(), process_cpu_seconds() - cpu});
            });
            return loop.run();
        }();
        RenderResult result{.film = std::move(job.film()),
                            .sampler = frame.sampler,
                            .integrator = scene.integrator.type,
                            .complete = complete};
        if (loop.clean_at() > 0) result.sampler.samples = loop.clean_at();
        if (options.noise > 0)
            if (const double noise = film_noise(result.film); std::isfinite(noise))
                result.noise = noise;
        result.seconds = loop.seconds();
        result.cpu_seconds = process_cpu_seconds() - cpu;
        result.counts = job.counts();
        result.halves = job.take_halves();
        return result;
    });
}

RenderResult render(const Scene& scene, const Integrator& integrator,
                    const RenderOptions& options) {
    return render(scene, integrator, FrameSettings::of(scene), options);
}

RenderResult prepare_and_render(const std::function<RenderPrepared(const Work& work)>& prepare,
                                const FrameSettings& frame, const RenderOptions& options) {
    return with_threads(options.threads, [&] {
        const Clock::time_point start = Clock::now(), deadline = deadline_after(options.timeout_s);
        const double cpu_start = process_cpu_seconds();
        RenderResult result{.film = Film(frame.film), .sampler = frame.sampler, .complete = false};
        RenderPrepared rendering;
        try {
            const Work work(options.stop, deadline, told_of(options));
            rendering = prepare(work);
        } catch (const Stopped&) {
        }
        const double seconds = seconds_since(start),
                     cpu_seconds = process_cpu_seconds() - cpu_start;
        if (rendering) {
            RenderOptions rest = options;
            rest.threads = 0;  // those of this arena
            if (options.timeout_s > 0) rest.timeout_s = std::max(1e-9, options.timeout_s - seconds);
            result = rendering(rest);
        }
        result.precompute_seconds = seconds;
        result.precompute_cpu_seconds = cpu_seconds;
        return result;
    });
}

RenderResult render(const Scene& scene, const RenderOptions& options) {
    return prepare_and_render(
        [&scene](const Work& work) {
            return [&scene, integrator = std::shared_ptr<const Integrator>(
                                make_integrator(scene, work))](const RenderOptions& rest) {
                RenderResult result = render(scene, *integrator, rest);
                result.statistics = integrator->statistics();
                return result;
            };
        },
        FrameSettings::of(scene), options);
}

}  // namespace nacre
