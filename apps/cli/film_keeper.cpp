#include "apps/cli/film_keeper.h"

#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {

namespace fs = std::filesystem;

void add_film_options(CLI::App& app, FilmOptions& o) {
    add_duration(app, "--checkpoint", o.checkpoint_s,
                 "keep what is rendered that often, as NAME.film.exr beside the picture: 60s, 5m");
    app.add_option_function<std::vector<std::string>>(
           "--resume",
           [&o](const std::vector<std::string>& files) {
               o.resume = true;
               if (!files.empty()) o.resume_from = files.front();
           },
           "go on with NAME.film.exr, or with another state; goes behind the scene")
        ->expected(0, 1)
        ->type_name("[FILE]");
    app.add_flag("--film-state", o.keep,
                 "keep NAME.film.exr at the end, for --resume with more --spp, and for merge");
    add_share(app, "--noise", o.noise,
              "render until the picture has no more noise than that: 1%; --spp is then the most");
}

bool is_film_path(const fs::path& file) { return file.string().ends_with(".film.exr"); }

fs::path film_path(const fs::path& picture) {
    fs::path r = picture;
    return is_film_path(r) ? r : r.replace_extension(".film.exr");
}

FilmKeeper::FilmKeeper(const FilmOptions& options, const fs::path& picture, const Scene& scene,
                       const RenderPlan& plan)
    : options_(options),
      file_(film_path(picture)),
      sampler_(scene.sampler),
      about_{Film(scene.film)} {
    if (!options_.keeps()) return;
    if (is_film_path(picture))
        throw InputError(
            fmt::format("{}: is what the film's state is called; name the picture otherwise, by -o",
                        picture.string()));
    check_output_file(file_);
    about_.identity = identity_of(scene, plan, FrameSettings::of(scene));
    about_.identity["nacre"] = version;
    about_.integrator = plan.integrator;
    std::error_code error;
    const bool there = fs::exists(file_, error);
    if (!options_.resume) {
        if (there)
            say("nacre: {} of an earlier render will be replaced; --resume goes on with it\n",
                file_.string());
        return;
    }
    if (!options_.resume_from.empty())
        take_up(options_.resume_from);
    else if (there)
        take_up(file_);
    else if (options_.checkpoint_s > 0)
        say("nacre: {} is not there yet: the render begins anew\n", file_.string());
    else
        throw InputError(
            fmt::format("{}: is not there to go on with; --checkpoint or --film-state keep it. "
                        "Leave out --resume to begin anew",
                        file_.string()));
}

void FilmKeeper::take_up(const fs::path& file) {
    RenderState state = RenderState::load(file);
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: cannot be gone on with: {}", file.string(), why));
    };
    const std::string different = differences(state.identity, about_.identity);
    if (!different.empty())
        refuse(fmt::format("it shows another picture; what differs: {}", different));
    if (state.parts.size() != 1)
        refuse(
            fmt::format("it was merged of {} renders; render another --seed and merge that with it",
                        state.parts.size()));
    const RenderPart there = state.parts.front(), here = part_of(about_.film, sampler_.seed);
    if (there.seed != here.seed)
        refuse(
            fmt::format("its seed is {}, not {}; give --seed {}, or render the other seed by "
                        "itself and merge both",
                        there.seed, here.seed, there.seed));
    const auto window = [](const RenderPart& p) {
        return fmt::format("{},{},{},{}", p.x, p.y, p.width, p.height);
    };
    if (window(there) != window(here))
        refuse(fmt::format("its part of the film is {}, not {}; give the same --crop",
                           window(there), window(here)));
    if (there.samples > sampler_.samples)
        refuse(
            fmt::format("it has {} samples a pixel already, more than the {} that are asked "
                        "for; ask for more by --spp",
                        there.samples, sampler_.samples));
    begun_ = std::move(state);
}

void FilmKeeper::save(const Film& film, bool complete, double seconds, double cpu_seconds,
                      RayCounts counts) const {
    RenderState state{Film(film.settings()), about_.identity, {part_of(film, sampler_.seed)}};
    state.integrator = about_.integrator;
    state.complete = complete;
    // Of a render to a noise nobody knows how many samples it will take.
    const bool open = options_.noise > 0 && !options_.samples_given;
    state.samples = complete || open ? state.parts.front().samples : sampler_.samples;
    state.seconds = seconds;
    state.cpu_seconds = cpu_seconds;
    state.counts = counts;
    RenderState::save(film, state, file_);
}

void FilmKeeper::ask(RenderOptions& o) {
    if (begun_) o.begun = &begun_->film;
    o.noise = options_.noise;
    if (options_.checkpoint_s == 0) return;
    o.checkpoint_s = options_.checkpoint_s;
    o.checkpoint = [this](const RenderCheckpoint& c) {
        try {
            RayCounts counts = c.counts;
            if (begun_) counts += begun_->counts;
            save(c.film, false, c.seconds + (begun_ ? begun_->seconds : 0),
                 c.cpu_seconds + (begun_ ? begun_->cpu_seconds : 0), counts);
        } catch (const std::exception& error) {
            if (!told_)
                say("nacre: warning: {}; the render goes on, and what was kept before stays\n",
                    error.what());
            told_ = true;
        }
    };
}

bool FilmKeeper::finish(RenderResult& result, bool quiet) {
    if (begun_) {
        result.seconds += begun_->seconds;
        result.cpu_seconds += begun_->cpu_seconds;
        result.counts += begun_->counts;
    }
    if (!options_.keeps()) return true;
    try {
        save(result.film, result.complete, result.seconds, result.cpu_seconds, result.counts);
    } catch (const std::exception& error) {
        say("nacre: {}\n", error.what());
        return false;
    }
    if (!quiet)
        say("nacre: kept {}{}\n", file_.string(),
            result.complete ? "" : ", with which --resume goes on");
    return true;
}

}  // namespace nacre::cli
