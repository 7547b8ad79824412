// nacre render: a scene file, or a mesh in a measured translucent medium, as a picture.
#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/render_and_save.h"
#include "apps/cli/scene_input.h"
#include "apps/cli/streams.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/scene/stage.h"
#include "nacre/techniques/techniques.h"

namespace nacre::cli {
namespace {

struct RenderArguments {
    SceneInput input;
    FilmOptions film;
    FinishOptions finish;
    std::string output, crop, integrator, technique, profile;
    std::vector<std::string> set;
    int threads = 0, spp = 0;
    std::uint64_t seed = 0;
    double timeout = 0;
    float exposure = 0;
    bool strict = false, quiet = false, json = false, variance = false;
    bool no_distance_grid = false, no_guided_exits = false;
};

void set_crop(FilmSettings& film, const std::string& text) {
    int* const places[] = {&film.crop_x, &film.crop_y, &film.crop_width, &film.crop_height};
    std::size_t begin = 0;
    for (int i = 0; i < 4; ++i) {
        const std::size_t end = i < 3 ? text.find(',', begin) : text.size();
        const auto n = end == text.npos
                           ? std::nullopt
                           : whole_in(std::string_view(text).substr(begin, end - begin));
        if (!n || *n < (i < 2 ? 0 : 1) || *n > most_pixels_a_side)
            throw InputError(fmt::format(
                "--crop: '{}' is not a window; write x,y,width,height in pixels", text));
        *places[i] = int(*n);
        begin = end + 1;
    }
}

/// By the scene's own techniques, or --technique, --profile and --set.
RenderPlan plan(const Scene& scene, const RenderArguments& o, const CLI::App& app) {
    if (o.technique.empty()) {
        for (const char* option : {"--profile", "--set"})
            if (app.count(option))
                throw InputError(
                    fmt::format("{} belongs to --technique, which is missing", option));
        return plan_of(scene);
    }
    if (!o.integrator.empty())
        throw InputError("give either --technique or --integrator: the one chooses the other");
    TechniqueChoice choice{o.technique};
    if (!o.profile.empty()) choice.options.emplace_back("profile", o.profile);
    for (const std::string& text : o.set) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == text.npos)
            throw InputError(fmt::format("--set: '{}' is not of the form name=value", text));
        choice.options.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return plan_of(scene, choice);
}

int run(const RenderArguments& o, const CLI::App& app, const Invocation& invocation) {
    // What is wrong with the command line is said before anything is read, and what is wrong with
    // the output before anything is rendered.
    SaveOptions save;
    save.output = o.output.empty()
                      ? std::filesystem::path(o.input.scene).stem().replace_extension(".exr")
                      : std::filesystem::path(o.output);
    check_image_output(save.output);
    check_finish(o.finish, save.output);
    if (o.finish.denoise && o.film.resume)
        throw InputError(
            "--denoise compares two halves of the samples of one run, which a kept film does not "
            "hold; leave out --resume");
    save.finish = o.finish;

    std::vector<std::filesystem::path> read;
    Scene scene = load(o.input, app, &read, &save.pose);
    refuse_input_as_output(save.output, read);
    if (o.film.keeps()) refuse_input_as_output(film_path(save.output), read);
    if (!o.crop.empty()) set_crop(scene.film, o.crop);
    if (o.spp) scene.sampler.samples = o.spp;
    save.film = o.film;
    if (o.film.noise > 0) {
        save.film.samples_given = o.spp > 0;
        if (!o.spp && scene.sampler.type == "stratified")
            throw InputError(
                "--noise: the sampler 'stratified' has to know how many samples there will be; "
                "give the most by --spp, or choose 'independent'");
        if (!o.spp) scene.sampler.samples = most_samples;
    }
    check_samples(o.finish, scene.sampler.samples);
    if (app.count("--seed")) scene.sampler.seed = o.seed;
    if (!o.integrator.empty()) scene.integrator.type = o.integrator;
    if (o.no_distance_grid) scene.integrator.distance_grid = false;
    if (o.no_guided_exits) scene.integrator.guided_exits = false;
    if (o.variance) scene.integrator.moment = true;
    save.scene_file = o.input.scene;
    save.threads = o.threads;
    save.timeout_s = o.timeout;
    save.exposure = o.exposure;
    save.strict = o.strict;
    save.quiet = o.quiet;
    save.json = o.json;
    if (save.pose && !(app.count("--up") && app.count("--view")))
        save.remark = sentence_about(*save.pose);
    return render_and_save(scene, plan(scene, o, app), save, invocation);
}

}  // namespace

Action set_up_render(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<RenderArguments>();
    app.add_option("scene", o->input.scene,
                   "scene (.xml) or mesh (.ply, .obj, .stl, .off, .glb, ...)")
        ->required();
    app.add_option("-o,--output", o->output,
                   "picture: .exr, .pfm, .hdr or .png (default: name of the scene, .exr)");
    add_scene_options(app, o->input);
    add_threads(app, o->threads);
    add_samples(app, o->spp, "samples a pixel, instead of the scene's");
    add_seed(app, o->seed, "of the random numbers, instead of the scene's");
    app.add_option("--crop", o->crop, "x,y,width,height: render only this part of the film");
    add_timeout(app, o->timeout);
    add_film_options(app, o->film);
    app.add_option("--integrator", o->integrator, "ray, path or volpath, instead of the scene's");
    app.add_option("--technique", o->technique,
                   fmt::format("how translucent shapes are rendered: {}",
                               fmt::join(techniques().names(), ", ")));
    app.add_option("--profile", o->profile,
                   "diffusion profile of the technique (dipole); see 'nacre models'");
    app.add_option("--set", o->set, "name=value: an option of the technique")
        ->allow_extra_args(false);
    add_number(app, "--exposure", o->exposure, {-100, 100}, "stops, for .png");
    app.add_flag("--variance", o->variance, "also write the variance of one sample (EXR)");
    add_finish_options(app, o->finish);
    app.add_flag("--strict", o->strict,
                 "fail, and write nothing, if any sample is not finite or negative");
    app.add_flag("--no-distance-grid", o->no_distance_grid,
                 "volpath: trace a ray for every scattering (same picture, slower)");
    app.add_flag("--no-guided-exits", o->no_guided_exits,
                 "volpath: do not guide light out of media (same picture, noisier)");
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    app.add_flag("--json", o->json, "a summary for programs on standard output");
    app.footer("\nsettings of --camera, --env and --light:\n" + stage_help() + app.get_footer());
    return [o, &app, invocation] { return run(*o, app, invocation); };
}

}  // namespace nacre::cli
