// nacre merge: what was rendered apart, with other seeds or in other windows, as one picture.
#include <CLI/CLI.hpp>

#include "apps/cli/film_keeper.h"
#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/render/noise.h"
#include "nacre/render/output.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
    std::vector<std::string> states;
    std::string output;
    float exposure = 0;
    bool quiet = false;
};

RenderState load(const std::string& file) {
    std::error_code error;
    if (!is_film_path(file) && fs::exists(film_path(file), error))
        throw InputError(fmt::format("{}: is a picture; its film's state is {}: merge that", file,
                                     film_path(file).string()));
    return RenderState::load(file);
}

void check_there(const RenderState& all) {
    std::size_t empty = 0;
    for (int y = 0; y < all.film.height(); ++y)
        for (int x = 0; x < all.film.width(); ++x) empty += all.film.drawn(x, y) == 0;
    if (empty > 0)
        say("nacre: warning: {} pixels have no samples: no state has their part of the film\n",
            empty);
}

int run(const MergeArguments& o, const Invocation& invocation) {
    const fs::path picture = o.output, kept = film_path(picture);
    check_image_output(picture);
    refuse_input_as_output(picture, {o.states.begin(), o.states.end()});
    refuse_input_as_output(kept, {o.states.begin(), o.states.end()});
    std::vector<RenderState> states;
    for (const std::string& file : o.states) states.push_back(load(file));
    RenderState all = merge(std::move(states), o.states);
    check_there(all);
    RenderState::save(all.film, all, kept);
    const double noise = film_noise(all.film);
    if (picture != kept) {
        Scene scene;  // for what pictures say of it
        scene.mode =
            all.identity["mode"] == "spectral" ? ColorMode::spectral : ColorMode::rgb_bands;
        scene.integrator.moment = true;
        RenderResult result{.film = std::move(all.film),
                            .sampler = {all.identity["sampler"], all.samples, all.parts[0].seed},
                            .integrator = all.integrator,
                            .complete = all.complete,
                            .seconds = all.seconds,
                            .cpu_seconds = all.cpu_seconds};
        result.counts = all.counts;
        if (std::isfinite(noise)) result.noise = noise;
        save_render(result, scene, picture, {invocation.command_line, version, ""}, o.exposure);
        if (!o.quiet) say("nacre: wrote {}\n", picture.string());
    }
    if (!o.quiet) {
        say("nacre: kept {}: {} render{}, up to {} samples a pixel\n", kept.string(),
            all.parts.size(), all.parts.size() == 1 ? "" : "s", all.samples);
        if (std::isfinite(noise)) say("nacre: noise {:.3g} %\n", 100 * noise);
    }
    return success;
}

}  // namespace

Action set_up_merge(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<MergeArguments>();
    app.add_option(
           "states", o->states,
           "NAME.film.exr that render --checkpoint or --film-state kept: of one picture, of "
           "different seeds or windows (--crop)")
        ->required();
    app.add_option("-o,--output", o->output,
                   "picture; NAME.film.exr, from which to merge again, goes beside it. A name that "
                   "ends in .film.exr: that alone")
        ->required();
    add_number(app, "--exposure", o->exposure, {-100, 100}, "stops, for .png");
    app.add_flag("--quiet", o->quiet, "only warnings and errors");
    return [o, invocation] { return run(*o, invocation); };
}

}  // namespace nacre::cli
