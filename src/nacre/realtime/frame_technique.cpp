// Frames in real time as pictures of a film: each sample of all pixels is one frame, shifted by the
// filter's draw and lit from other places on the lamps. So a picture of many samples is what the
// technique comes to, without steps at edges, and its noise can be told.
#include <charconv>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/realtime/frame_renderer.h"
#include "nacre/realtime/frame_sample.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/render/filter.h"
#include "nacre/render/noise.h"
#include "nacre/render/render_clock.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/photometry.h"
#include "nacre/technique/technique.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

class FrameTechnique final : public Technique {
  public:
    FrameTechnique(const TechniqueInput& input, const Work& work) : scene_(input.scene) {
        const HeadlessContext::Use use(context_);
        gpu_ = std::make_unique<Gpu>();
        for (const ShapeTechnique& s : input.shapes)
            if (s.technique) {
                name_ = s.technique->name;
                options_ = frame_options_of(s.options);
            }
        renderer_ = std::make_unique<FrameRenderer>(*gpu_, scene_, input.shapes, work);
        gpu_->finish();
        name_ += " on " + gpu_->device().text();
    }
    ~FrameTechnique() override {
        const HeadlessContext::Use use(context_);
        renderer_.reset();
        gpu_.reset();
    }

    RenderResult render(const FrameSettings& frame, const RenderOptions& options) override;

    void changed(const Changes& what, const Work& work) override {
        const HeadlessContext::Use use(context_);
        renderer_->changed(what, work);
    }
    Statistics statistics() const override {
        return {{"device memory", double(renderer_->bytes()) * 1e-6, "MB"}};
    }

  private:
    void add(Film& film, const std::vector<float>& rgba, std::uint32_t sample, float weight) const;

    const Scene& scene_;
    HeadlessContext context_;
    std::string name_;
    FrameOptions options_;
    std::unique_ptr<Gpu> gpu_;
    std::unique_ptr<FrameRenderer> renderer_;
};

RenderResult FrameTechnique::render(const FrameSettings& frame, const RenderOptions& rendering) {
    const Clock::time_point start = Clock::now(), deadline = deadline_after(rendering.timeout_s);
    const double cpu = process_cpu_seconds();
    if (!frame.camera) throw InputError("the scene has no camera; add a <sensor>");
    if (frame.film.quantity == FilmQuantity::illuminance)
        throw InputError("frames in real time hold radiance or luminance, not illuminance");
    const HeadlessContext::Use use(context_);
    RenderResult result{.film = Film(frame.film), .sampler = frame.sampler, .integrator = name_};
    const int samples = frame.sampler.samples;
    if (samples < 1)
        throw InputError(
            fmt::format("{} samples a pixel make no picture; ask for at least 1", samples));
    std::uint32_t done = 0;
    if (rendering.begun) {
        result.film.merge(*rendering.begun);
        done = result.film.drawn(0, 0);
    }
    if (rendering.halves)
        for (int i = 0; i < 2; ++i) result.halves.emplace_back(frame.film);
    const Filter filter(frame.film.filter);
    const std::uint32_t first = first_frame(frame.sampler.seed);
    const std::uint32_t total = std::uint32_t(samples);
    double checkpoint = 0;
    std::vector<PassTime> passes;  // of the last frame
    for (; done < total; ++done) {
        if ((rendering.stop && rendering.stop->load()) || Clock::now() >= deadline) {
            result.complete = false;
            break;
        }
        const FilterSample at = frame_sample(filter, frame.sampler.seed, done);
        const View view =
            camera_view(*frame.camera, frame.film, at.offset, renderer_->scene().bounds());
        const bool last = done + 1 == total;
        if (last) gpu_->begin_timing();
        FrameOptions options = options_;
        options.index = first + done;
        const Texture& picture = renderer_->render(view, options);
        if (last) passes = gpu_->end_timing();
        const std::vector<float> rgba = picture.read();
        gpu_->check_errors();
        add(result.film, rgba, done, at.weight);
        if (rendering.halves) add(result.halves[done % 2], rgba, done, at.weight);
        const double seconds = seconds_since(start);
        if (rendering.progress) {
            const std::uint64_t pixels =
                std::uint64_t(result.film.width()) * std::uint64_t(result.film.height());
            rendering.progress({(done + 1) * pixels, total * pixels, seconds});
        }
        if (rendering.checkpoint && seconds - checkpoint >= rendering.checkpoint_s) {
            checkpoint = seconds;
            rendering.checkpoint({result.film, {}, seconds, process_cpu_seconds() - cpu});
        }
        if (rendering.noise > 0 && int(done + 1) >= least_noise_samples &&
            film_noise(result.film) <= rendering.noise) {
            result.sampler.samples = int(++done);
            break;
        }
    }
    if (rendering.noise > 0)
        if (const double noise = film_noise(result.film); std::isfinite(noise))
            result.noise = noise;
    result.seconds = seconds_since(start);
    result.cpu_seconds = process_cpu_seconds() - cpu;
    result.statistics = statistics();
    for (const PassTime& pass : passes)
        result.statistics.push_back({"pass " + pass.name, pass.ms, "ms"});
    return result;
}

void FrameTechnique::add(Film& film, const std::vector<float>& rgba, std::uint32_t sample,
                         float weight) const {
    const bool luminous = film.settings().quantity == FilmQuantity::luminance;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const float* p =
                &rgba[4 * (std::size_t(y) * std::size_t(film.width()) + std::size_t(x))];
            Vec3f rgb{p[0], p[1], p[2]};
            if (luminous) {
                const float value = luminance(rgb) * photometric_scale;
                rgb = {value, value, value};
            }
            film.add(x, y, sample, rgb, weight);
        }
}

}  // namespace

FrameOptions frame_options_of(const ParameterValues& options) {
    FrameOptions frame{.light_points = options.whole("light_points")};
    std::from_chars(options.word("light_view").data(),
                    options.word("light_view").data() + options.word("light_view").size(),
                    frame.light_view);
    return frame;
}

TechniqueDescription realtime_description(TechniqueDescription description) {
    description.parameters.push_back(
        {.name = "light_points",
         .meaning = "places that stand for lamps with extent and the sky in a frame",
         .kind = ParameterKind::integer,
         .low = 1,
         .high = 1024,
         .otherwise = 8});
    description.parameters.push_back(
        choice_parameter("light_view", "width of a light's picture, texels",
                         {{"128", ""}, {"256", ""}, {"512", ""}, {"1024", ""}, {"2048", ""}}, 2));
    description.keeps = {.view = true, .light = true, .material = true, .geometry = true};
    description.prepare = [](const TechniqueInput& input, const Work& work) -> TechniquePtr {
        return std::make_unique<FrameTechnique>(input, work);
    };
    return description;
}

}  // namespace nacre
