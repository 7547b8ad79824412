#include "apps/cli/render_and_save.h"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "apps/cli/interrupt.h"
#include "apps/cli/output_file.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/streams.h"
#include "nacre/math/error.h"
#include "nacre/render/output.h"
#include "nacre/techniques/missing_light.h"

namespace nacre::cli {
namespace {

std::pair<std::uint32_t, std::uint32_t> sample_range(const Film& film) {
    std::uint32_t least = ~0u, most = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            least = std::min(least, film.count(x, y));
            most = std::max(most, film.count(x, y));
        }
    return {least, most};
}

void print_json(const RenderResult& r, const Scene& scene, const std::vector<std::string>& warnings,
                const std::filesystem::path& file, const Finish& finish,
                const std::optional<MeshPose>& pose) {
    Vec3d mean;
    for (int y = 0; y < r.film.height(); ++y)
        for (int x = 0; x < r.film.width(); ++x) mean += Vec3d(r.film.mean(x, y));
    mean = mean / (double(r.film.width()) * r.film.height());
    const auto [least, most] = sample_range(r.film);
    nlohmann::ordered_json json{{"output", file.string()},
                                {"complete", r.complete},
                                {"denoised", finish.denoised},
                                {"width", r.film.width()},
                                {"height", r.film.height()},
                                {"samples", r.sampler.samples},
                                {"fewest_samples", least},
                                {"most_samples", most},
                                {"seed", r.sampler.seed},
                                {"mode", scene.mode == ColorMode::spectral ? "spectral" : "rgb"},
                                {"integrator", r.integrator},
                                {"seconds", r.seconds},
                                {"cpu_seconds", r.cpu_seconds},
                                {"precompute_seconds", r.precompute_seconds},
                                {"precompute_cpu_seconds", r.precompute_cpu_seconds},
                                {"rays", r.counts.rays},
                                {"scatterings", r.counts.scatterings},
                                {"invalid_samples", r.film.invalid_count()},
                                {"mean", {mean.x, mean.y, mean.z}},
                                {"warnings", warnings}};
    if (r.noise) json["noise"] = *r.noise;
    for (const Statistic& s : r.statistics) json["statistics"][s.name] = s.value;
    if (pose)
        json["pose"] = {{"up", name_of(pose->up)},
                        {"up_by_shape", pose->up_by_shape},
                        {"front", name_of(pose->front)},
                        {"front_by_shape", pose->front_by_shape}};
    fmt::print("{}\n", json.dump(2));
}

/// Before the system kills the program for it.
void refuse_too_large(const FilmSettings& film) {
    const bool cropped = film.crop_width > 0;
    const double width = cropped ? film.crop_width : film.width,
                 height = cropped ? film.crop_height : film.height;
    // Sums and squares in double, and the image that is written.
    constexpr double bytes_a_pixel = 80;
    const double needed = width * height * bytes_a_pixel,
                 there = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
    if (there > 0 && needed > there)
        throw InputError(fmt::format(
            "a picture of {:.0f} x {:.0f} pixels takes {:.1f} GB of memory, and this machine has "
            "{:.1f}: render it in parts (--crop), or smaller (--size)",
            width, height, needed / 1e9, there / 1e9));
}

}  // namespace

int render_and_save(const Scene& scene, const RenderPlan& plan, const SaveOptions& options,
                    const Invocation& invocation) {
    const std::vector<std::string> warnings = warnings_of(scene, plan);
    for (const std::string& w : warnings) say("nacre: warning: {}\n", w);
    refuse_too_large(scene.film);
    FilmKeeper keeper(options.film, options.output, scene, plan);
    const std::atomic<bool>& stop = interrupt_flag();
    RenderResult result = [&] {
        ProgressBar bar(options.quiet);
        RenderOptions o;
        o.threads = options.threads;
        o.timeout_s = options.timeout_s;
        o.stop = &stop;
        o.halves = options.finish.denoise;
        o.progress = [&](RenderProgress p) {
            if (p.phase.empty()) p.seconds += keeper.seconds_before();
            bar.show(p);
        };
        keeper.ask(o);
        return render(scene, plan, FrameSettings::of(scene), o);
    }();

    // A sliver of a cell at a rim is no thin part.
    if (options.strict)
        for (const Statistic& s : result.statistics)
            if (s.name == "unresolved_surface" && s.value > 0.01)
                throw RunError(fmt::format(
                    "{:.2g} % of the surface is of parts thinner than two cells of the diffusion "
                    "grid; --strict: {} was not written; set cells to more",
                    s.value, options.output.string()));
    const std::string invalid = describe_invalid(result.film);
    if (!invalid.empty() && options.strict)
        throw RunError(
            fmt::format("{}; --strict: {} was not written", invalid, options.output.string()));
    if (!invalid.empty()) say("nacre: warning: {}\n", invalid);

    const auto [least, most] = sample_range(result.film);
    const bool stopped = stop.load() && !result.complete;
    if (!result.complete && most == 0) {
        const bool prepared = result.seconds > 0;
        say("nacre: {} {}: nothing was rendered, nothing was written\n",
            stopped ? "interrupted" : "timeout",
            prepared ? "before the first sample" : "during precomputation");
        return stopped ? interrupted : failure;
    }
    const bool kept = keeper.finish(result, options.quiet);
    const bool open = options.film.noise > 0 && !options.film.samples_given;
    if (open && !result.complete) result.sampler.samples = int(most);
    const std::filesystem::path file =
        stopped ? unused_name(partial_path(options.output)) : options.output;
    Image picture =
        render_image(result, scene, {invocation.command_line, version, options.scene_file});
    // Whoever interrupts does not want to wait for more.
    const Finish finish =
        stopped ? Finish{}
                : finish_picture(picture, result, scene, options.finish, options.threads, stop);
    write_image(picture, file, options.exposure);
    if (!result.complete)
        say("nacre: {} with {} to {} {}samples a pixel\n", stopped ? "interrupted" : "timeout",
            least, most, open ? "" : fmt::format("of {} ", scene.sampler.samples));
    if (result.noise && (*result.noise > options.film.noise || !options.quiet))
        say("nacre: {}noise {:.3g} %{} with {} samples a pixel\n",
            *result.noise > options.film.noise ? "warning: " : "", 100 * *result.noise,
            *result.noise > options.film.noise
                ? fmt::format(", more than the {:g} % asked for,", 100 * options.film.noise)
                : "",
            least);
    if (!options.quiet)
        say("nacre: wrote {} ({}{} x {}, {} wall, {} CPU, {:.1f} M rays)\n", file.string(),
            finish.denoised ? "denoised, " : "", result.film.width(), result.film.height(),
            format_seconds(result.seconds + result.precompute_seconds + finish.seconds),
            format_seconds(result.cpu_seconds + result.precompute_cpu_seconds + finish.cpu_seconds),
            static_cast<double>(result.counts.rays) / 1e6);
    if (!options.quiet && !options.remark.empty()) say("nacre:   {}\n", options.remark);
    if (!options.quiet)
        for (const Statistic& s : result.statistics)
            say("nacre:   {} {:g} {}\n", s.name, s.value, s.unit);
    if (options.json) print_json(result, scene, warnings, file, finish, options.pose);
    return stopped ? interrupted : kept ? success : failure;
}

}  // namespace nacre::cli
