#include "nacre/compare/reference.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/metrics/metrics.h"
#include "nacre/render/film_state.h"
#include "nacre/scene/content_key.h"
#include "nacre/techniques/missing_light.h"
#include "nacre/text/number.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

// Seeds of references lie apart from those of the pictures that are compared with them, or their
// noise would be the same.
constexpr std::uint64_t reference_stream = 0x7265666572656e63ull;  // "referenc"
constexpr int first_round = 16;
// What is lost if it is stopped: a round takes about this long once the speed is known.
constexpr double round_seconds = 20;

/// The samples of all rounds.
struct Rounds {
    std::optional<Film> film;
    int samples = 0, count = 0;
    double cpu_seconds = 0;

    void add(Film&& round, int n) {
        if (film)
            film->merge(round);
        else
            film = std::move(round);
        samples += n;
        ++count;
    }

    void save(const std::filesystem::path& file, const std::string& key) const {
        FilmState::save(*film, notes(key), file);
    }
    /// What was kept under that key; nothing if the file holds something else. Throws InputError if
    /// it is damaged.
    static std::optional<Rounds> load(const std::filesystem::path& file, const std::string& key,
                                      const FilmSettings& settings) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) return {};
        FilmState state = FilmState::load(file);
        if (state.notes["key"] != key) return {};
        const auto number = [&](const char* name, double least, double most) {
            const auto n = parse_number(state.notes[name]);
            if (!n || !(*n >= least && *n <= most))
                throw InputError(fmt::format("it holds {} = '{}'", name, state.notes[name]));
            return *n;
        };
        Rounds r;
        r.samples = int(number("samples", 1, 2e9));
        r.count = int(number("rounds", 1, 2e9));
        r.cpu_seconds = number("cpu_seconds", 0, 1e15);
        r.film = Film(settings);  // which another film cannot be added to
        r.film->merge(state.film);
        return r;
    }

    /// With the variance of one sample.
    Image picture(const std::string& key) const {
        Image image(film->width(), film->height(),
                    {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
        for (int y = 0; y < film->height(); ++y)
            for (int x = 0; x < film->width(); ++x) {
                const Vec3f mean = film->mean(x, y), variance = film->sample_variance(x, y);
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y, c) = mean[c];
                    image.at(x, y, 3 + c) = variance[c];
                }
            }
        for (const auto& [name, value] : notes(key)) image.metadata["nacre." + name] = value;
        return image;
    }
    Image variance_of_mean() const {
        Image image(film->width(), film->height());
        for (int y = 0; y < film->height(); ++y)
            for (int x = 0; x < film->width(); ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) = film->sample_variance(x, y)[c] / float(samples);
        return image;
    }

  private:
    std::map<std::string, std::string> notes(const std::string& key) const {
        return {{"samples", fmt::to_string(samples)},
                {"complete", "yes"},
                {"rounds", fmt::to_string(count)},
                {"cpu_seconds", fmt::format("{:.3f}", cpu_seconds)},
                {"key", key}};
    }
};

/// What was kept, or nothing: a file that is damaged is set aside, and the reason told.
std::optional<Rounds> take_up(const std::filesystem::path& file, const std::string& key,
                              const FilmSettings& film, const ReferenceOptions& options) {
    try {
        return Rounds::load(file, key, film);
    } catch (const std::exception& error) {
        const std::filesystem::path aside = file.string() + ".damaged";
        std::error_code failed;
        std::filesystem::rename(file, aside, failed);
        if (options.warn)
            options.warn(fmt::format("the kept reference is damaged ({}): it is {} and made anew",
                                     error.what(),
                                     failed ? "left out" : "set aside as " + aside.string()));
        return {};
    }
}

}  // namespace

double block_standard_error(const Image& picture, const Image& variance, const PixelMask& mask,
                            int block) {
    MetricOptions options;
    options.block = block;
    const Metrics m = compare({picture, &variance}, {picture}, mask, options);
    if (m.block.blocks == 0)
        throw InputError(fmt::format(
            "no block of {0} x {0} pixels lies wholly on the object: render a larger picture",
            block));
    return std::sqrt(m.block.mean_square.noise.value_or(0.));
}

Reference make_reference(const Scene& scene, const PixelMask& mask,
                         const ReferenceOptions& options) {
    if (!(options.error > 0)) throw InputError("the error of a reference must be positive");
    if (techniques().find(options.technique.technique).simulates) require_lit_insides(scene);
    RenderPlan plan = plan_of(scene, options.technique);
    FrameSettings frame = FrameSettings::of(scene);
    frame.sampler.type = "independent";  // whose variance is known
    const TechniqueSetting setting{options.technique, 0};
    const std::string key = fmt::format("{} {} film", content_key(scene), setting.id());

    Reference reference;
    Rounds sum;
    if (!options.store.empty()) {
        make_output_folder(options.store);
        reference.file = options.store / fmt::format("{:016x}.exr", hash_bytes(key));
        if (!options.fresh)
            if (auto kept = take_up(reference.file, key, frame.film, options))
                sum = std::move(*kept);
    }

    const auto stopped = [&] { return options.stop && options.stop->load(); };
    double wall_per_sample = 0;
    reference.reused = true;
    while (true) {
        double needed = first_round;
        if (sum.samples > 0) {
            reference.error =
                block_standard_error(sum.picture(key), sum.variance_of_mean(), mask, options.block);
            const double ratio = reference.error / options.error;
            needed = sum.samples * ratio * ratio;
            reference.reached = reference.error <= options.error;
        }
        // What is needed is an estimate: nothing is finished before the noise is small enough.
        if (options.progress)
            options.progress(reference.reached ? 1 : std::min(0.99, sum.samples / needed),
                             reference.error);
        if (reference.reached || stopped()) break;
        // The estimate of the noise is noisy itself: it may at most double what there is.
        double n = std::clamp(std::ceil(1.02 * needed) - sum.samples, 4.,
                              std::max(16., double(sum.samples)));
        if (wall_per_sample > 0) n = std::min(n, std::max(4., round_seconds / wall_per_sample));
        frame.sampler.samples = int(n);
        plan.seed = frame.sampler.seed = stream_key(reference_stream, std::uint64_t(sum.count));
        RenderOptions render_options;
        render_options.threads = options.threads;
        render_options.stop = options.stop;
        if (options.progress)
            render_options.progress = [&](const RenderProgress& p) {
                const double now = sum.samples + (p.phase.empty() ? n * p.share() : 0.);
                options.progress(std::min(0.99, now / needed), reference.error);
            };
        RenderResult result = render(scene, plan, frame, render_options);
        if (!result.complete) break;
        sum.add(std::move(result.film), frame.sampler.samples);
        sum.cpu_seconds += result.cpu_seconds + result.precompute_cpu_seconds;
        wall_per_sample = result.seconds / frame.sampler.samples;
        reference.reused = false;
        if (!reference.file.empty()) sum.save(reference.file, key);
    }
    reference.samples = sum.samples;
    reference.cpu_seconds = sum.cpu_seconds;
    if (sum.samples > 0) {
        reference.picture = sum.picture(key);
        reference.variance = sum.variance_of_mean();
    }
    return reference;
}

}  // namespace nacre
