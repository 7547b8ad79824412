#pragma once
// The film: per pixel the sum, the sum of squares and the number of samples, and what went wrong.
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nacre/math/vec.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// A sample that is not a number, infinite or negative: never hidden, never added.
struct InvalidSample {
    int x, y;  ///< of the full film
    std::uint32_t sample;
    Vec3f value;
};

/// What a film knows of one pixel.
struct PixelSums {
    double sum[3]{}, sum2[3]{};  ///< of the samples and of their squares: R, G, B
    std::uint32_t count = 0;
    std::uint32_t invalid = 0;

    PixelSums& operator+=(const PixelSums& o);
    double mean(int c) const { return count ? sum[c] / count : 0; }
    double variance(int c) const;  ///< of one sample
};

/// Linear RGB means with variances. Each pixel is written by one thread at a time (a tile), so no
/// locks are needed. Reconstruction filters are applied by drawing the film position from the
/// filter (filter.h), so a sample belongs to one pixel only.
///
/// Samples of a filter with negative lobes carry a weight of +W or -W, where W is the integral of
/// the filter's absolute value. Adding +-W v would make even a constant picture noisy and dividing
/// by the sum of the weights would divide by zero in one pixel of ten at two samples. Instead the
/// positive and the negative lobes are averaged apart and the pixel is (W + 1)/2 times the former
/// mean minus (W - 1)/2 times the latter (post-stratification; Cochran 1977, Sampling Techniques,
/// 5A.9): unbiased given that both have samples, and exact for a constant picture.
class Film {
  public:
    /// Throws InputError if the film or its crop window has no area or the window leaves the film.
    explicit Film(const FilmSettings& settings);

    int width() const { return width_; }  ///< of the crop window
    int height() const { return height_; }
    const FilmSettings& settings() const { return settings_; }

    /// Adds a sample to pixel (x, y) of the crop window. Samples that are not finite, and negative
    /// ones unless `may_be_negative` (a colour estimated from few wavelengths may be), are counted
    /// and located instead.
    void add(int x, int y, std::uint32_t sample, const Vec3f& rgb, float filter_weight,
             bool may_be_negative = false);
    /// Counts and locates a sample that the caller found to be invalid.
    void add_invalid(int x, int y, std::uint32_t sample, const Vec3f& value);

    /// Zero without samples.
    Vec3f mean(int x, int y) const;
    /// Unbiased estimate of the variance of one sample; divide by `count` for the variance of the
    /// mean. Zero below two samples.
    Vec3f sample_variance(int x, int y) const;
    /// Valid samples.
    std::uint32_t count(int x, int y) const;
    /// Samples, valid or not: the index of the next one, where they came in order.
    std::uint32_t drawn(int x, int y) const;

    std::uint64_t invalid_count() const;
    /// The first invalid samples in the order of rows, columns and samples; at most 16.
    std::vector<InvalidSample> invalid_samples() const;

    /// Adds the samples of another film of the same picture, or of a crop window within this
    /// one's: tiles and batches that were rendered elsewhere. Throws InputError if it shows another
    /// picture. Sums of different samples of a pixel may round otherwise than in one film.
    void merge(const Film& other);

    /// Makes the pixels [x0, x1) x [y0, y1) of the crop window those of a film of the same settings.
    void copy_pixels(const Film& from, int x0, int y0, int x1, int y1);
    /// Takes over the invalid samples of a film whose pixels were copied before, but for those that
    /// came later. Other threads may add samples to `from` meanwhile.
    void copy_invalid(const Film& from);

  private:
    friend class FilmState;
    void keep_invalid(const InvalidSample& s);
    std::string describe() const;
    std::size_t index(int x, int y) const { return std::size_t(y) * width_ + x; }

    FilmSettings settings_;
    int width_, height_;
    /// W of a pixel: the product of those of its column and its row, which at the border of the
    /// film are of the part of the filter that lies on it.
    std::vector<float> column_absolute_, row_absolute_;
    double absolute_integral(int x, int y) const { return column_absolute_[x] * row_absolute_[y]; }
    std::vector<PixelSums> pixels_;
    std::vector<PixelSums> negative_;  ///< samples of negative lobes; empty if the filter has none
    std::vector<InvalidSample> invalid_;
    std::unique_ptr<std::mutex> invalid_mutex_;  ///< apart, so that a film can be moved
};

}  // namespace nacre
