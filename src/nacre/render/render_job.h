#pragma once
// A frame in the making, for whoever drives it: which tiles, which of their samples, in what order
// and on what machine. render.h drives all of them on the threads of one.
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "nacre/render/film.h"
#include "nacre/render/filter.h"
#include "nacre/render/frame_settings.h"
#include "nacre/render/integrator.h"

namespace nacre {

/// Samples first, first + 1, ..., last - 1 of each pixel.
struct SampleRange {
    int first = 0, last = 0;
};

/// A rectangle of the film's crop window.
struct Tile {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< from, and behind the last
};

/// The film belongs to the job. Each sample's numbers hang on the frame's seed, its pixel and its
/// index alone, and each pixel adds its samples in the order of the calls: whatever the order of
/// the tiles and whoever renders them, the bits are the same as long as the batches of a tile come
/// one after the other.
class RenderJob {
  public:
    /// `scene` and `integrator` outlive it. Throws InputError for a frame without a camera, without
    /// samples, without area, and if illuminance is asked of a camera whose rays are parallel.
    RenderJob(const Scene& scene, const Integrator& integrator, const FrameSettings& frame);

    /// Begins with what an earlier job of this frame, with however many samples, left: each pixel
    /// goes on behind the samples that it has. Before any are rendered. Throws InputError if the
    /// film shows another picture.
    void go_on_from(const Film& film);
    /// Samples of the frame that are drawn already.
    std::uint64_t drawn() const;
    /// Samples that every pixel has.
    int least_drawn() const;

    int tile_count() const { return columns_ * rows_; }
    Tile tile(int index) const;
    /// Samples of all pixels.
    std::uint64_t total() const { return total_; }
    /// Of so many samples a pixel.
    std::uint64_t total(int samples) const {
        return std::uint64_t(film_.width()) * film_.height() * std::uint64_t(samples);
    }
    /// The batch that follows so many samples, at most up to the frame's. Batches begin small, for
    /// those who wait to see something, and stay small, so that an interrupted picture is even.
    SampleRange batch_after(int samples) const;

    /// Adds samples to a tile of the film; by several threads at a time for different tiles.
    /// `go_on` is asked before each sample, and ends the tile by returning false. Returns how many
    /// samples were added.
    std::uint64_t render(const Tile& tile, SampleRange samples,
                         const std::function<bool()>& go_on = {});

    /// Adds each sample, from now on, to one of two further films as well. Blocks of samples go to
    /// either in turn: blocks of a sequence of low discrepancy are such sequences themselves, while
    /// every other sample of one is not.
    void keep_halves();
    std::vector<Film> take_halves() { return std::move(halves_); }

    /// What there is so far. Not while tiles are rendered.
    Film& film() { return film_; }
    const RayCounts& counts() const { return counts_; }

    /// A copy of what there is so far, also while tiles are rendered: of each pixel the samples of
    /// whole batches, from which `go_on_from` goes on. It waits for the pixels in the making, and
    /// their threads for the copy of a tile.
    Film snapshot();
    RayCounts counts_so_far();

  private:
    void render_sample(int x, int y, std::uint32_t s, Sampler& sampler, RayCounts& counts);
    double pixel_solid_angle(int full_x, int full_y) const;

    const Scene& scene_;
    const Integrator& integrator_;
    const CameraPtr camera_;
    Film film_;
    std::vector<Film> halves_;  // two, or none
    std::uint32_t block_ = 1;   // samples that one half gets before the other does
    const Filter filter_;
    const Sampler sampler_;
    int samples_, columns_, rows_;
    std::uint64_t total_;
    std::mutex mutex_;
    RayCounts counts_;
    bool goes_on_ = false;  ///< pixels may have samples that are not to be drawn again
    /// Of each tile: held while one of its pixels gets a batch, and while it is copied.
    std::unique_ptr<std::mutex[]> tile_mutexes_;
};

}  // namespace nacre
