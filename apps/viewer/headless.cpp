#include "apps/viewer/headless.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/viewer/save_scene.h"
#include "apps/viewer/script.h"
#include "apps/viewer/viewer_frames.h"
#include "nacre/math/error.h"
#include "nacre/spectrum/color.h"

namespace nacre::viewer {
namespace {

/// The share of a second that a frame of an animation takes in scripts.
constexpr float frame_seconds = 1.f / 30;

class HeadlessView {
  public:
    HeadlessView(const ViewerScene& scene, const ViewOptions& options)
        : scene_(scene), options_(options), state_(scene.state()) {
        if (options.light_view) state_.quality.light_view = checked_light_view(options.light_view);
        if (options.light_points) state_.quality.light_points = options.light_points;
    }

    void run() {
        std::vector<ScriptLine> lines;
        if (!options_.script.empty()) lines = read_script(options_.script, scene_);
        const HeadlessContext::Use use(context_);
        Gpu gpu;
        options_.say(fmt::format("device: {}", gpu.device().text()));
        ViewerFrames frames(gpu, scene_, Patience::all_samples);
        for (const ScriptLine& line : lines) try {
                follow(line, frames);
            } catch (const InputError& error) {
                throw InputError(
                    fmt::format("{}:{}: {}", options_.script.string(), line.number, error.what()));
            }
        gpu.begin_timing();
        render(frames, options_.frames);
        const std::vector<PassTime> passes = gpu.end_timing();
        screenshot(frames, options_.screenshot);
        for (const auto& side : frames.sides())
            options_.say(fmt::format("{}: {} {}", side.technique, side.samples,
                                     is_realtime({side.technique}) ? "frames" : "samples a pixel"));
        for (const PassTime& p : passes)
            options_.say(fmt::format("pass {} {:g} ms", p.name, p.ms / options_.frames));
    }

  private:
    void follow(const ScriptLine& line, ViewerFrames& frames) {
        const Step step = obey(line.text, scene_, state_);
        switch (step.kind) {
            case Step::Kind::change:
                break;
            case Step::Kind::frames:
                render(frames, step.frames);
                break;
            case Step::Kind::screenshot:
                if (!current_) render(frames, 1);
                screenshot(frames, step.file);
                break;
            case Step::Kind::save: {
                const SavedScene saved =
                    save_scene(scene_, state_, options_.width, options_.height, step.file);
                options_.say(fmt::format("wrote {}", saved_text(saved)));
                break;
            }
        }
        current_ = step.kind != Step::Kind::change;
    }

    static std::string saved_text(const SavedScene& saved) {
        std::vector<std::string> names;
        for (const auto& file : saved.files) names.push_back(file.string());
        std::string text = fmt::format("{}", fmt::join(names, ", "));
        if (!saved.left_out.empty())
            text += fmt::format("; left out: {}", fmt::join(saved.left_out, "; "));
        return text;
    }

    void render(ViewerFrames& frames, int count) {
        for (int i = 0; i < count; ++i) {
            if (state_.animated) state_.deformation.phase += swing_per_second * frame_seconds;
            frames.render(state_, options_.width, options_.height);
        }
    }

    void screenshot(ViewerFrames& frames, const std::filesystem::path& file) {
        write_screenshot(frames, state_, options_, file);
        options_.say(fmt::format("wrote {}", file.string()));
    }

    const ViewerScene& scene_;
    const ViewOptions& options_;
    ViewerState state_;
    HeadlessContext context_;
    bool current_ = false;  // the picture is that of the state
};

}  // namespace

void view_headless(const ViewerScene& scene, const ViewOptions& options) {
    HeadlessView(scene, options).run();
}

void write_screenshot(ViewerFrames& frames, const ViewerState& state, const ViewOptions& options,
                      const std::filesystem::path& file) {
    const bool is_png = file.extension() == ".png";
    Image image = frames.image();
    if (is_png && state.display.quantity != Quantity::color) {
        // As on the screen, line and all; values of PNG files are written through the sRGB curve.
        const Texture& shown = frames.shown(state);
        const std::vector<float> rgba = shown.read();
        for (std::size_t i = 0; i < rgba.size() / 4; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                image.data[3 * i + c] = srgb_decode(rgba[4 * i + c]);
    }
    image.metadata["nacre.command"] = options.command_line;
    image.metadata["nacre.version"] = options.version;
    for (const auto& side : frames.sides())
        image.metadata[&side == frames.sides().data() ? "nacre.integrator"
                                                      : "nacre.integrator_beside"] =
            fmt::format("{}, {} samples", side.technique, side.samples);
    write_image(image, file,
                is_png && state.display.quantity == Quantity::color ? state.display.exposure : 0.f);
}

}  // namespace nacre::viewer
