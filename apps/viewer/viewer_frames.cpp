#include "apps/viewer/viewer_frames.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/realtime/frame_sample.h"
#include "nacre/spectrum/photometry.h"

namespace nacre::viewer {
namespace {

using Clock = std::chrono::steady_clock;

/// For so long nothing changes before a picture that takes long is begun.
constexpr auto settled_after = std::chrono::milliseconds(200);

/// Whether frames of either state belong to one average, but for the technique and the size.
bool same_picture(const ViewerState& a, const ViewerState& b) {
    return a.camera == b.camera && a.material == b.material && a.lights == b.lights &&
           a.deformation == b.deformation && a.quality == b.quality && a.samples == b.samples;
}

}  // namespace

/// One side: of its technique either the frames or the render in the background.
struct ViewerFrames::Half {
    TechniqueChoice choice;
    FilmSettings film;  // its part of the picture
    std::unique_ptr<FrameRenderer> renderer;
    std::unique_ptr<BackgroundRender> background;
    BackgroundRender::Picture picture;
    Texture uploaded;
    bool fresh = true;  // its average begins
    int samples = 0;
};

ViewerFrames::ViewerFrames(Gpu& gpu, const ViewerScene& scene, Patience patience)
    : gpu_(gpu), given_(scene), patience_(patience) {
    constexpr int steps = 256;
    std::vector<float> colors;
    for (int i = 0; i < steps; ++i) {
        const Vec3f c = false_color(float(i) / (steps - 1));
        colors.insert(colors.end(), {c.x, c.y, c.z, 1.f});
    }
    scale_ = Texture(TexelFormat::rgba32f, steps, 1);
    scale_.upload(colors);
}

ViewerFrames::~ViewerFrames() = default;

void ViewerFrames::make_scene(const ViewerState& state) {
    for (auto& half : halves_) half.reset();
    moving_lights_ = false;
    const SceneParts parts = given_.parts_of(state);
    scene_ = std::make_shared<Scene>(rebuild(given_.scene, parts.root, parts.meshes, given_.mode));
    built_lights_ = scene_->lights;
}

void ViewerFrames::update_scene(const ViewerState& state, bool first) {
    const bool lights_move = !first && state.lights != last_.lights;
    if (first || state.material != last_.material ||
        (patience_ == Patience::all_samples && lights_move)) {
        make_scene(state);
    } else if (lights_move) {
        // At once, without what mirrors show of lamps: that follows when they stay.
        for (auto& half : halves_)
            if (half) half->background.reset();  // it reads the scene
        scene_->lights = moved_lights(given_.scene, given_.lights, state.lights,
                                      state.camera.compass(), Vec3d(given_.object.center()));
        moving_lights_ = true;
    } else if (moving_lights_ && Clock::now() - changed_ > settled_after) {
        make_scene(state);
    }
}

std::shared_ptr<const Scene> ViewerFrames::shown_scene(const ViewerState& state) {
    if (state.deformation.kind == Deformation::Kind::none) return scene_;
    const SceneParts parts = given_.parts_of(state);
    int left_out = 0;
    const SceneMeshes bent = deformed(given_.scene, parts.meshes, state.deformation, &left_out);
    if (left_out > 0)
        throw InputError(
            "only techniques in real time bend spheres, disks and cylinders: give a mesh, or no "
            "deformation");
    return std::make_shared<Scene>(rebuild(given_.scene, parts.root, bent, given_.mode));
}

const Texture& ViewerFrames::render(const ViewerState& state, int width, int height) {
    const bool first = !has_last_;
    has_last_ = false;
    const bool resized = width != width_ || height != height_;
    if (resized || !picture_.is(width, height)) {
        picture_ = Texture(TexelFormat::rgba32f, width, height);
        picture_.upload(std::vector<float>(4 * std::size_t(width) * std::size_t(height), 0.f));
    }
    width_ = width;
    height_ = height;
    if (first || resized || !same_picture(state, last_)) {
        changed_ = Clock::now();
        for (auto& half : halves_)
            if (half) half->fresh = true;
    }
    update_scene(state, first);
    first_width_ = width;
    if (state.split && width > 1)
        first_width_ = std::clamp(int(std::lround(state.divider * width)), 1, width - 1);
    // Its frames are kept for when it comes back; what takes long need not go on.
    if (!state.split && halves_[1]) halves_[1]->background.reset();
    sides_.clear();
    last_ = state;
    for (int i = 0; i < (first_width_ < width ? 2 : 1); ++i) {
        if (!halves_[i]) halves_[i] = std::make_unique<Half>();
        show(*halves_[i], state, i ? state.beside : state.technique, i ? first_width_ : 0,
             i ? width - first_width_ : first_width_);
    }
    gpu_.check_errors();
    has_last_ = true;
    return picture_;
}

void ViewerFrames::show(Half& half, const ViewerState& state, const TechniqueChoice& choice,
                        int column, int width) {
    FilmSettings film = given_.scene.film;
    film.quantity = FilmQuantity::radiance;
    film.width = width_;
    film.height = height_;
    film.crop_x = column;
    film.crop_y = 0;
    film.crop_width = width;
    film.crop_height = height_;
    if (film.crop_x != half.film.crop_x || film.crop_width != half.film.crop_width ||
        film.height != half.film.height) {
        half.fresh = true;
        changed_ = Clock::now();
    }
    half.film = film;
    if (!same(half.choice, choice)) half.fresh = true;
    if (is_realtime(choice))
        show_realtime(half, state, choice, column);
    else
        show_background(half, state, choice, column);
    sides_.push_back({choice.technique, half.samples, half.samples == 0});
}

void ViewerFrames::show_realtime(Half& half, const ViewerState& state,
                                 const TechniqueChoice& choice, int column) {
    half.background.reset();
    const bool other = !same(half.choice, choice);
    if (!half.renderer)
        half.renderer =
            std::make_unique<FrameRenderer>(gpu_, *scene_, plan_of(*scene_, choice).shapes);
    else if (other)
        half.renderer->set_techniques(plan_of(*scene_, choice).shapes);
    half.choice = choice;
    half.renderer->deform(state.deformation);
    if (half.fresh || !state.quality.average) half.samples = 0;
    half.fresh = false;
    const std::uint64_t seed = given_.scene.sampler.seed;
    const std::uint32_t index = std::uint32_t(half.samples);
    const FilterSample at = frame_sample(Filter(half.film.filter), seed, index);
    const CameraPtr camera = state.camera.camera(double(width_) / height_);
    const View view = camera_view(*camera, half.film, at.offset, half.renderer->scene().bounds());
    pixel_ = view.pixel;
    parallel_ = view.parallel;
    const Texture& frame = half.renderer->render(view, {.index = first_frame(seed) + index,
                                                        .light_points = state.quality.light_points,
                                                        .light_view = state.quality.light_view});
    ++half.samples;
    add(frame, column, 1.f / float(half.samples), at.weight);
}

void ViewerFrames::show_background(Half& half, const ViewerState& state,
                                   const TechniqueChoice& choice, int column) {
    half.renderer.reset();
    const CameraPtr camera = state.camera.camera(double(width_) / height_);
    if (half.fresh || !same(half.choice, choice)) {
        half.background.reset();
        half.samples = 0;
    }
    half.choice = choice;
    half.fresh = false;
    const View view = camera_view(*camera, half.film, {0, 0}, scene_->rays.bounds());
    pixel_ = view.pixel;
    parallel_ = view.parallel;
    if (!half.background) {
        // What was there stays in sight until something comes.
        const bool settled =
            patience_ == Patience::all_samples || Clock::now() - changed_ > settled_after;
        if (!settled || moving_lights_) return;
        BackgroundJob job{shown_scene(state), choice, {camera, half.film, given_.scene.sampler}};
        // One core is left for frames and for the window.
        if (patience_ == Patience::none)
            job.threads = std::max(1, int(std::thread::hardware_concurrency()) - 1);
        else
            job.samples = state.samples;
        half.background = std::make_unique<BackgroundRender>(std::move(job));
    }
    if (patience_ == Patience::all_samples) half.background->wait();
    if (!half.background->take(half.picture)) return;
    half.samples = half.picture.samples;
    if (!half.uploaded.is(half.film.crop_width, height_))
        half.uploaded = Texture(TexelFormat::rgba32f, half.film.crop_width, height_);
    half.uploaded.upload(half.picture.rgba);
    add(half.uploaded, column, 1, 1);
}

void ViewerFrames::add(const Texture& frame, int column, float share, float weight) {
    gpu_.compute("average", gpu_.program("average.glsl"))
        .reads(0, frame)
        .writes(1, picture_)
        .set("column", column)
        .set("share", share)
        .set("weight", weight)
        .threads(frame.width(), frame.height());
}

bool ViewerFrames::goes_on() const {
    return moving_lights_ || last_.quality.average ||
           std::ranges::any_of(sides_,
                               [](const Side& side) { return !is_realtime({side.technique}); });
}

const Texture& ViewerFrames::shown(const ViewerState& state) {
    const Display& d = state.display;
    if (d.quantity == Quantity::illuminance && parallel_)
        throw InputError(
            "false colours in lx need a camera whose rays part: of parallel rays no solid angle "
            "can be told; choose cd/m^2");
    if (!shown_.is(width_, height_)) shown_ = Texture(TexelFormat::rgba8, width_, height_);
    gpu_.compute("display", gpu_.program("display.glsl"))
        .reads(0, picture_)
        .reads(1, scale_)
        .writes(2, shown_)
        .set("gain", std::exp2(d.exposure))
        .set("quantity", int(d.quantity))
        .set("photometric", photometric_scale)
        .set("low", float(std::log10(d.low)))
        .set("high", float(std::log10(d.high)))
        .set("pixel_width", pixel_)
        .set("divider", state.split ? first_width_ : -1)
        .threads(width_, height_);
    return shown_;
}

Image ViewerFrames::image() const {
    const std::vector<float> rgba = picture_.read();
    Image image(width_, height_);
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
        for (std::size_t c = 0; c < 3; ++c) image.data[3 * i + c] = rgba[4 * i + c];
    return image;
}

std::size_t ViewerFrames::bytes() const {
    std::size_t sum = picture_.bytes() + shown_.bytes() + scale_.bytes();
    for (const auto& half : halves_) {
        if (!half) continue;
        sum += half->uploaded.bytes();
        if (half->renderer) sum += half->renderer->bytes();
    }
    return sum;
}

}  // namespace nacre::viewer
