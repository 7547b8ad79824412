#pragma once
// The film: per pixel the sum, the sum of squares and the number of samples, and what went wrong.
#include <cstdint>
#include <vector>

#include "nacre/math/vec.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// A sample that is not a number, infinite or negative: never hidden, never added.
struct InvalidSample {
    int x, y;
    std::uint32_t sample;
    Vec3f value;
};

/// Linear RGB means with variances. Each pixel is written by one thread at a time (a tile), so no
/// locks are needed. Reconstruction filters are applied by drawing the film position from the
/// filter (filter importance sampling: Ernst, Stamminger, Greiner 2006), so a sample belongs to one
/// pixel only.
class Film {
  public:
    explicit Film(const FilmSettings& settings);

    int width() const { return width_; }  ///< of the crop window
    int height() const { return height_; }
    const FilmSettings& settings() const { return settings_; }

    /// Adds a sample to pixel (x, y) of the crop window. Invalid samples are counted and located
    /// instead.
    void add(int x, int y, std::uint32_t sample, const Vec3f& rgb, float filter_weight);

    Vec3f mean(int x, int y) const;
    /// Unbiased estimate of the variance of one sample; divide by `count` for the variance of the
    /// mean.
    Vec3f sample_variance(int x, int y) const;
    std::uint32_t count(int x, int y) const;

    std::uint64_t invalid_count() const;
    /// The first few invalid samples in pixel order.
    std::vector<InvalidSample> invalid_samples() const;

  private:
    struct Pixel {
        double sum[3]{}, sum2[3]{};
        double weight = 0;
        std::uint32_t count = 0;
        std::uint32_t invalid = 0;
    };
    FilmSettings settings_;
    int width_, height_;
    std::vector<Pixel> pixels_;
    std::vector<InvalidSample> invalid_;
};

}  // namespace nacre
