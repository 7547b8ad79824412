#include "apps/cli/finish_picture.h"

#include <CLI/CLI.hpp>
#include <ctime>

#include "nacre/math/error.h"
#include "nacre/render/denoised.h"
#include "nacre/render/threads.h"

namespace nacre::cli {
namespace {

bool has_layers(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension == ".exr";
}

}  // namespace

void add_finish_options(CLI::App& app, FinishOptions& options) {
    app.add_flag("--denoise", options.denoise,
                 "take the noise out (biased; an .exr keeps the picture as it was as layer noisy)");
    app.add_flag("--aovs", options.auxiliary,
                 "also write auxiliary images, as denoisers and compositors want them: albedo, "
                 "normal, depth (EXR layers)");
}

void check_finish(const FinishOptions& options, const std::filesystem::path& output) {
    if (options.auxiliary && !has_layers(output))
        throw InputError(
            fmt::format("--aovs: {} has no layers for albedo, normal and depth; write an .exr (-o)",
                        output.string()));
}

void check_samples(const FinishOptions& options, int samples) {
    if (options.denoise && samples < 2)
        throw InputError(
            "--denoise: 1 sample a pixel does not tell noise from picture; take at least 2 "
            "(--spp), better 16");
}

Finish finish_picture(Image& picture, const RenderResult& result, const Scene& scene,
                      const FinishOptions& options, int threads, const std::atomic<bool>& stop) {
    Finish done;
    if (!options.auxiliary && !options.denoise) return done;
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    FrameSettings frame = FrameSettings::of(scene);
    frame.film = result.film.settings();
    const Work work(&stop, Work::Clock::time_point::max(), {});
    try {
        with_threads(threads, [&] {
            const AuxiliaryImages auxiliary = render_auxiliary(scene, frame, work);
            if (options.denoise) {
                put_denoised(picture, denoised(result, auxiliary, work), "nfor");
                done.denoised = true;
            }
            if (options.auxiliary) add_auxiliary_channels(picture, auxiliary);
        });
    } catch (const Stopped&) {
        return done;
    }
    done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    done.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
    return done;
}

}  // namespace nacre::cli
