#include "nacre/compare/measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/metrics/machine.h"

namespace nacre {
namespace {

Image picture_of(const Film& film) {
    Image image(film.width(), film.height());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f m = film.mean(x, y);
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = m[c];
        }
    return image;
}

void measure_into(Measurement& m, const Scene& scene, const TechniqueSetting& setting,
                  const MeasurementOptions& options) {
    RenderPlan plan = plan_of(scene, setting.choice);
    FrameSettings frame = FrameSettings::of(scene);
    frame.sampler.samples = setting.samples;
    const PeakMemory memory;
    std::vector<Image> frames;
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
        if (options.stop && options.stop->load()) return;
        plan.seed = frame.sampler.seed = frame_seed(options.seed, repeat);
        RenderOptions render_options;
        render_options.threads = options.threads;
        render_options.stop = options.stop;
        if (options.progress)
            render_options.progress = [&](const RenderProgress& p) {
                // Precomputation is no share of the samples: the repeat has only begun.
                const double share = p.phase.empty() ? p.share() : 0.;
                options.progress((repeat + share) / options.repeats);
            };
        const RenderResult r = render(scene, plan, frame, render_options);
        if (!r.complete) return;
        frames.push_back(picture_of(r.film));
        m.timings.push_back(
            {r.seconds, r.cpu_seconds, r.precompute_seconds, r.precompute_cpu_seconds});
        m.invalid_samples += r.film.invalid_count();
        if (repeat == 0) m.statistics = r.statistics;
    }
    m.memory_mb = memory.mb();
    set_pictures(m, frames);
    m.status = Measurement::Status::done;
}

}  // namespace

double Measurement::median_of(double Timing::*what) const {
    std::vector<double> values;
    for (const Timing& t : timings) values.push_back(t.*what);
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::uint64_t frame_seed(std::uint64_t seed, int repeat) {
    return stream_key(seed, std::uint64_t(repeat));
}

void set_pictures(Measurement& m, const std::vector<Image>& frames) {
    m.frame = frames[0];
    m.mean = Image(frames[0].width, frames[0].height);
    m.variance = m.mean;
    const double n = double(frames.size());
    for (std::size_t i = 0; i < m.mean.data.size(); ++i) {
        double sum = 0, squares = 0;
        for (const Image& f : frames) sum += f.data[i];
        for (const Image& f : frames) {
            const double d = f.data[i] - sum / n;
            squares += d * d;
        }
        m.mean.data[i] = float(sum / n);
        m.variance.data[i] = float(squares / (n - 1) / n);
    }
}

Measurement measure(const Scene& scene, const TechniqueSetting& setting,
                    const MeasurementOptions& options) {
    if (options.repeats < 2)
        throw InputError(fmt::format(
            "{} repeats do not tell noise from bias; at least 2 are needed", options.repeats));
    Measurement m;
    m.id = setting.id();
    m.samples = setting.samples;
    try {
        measure_into(m, scene, setting, options);
    } catch (const std::bad_alloc&) {
        m.status = Measurement::Status::failed;
        m.why = "out of memory";
    } catch (const std::exception& error) {
        m.status = Measurement::Status::failed;
        m.why = error.what();
    }
    return m;
}

}  // namespace nacre
