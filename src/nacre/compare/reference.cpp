#include "nacre/compare/reference.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/metrics/metrics.h"
#include "nacre/scene/content_key.h"
#include "nacre/subsurface/missing_light.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

// Seeds of references lie apart from those of the pictures that are compared with them, or their
// noise would be the same.
constexpr std::uint64_t reference_stream = 0x7265666572656e63ull;  // "referenc"
constexpr int first_round = 16;
// What is lost if it is stopped: a round takes about this long once the speed is known.
constexpr double round_seconds = 20;

const char* const names[] = {"R", "G", "B"};

/// Sums over the samples of all rounds.
struct Accumulation {
    Image mean, variance;  ///< the variance of one sample
    int samples = 0, rounds = 0;
    double cpu_seconds = 0;

    void add(const Film& film, int n) {
        if (samples == 0) {
            mean = Image(film.width(), film.height());
            variance = mean;
        }
        const double total = samples + n;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) {
                const Vec3f m = film.mean(x, y), v = film.sample_variance(x, y);
                for (int c = 0; c < 3; ++c) {
                    // Chan, Golub and LeVeque 1979: sums of squares about the means of two parts.
                    const double difference = double(m[c]) - mean.at(x, y, c);
                    const double squares = double(variance.at(x, y, c)) * std::max(0, samples - 1) +
                                           double(v[c]) * (n - 1) +
                                           difference * difference * samples * n / total;
                    mean.at(x, y, c) = float(mean.at(x, y, c) + difference * n / total);
                    variance.at(x, y, c) = float(squares / (total - 1));
                }
            }
        samples += n;
        ++rounds;
    }

    Image variance_of_mean() const {
        Image v = variance;
        for (float& x : v.data) x /= float(samples);
        return v;
    }

    Image to_image(const std::string& key) const {
        Image image(mean.width, mean.height,
                    {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
        for (int y = 0; y < mean.height; ++y)
            for (int x = 0; x < mean.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y, c) = mean.at(x, y, c);
                    image.at(x, y, 3 + c) = variance.at(x, y, c);
                }
        image.metadata = {{"nacre.samples", fmt::to_string(samples)},
                          {"nacre.complete", "yes"},
                          {"nacre.rounds", fmt::to_string(rounds)},
                          {"nacre.cpu_seconds", fmt::format("{:.3f}", cpu_seconds)},
                          {"nacre.key", key}};
        return image;
    }

    /// What was kept under that key; nothing if the file holds something else. Throws InputError if
    /// it is damaged.
    static std::optional<Accumulation> read(const std::filesystem::path& file,
                                            const std::string& key, int width, int height) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) return {};
        const Image image = read_image(file, {.any_channels = true});
        const auto value = [&](const char* name) {
            const auto at = image.metadata.find(std::string("nacre.") + name);
            return at == image.metadata.end() ? std::string() : at->second;
        };
        if (value("key") != key) return {};
        Accumulation a;
        const auto damaged = [](const std::string& what) { return InputError("it holds " + what); };
        const auto number = [&](const char* name, double least, double most) {
            const std::string text = value(name);
            double x = 0;
            const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), x);
            if (wrong != std::errc() || end != text.data() + text.size() ||
                !(x >= least && x <= most))
                throw damaged(fmt::format("{} = '{}'", name, text));
            return x;
        };
        a.samples = int(number("samples", 1, 2e9));
        a.rounds = int(number("rounds", 1, 2e9));
        a.cpu_seconds = number("cpu_seconds", 0, 1e15);
        if (image.width != width || image.height != height)
            throw damaged(fmt::format("{} x {} pixels", image.width, image.height));
        a.mean = Image(image.width, image.height);
        a.variance = a.mean;
        for (int c = 0; c < 3; ++c) {
            const int m = image.channel(names[c]),
                      v = image.channel(std::string("variance.") + names[c]);
            if (m < 0 || v < 0) throw damaged("no variances");
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) {
                    a.mean.at(x, y, c) = image.at(x, y, m);
                    a.variance.at(x, y, c) = image.at(x, y, v);
                    if (!std::isfinite(image.at(x, y, m)) || !(image.at(x, y, v) >= 0.f))
                        throw damaged("values that are not numbers");
                }
        }
        return a;
    }
};

/// What was kept, or nothing: a file that is damaged is set aside, and the reason told.
std::optional<Accumulation> take_up(const std::filesystem::path& file, const std::string& key,
                                    const FilmSettings& film, const ReferenceOptions& options) {
    const bool cropped = film.crop_width > 0;
    try {
        return Accumulation::read(file, key, cropped ? film.crop_width : film.width,
                                  cropped ? film.crop_height : film.height);
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

Reference make_reference(Scene& scene, const PixelMask& mask, const ReferenceOptions& options) {
    if (!(options.error > 0)) throw InputError("the error of a reference must be positive");
    if (!find_technique(options.technique.technique).make) require_lit_insides(scene);
    const WithSetting as_reference(scene, options.technique);
    scene.sampler.type = "independent";  // whose variance is known
    scene.integrator.moment = true;
    const TechniqueSetting setting{options.technique, 0};
    const std::string key = fmt::format("{} {}", content_key(scene), setting.id());

    Reference reference;
    Accumulation sum;
    if (!options.store.empty()) {
        make_output_folder(options.store);
        reference.file = options.store / fmt::format("{:016x}.exr", hash_bytes(key));
        if (!options.fresh)
            if (auto kept = take_up(reference.file, key, scene.film, options))
                sum = std::move(*kept);
    }

    const auto stopped = [&] { return options.stop && options.stop->load(); };
    double wall_per_sample = 0;
    reference.reused = true;
    while (true) {
        double needed = first_round;
        if (sum.samples > 0) {
            reference.error =
                block_standard_error(sum.mean, sum.variance_of_mean(), mask, options.block);
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
        scene.sampler.samples = int(n);
        scene.sampler.seed = stream_key(reference_stream, std::uint64_t(sum.rounds));
        RenderOptions render_options;
        render_options.threads = options.threads;
        render_options.stop = options.stop;
        if (options.progress)
            render_options.progress = [&](const RenderProgress& p) {
                const double now = sum.samples + (p.phase.empty() ? n * p.share() : 0.);
                options.progress(std::min(0.99, now / needed), reference.error);
            };
        const RenderResult result = render_with(scene, make_technique_integrator, render_options);
        if (!result.complete) break;
        sum.add(result.film, scene.sampler.samples);
        sum.cpu_seconds += result.cpu_seconds + result.precompute_cpu_seconds;
        wall_per_sample = result.seconds / scene.sampler.samples;
        reference.reused = false;
        if (!reference.file.empty()) write_image(sum.to_image(key), reference.file);
    }
    reference.samples = sum.samples;
    reference.cpu_seconds = sum.cpu_seconds;
    if (sum.samples > 0) {
        reference.picture = sum.to_image(key);
        reference.variance = sum.variance_of_mean();
    }
    return reference;
}

}  // namespace nacre
