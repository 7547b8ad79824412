// nacre view: a translucent object in a window, or pictures of what the window would show.
#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/scene_input.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#ifdef NACRE_REALTIME
#include "apps/viewer/view.h"
#endif

namespace nacre::cli {
namespace {

struct ViewArguments {
    SceneInput input;
    std::string screenshot, script;
    int frames = 1, light_view = 0, light_points = 0;
    double ui_scale = 0;
    bool quiet = false;
};

#ifdef NACRE_REALTIME
int run_view(const ViewArguments& o, const CLI::App& app, const Invocation& invocation) {
    viewer::ViewOptions options{.screenshot = o.screenshot,
                                .script = o.script,
                                .frames = o.frames,
                                .light_view = o.light_view,
                                .light_points = o.light_points,
                                .ui_scale = o.ui_scale,
                                .command_line = invocation.command_line,
                                .version = version};
    if (o.screenshot.empty()) {
        if (app.count("--frames"))
            throw InputError("--frames belongs to --screenshot, which is missing");
        std::tie(options.width, options.height) = std::pair{800, 800};
    } else {
        check_image_output(o.screenshot);
    }
    if (o.light_view) viewer::checked_light_view(o.light_view);
    std::vector<std::filesystem::path> read;
    Scene scene = load(o.input, app, &read);
    if (!o.screenshot.empty()) refuse_input_as_output(o.screenshot, read);
    // A window has the size of the scene's film only if somebody asked for it.
    if (!o.screenshot.empty() || !o.input.size.empty())
        std::tie(options.width, options.height) = std::pair{scene.film.width, scene.film.height};
    for (const std::string& w : scene.warnings) say("nacre: warning: {}\n", w);
    if (!o.quiet) options.say = [](const std::string& text) { say("nacre: {}\n", text); };
    std::optional<ColorMode> mode;
    if (!o.input.mode.empty()) mode = scene.mode;
    const std::string name = std::filesystem::path(o.input.scene).filename().string();
    viewer::view(viewer::ViewerScene(std::move(scene), name, mode), options);
    return success;
}
#else
int run_view(const ViewArguments&, const CLI::App&, const Invocation&) {
    throw InputError(
        "this nacre was built without techniques in real time (NACRE_REALTIME=OFF), which "
        "'nacre view' needs; 'nacre render' makes pictures of the same scenes");
}
#endif

}  // namespace

Action set_up_view(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<ViewArguments>();
    app.add_option("scene", o->input.scene,
                   "scene (.xml) or mesh (.ply, .obj, .stl, .off, .glb, ...)")
        ->required();
    add_scene_options(app, o->input);
    app.add_option("--screenshot", o->screenshot,
                   "no window: write this picture (.png, .exr, .pfm, .hdr) and end");
    add_whole(app, "--frames", o->frames, 1, 1000000, "frames in the mean of the screenshot (1)");
    app.add_option("--script", o->script,
                   "file of commands, one a line: technique, light, orbit, material, deform, ...");
    add_whole(app, "--light-view", o->light_view, 64, 4096,
              "width of a light's picture, a power of 2 (512; in software 256)");
    add_whole(app, "--light-points", o->light_points, 1, 64,
              "places on lamps in a frame (8; in software 2)");
    add_number(app, "--ui-scale", o->ui_scale, {0.5, 4},
               "of letters and controls, instead of the screen's");
    app.add_flag("--quiet", o->quiet, "only warnings and errors");
    return [o, &app, invocation] { return run_view(*o, app, invocation); };
}

}  // namespace nacre::cli
