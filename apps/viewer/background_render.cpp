#include "apps/viewer/background_render.h"

#include <algorithm>
#include <utility>

namespace nacre::viewer {

BackgroundRender::BackgroundRender(BackgroundJob job) : job_(std::move(job)) {
    thread_ = std::thread([this] {
        try {
            run();
        } catch (const Stopped&) {
        } catch (...) {
            const std::lock_guard lock(mutex_);
            error_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        ended_ = true;
        changed_.notify_all();
    });
}

BackgroundRender::~BackgroundRender() {
    stop_ = true;
    thread_.join();
}

void BackgroundRender::run() {
    const Work work(&stop_, Work::Clock::time_point::max(), {});
    const TechniquePtr technique = prepare(*job_.scene, plan_of(*job_.scene, job_.technique), work);
    FrameSettings frame = job_.frame;
    frame.film.quantity = FilmQuantity::radiance;
    // Its strata would have to be known before.
    if (frame.sampler.type == "stratified") frame.sampler.type = "independent";
    RenderOptions options;
    options.threads = job_.threads;
    options.stop = &stop_;
    options.checkpoint_s = 0.25;
    Film begun(frame.film);
    int samples = 0;
    options.checkpoint = [&](const RenderCheckpoint& c) { publish(c.film, samples); };
    const int wanted = job_.samples > 0 ? job_.samples : 1 << 24;
    while (!stop_ && samples < wanted) {
        // As many again as there are, so that ever fewer copies are made.
        frame.sampler.samples = std::min({2 * samples + 1, samples + 64, wanted});
        if (samples > 0) options.begun = &begun;
        RenderResult result = technique->render(frame, options);
        if (!result.complete) break;
        samples = frame.sampler.samples;
        begun = std::move(result.film);
        publish(begun, samples);
    }
}

void BackgroundRender::publish(const Film& film, int samples) {
    Picture next{.rgba = {}, .samples = samples};
    next.rgba.reserve(4 * std::size_t(film.width()) * std::size_t(film.height()));
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f c = film.mean(x, y);
            next.rgba.insert(next.rgba.end(), {c.x, c.y, c.z, film.count(x, y) ? 1.f : 0.f});
        }
    const std::lock_guard lock(mutex_);
    picture_ = std::move(next);
    fresh_ = true;
    changed_.notify_all();
}

bool BackgroundRender::take(Picture& picture) {
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (!fresh_) return false;
    fresh_ = false;
    picture = std::move(picture_);
    return true;
}

void BackgroundRender::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ended_; });
}

}  // namespace nacre::viewer
