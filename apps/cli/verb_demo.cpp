// nacre demo: the built-in scene, so that a fresh build has something to show.
#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/render_and_save.h"
#include "apps/cli/scene_input.h"
#include "nacre/image/image.h"
#include "nacre/scene/demo_scene.h"

namespace nacre::cli {
namespace {

struct DemoArguments {
    std::string output = "demo.png", size = "480x640";
    int spp = 0, threads = 0;
    double timeout = 45;
    bool quiet = false, no_denoise = false;
};

int run(const DemoArguments& o, const Invocation& invocation) {
    SaveOptions save;
    save.output = o.output;
    check_image_output(save.output);
    const auto [width, height] = parse_size("--size", o.size);
    Scene scene = make_demo_scene(width, height);
    // As many as two cores make in two thirds of a minute: the filter does with fewer.
    if (!o.no_denoise)
        scene.sampler.samples =
            static_cast<int>(std::clamp(10e6 / (double(width) * height), 8., 64.));
    if (o.spp) scene.sampler.samples = o.spp;
    save.scene_file = "demo";
    save.threads = o.threads;
    save.timeout_s = o.timeout;
    save.quiet = o.quiet;
    save.finish.denoise = !o.no_denoise;
    const int code = render_and_save(scene, plan_of(scene), save, invocation);
    if (code == success) fmt::print("{}\n", std::filesystem::absolute(save.output).string());
    return code;
}

}  // namespace

Action set_up_demo(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<DemoArguments>();
    app.add_option("-o,--output", o->output, "picture: .png, .exr, .pfm or .hdr")
        ->capture_default_str();
    app.add_option("--size", o->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    add_samples(app, o->spp, "samples a pixel");
    add_threads(app, o->threads);
    add_timeout(app, o->timeout)->default_str("45");
    app.add_flag("--no-denoise", o->no_denoise,
                 "the picture as its samples make it, with their noise");
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    return [o, invocation] { return run(*o, invocation); };
}

}  // namespace nacre::cli
