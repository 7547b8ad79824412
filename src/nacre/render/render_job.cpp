#include "nacre/render/render_job.h"

#include <xmmintrin.h>

#include <bit>

#include "nacre/math/error.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/photometry.h"

namespace nacre {
namespace {

/// Denormal numbers become zero while it lives (Embree's advice: they cost a hundred times an
/// ordinary operation). Set for every tile on whatever thread runs it, so that a number does not
/// depend on the thread.
class FlushDenormals {
  public:
    FlushDenormals() : before_(_mm_getcsr()) {
        constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
        _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
    }
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned before_;
};

/// Solid angle of the triangle of three unit vectors (Van Oosterom and Strackee 1983, The Solid
/// Angle of a Plane Triangle, IEEE Transactions on Biomedical Engineering 30(2)).
double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Side of a tile. Small enough that the last tiles of a pass keep all threads busy, large enough
/// that neighbouring rays share the caches.
constexpr int tile_side = 16;
/// Samples a pixel gets in one pass at most: an interrupted picture is even to within that many.
constexpr int largest_pass = 16;

}  // namespace

RenderJob::RenderJob(const Scene& scene, const Integrator& integrator, const FrameSettings& frame)
    : scene_(scene),
      integrator_(integrator),
      camera_(frame.camera),
      film_(frame.film),
      filter_(frame.film.filter),
      sampler_(Sampler::kind_from_name(frame.sampler.type), frame.sampler.seed,
               frame.sampler.samples),
      samples_(frame.sampler.samples),
      columns_((film_.width() + tile_side - 1) / tile_side),
      rows_((film_.height() + tile_side - 1) / tile_side),
      total_(total(std::max(0, samples_))),
      tile_mutexes_(std::make_unique<std::mutex[]>(std::size_t(columns_) * rows_)) {
    if (!camera_) throw InputError("the scene has no camera; add a <sensor>");
    if (samples_ < 1)
        throw InputError(
            fmt::format("{} samples a pixel make no picture; ask for at least 1", samples_));
    if (frame.film.quantity == FilmQuantity::illuminance &&
        !(pixel_solid_angle(film_.settings().crop_x, film_.settings().crop_y) > 0))
        throw InputError(
            "illuminance needs a camera whose pixels see a solid angle: its rays are "
            "parallel; use a perspective camera or ask for luminance");
}

void RenderJob::go_on_from(const Film& film) {
    film_.merge(film);
    goes_on_ = true;
}

std::uint64_t RenderJob::drawn() const {
    std::uint64_t n = 0;
    for (int y = 0; y < film_.height(); ++y)
        for (int x = 0; x < film_.width(); ++x)
            n += std::min(film_.drawn(x, y), std::uint32_t(samples_));
    return n;
}

int RenderJob::least_drawn() const {
    std::uint32_t least = std::uint32_t(samples_);
    for (int y = 0; y < film_.height(); ++y)
        for (int x = 0; x < film_.width(); ++x) least = std::min(least, film_.drawn(x, y));
    return int(least);
}

Film RenderJob::snapshot() {
    Film copy(film_.settings());
    for (int i = 0; i < tile_count(); ++i) {
        const Tile t = tile(i);
        const std::lock_guard lock(tile_mutexes_[i]);
        copy.copy_pixels(film_, t.x0, t.y0, t.x1, t.y1);
    }
    copy.copy_invalid(film_);
    return copy;
}

RayCounts RenderJob::counts_so_far() {
    const std::lock_guard lock(mutex_);
    return counts_;
}

void RenderJob::keep_halves() {
    // Small enough that the halves of an interrupted picture are nearly equal.
    constexpr unsigned longest = 16;
    block_ = std::bit_floor(std::clamp(unsigned(samples_) / 4, 1u, longest));
    for (int i = 0; i < 2; ++i) halves_.emplace_back(film_.settings());
}

Tile RenderJob::tile(int index) const {
    const int x = index % columns_ * tile_side, y = index / columns_ * tile_side;
    return {x, y, std::min(x + tile_side, film_.width()), std::min(y + tile_side, film_.height())};
}

SampleRange RenderJob::batch_after(int samples) const {
    return {samples, std::min({samples_, std::max(1, 2 * samples), samples + largest_pass})};
}

std::uint64_t RenderJob::render(const Tile& tile, SampleRange samples,
                                const std::function<bool()>& go_on) {
    const FlushDenormals guard;
    RayCounts counts;
    Sampler sampler = sampler_;
    std::uint64_t added = 0;
    bool stopped = false;
    for (int y = tile.y0; y < tile.y1 && !stopped; ++y)
        for (int x = tile.x0; x < tile.x1 && !stopped; ++x) {
            const std::lock_guard lock(tile_mutexes_[y / tile_side * columns_ + x / tile_side]);
            const int drawn = goes_on_ ? int(film_.drawn(x, y)) : 0;
            for (int s = std::max(samples.first, drawn); s < samples.last; ++s) {
                // A path below a dense surface may take a millisecond: asked at every one.
                stopped = go_on && !go_on();
                if (stopped) break;
                render_sample(x, y, static_cast<std::uint32_t>(s), sampler, counts);
                ++added;
            }
        }
    const std::lock_guard lock(mutex_);
    counts_ += counts;
    return added;
}

void RenderJob::render_sample(int x, int y, std::uint32_t s, Sampler& sampler, RayCounts& counts) {
    const FilmSettings& film = film_.settings();
    const int full_x = x + film.crop_x, full_y = y + film.crop_y;
    sampler.start(std::uint64_t(full_y) * film.width + full_x, s);
    const FilterSample position =
        filter_.sample(sampler.next2d(), filter_window(film, full_x, full_y));
    const Vec2f lens = sampler.next2d();
    const bool spectral = scene_.mode == ColorMode::spectral;
    const Wavelengths wavelengths =
        spectral ? Wavelengths::sample(sampler.next1d()) : Wavelengths::rgb_bands();
    const Ray ray = camera_->ray({(full_x + 0.5f + position.offset.x) / film.width,
                                  (full_y + 0.5f + position.offset.y) / film.height},
                                 lens);
    const Spectral radiance = integrator_.radiance(ray, sampler, wavelengths, counts);
    // A colour made of a few wavelengths may well be negative; radiance may not.
    for (int lane = 0; spectral && lane < Spectral::size; ++lane)
        if (!std::isfinite(radiance[lane]) || radiance[lane] < 0.f)
            return film_.add_invalid(x, y, s, {radiance[0], radiance[1], radiance[2]});
    Vec3f rgb = to_rgb(radiance, wavelengths);
    if (film.quantity != FilmQuantity::radiance) {
        float value = luminance(rgb) * photometric_scale;
        if (film.quantity == FilmQuantity::illuminance)
            value *= static_cast<float>(pixel_solid_angle(full_x, full_y));
        rgb = {value, value, value};
    }
    film_.add(x, y, s, rgb, position.weight, spectral);
    if (!halves_.empty()) halves_[s / block_ % 2].add(x, y, s, rgb, position.weight, spectral);
}

double RenderJob::pixel_solid_angle(int full_x, int full_y) const {
    const auto corner = [&](int dx, int dy) {
        const Vec2f at{float(full_x + dx) / film_.settings().width,
                       float(full_y + dy) / film_.settings().height};
        return normalize(Vec3d(camera_->ray(at, {0.5f, 0.5f}).d));
    };
    const Vec3d a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
    return solid_angle(a, b, c) + solid_angle(a, c, d);
}

}  // namespace nacre
