#pragma once
// Reconstruction filters as distributions: where around a pixel's centre a sample is taken, instead
// of how much each sample counts in each pixel (filter importance sampling: Ernst, Stamminger,
// Greiner 2006, Filter Importance Sampling, IEEE Symposium on Interactive Ray Tracing).
#include <array>

#include "nacre/math/vec.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// Where on the film a sample lies and what it counts.
struct FilterSample {
    Vec2f offset;  ///< from the pixel's centre, in pixels
    float weight;  ///< f / density for a filter of integral 1: 1 for filters that are not negative,
                   ///< +-`absolute_integral` for others
};

/// What of the film lies around a pixel's centre, in pixels.
struct FilterWindow {
    Vec2f low, high;
};
/// Of pixel (x, y) of the full film. All there is if the film takes samples beyond its border. A
/// crop window does not count, so that its pixels are those of the full picture.
FilterWindow filter_window(const FilmSettings& film, int x, int y);

/// A separable filter f(x) f(y), drawn in proportion to |f|. box: 1 within the radius. tent: 1 -
/// |x| / radius. gaussian: exp(-x^2 / 2 stddev^2), lowered so that it reaches 0 at the radius.
/// mitchell: Mitchell and Netravali 1988, Reconstruction Filters in Computer Graphics, SIGGRAPH,
/// equation 8, stretched to the radius; its outer lobes are negative for the usual B and C.
class Filter {
  public:
    /// Throws InputError for an unknown type or a radius or deviation that is not positive.
    explicit Filter(const FilterSettings& settings);

    FilterSample sample(Vec2f u) const;
    /// The same from the part of the filter within a window around the pixel's centre, which has an
    /// integral of 1 then. A window that holds the whole filter gives what `sample(u)` does.
    FilterSample sample(Vec2f u, const FilterWindow& window) const;
    /// One factor of the filter, scaled to an integral of 1 over [-radius, radius].
    float eval(float x) const;
    float radius() const { return radius_; }
    /// Integral of |f(x) f(y)| for a filter of integral 1; above 1 if the filter has negative
    /// lobes.
    float absolute_integral() const { return absolute_ * absolute_; }
    /// Of one factor within [low, high], scaled to an integral of 1 there. Throws InputError if
    /// that part has no positive integral.
    float absolute_integral(float low, float high) const;

  private:
    /// Intervals on which the density is taken as constant: 1/128 pixel wide for a radius of 2, far
    /// below what a pixel resolves.
    static constexpr int cells = 512;
    double shape(double x) const;
    bool holds(float low, float high) const { return low <= -radius_ && high >= radius_; }
    float position(float x) const;  ///< of x among the cells
    float share_below(float x) const;
    std::pair<float, bool> sample1d(float u) const;
    std::pair<float, bool> sample1d(float u, float low, float high) const;

    FilterSettings settings_;
    bool box_;  ///< needs no table
    float radius_;
    float scale_;     ///< of the shape, to make its integral 1
    float absolute_;  ///< integral of |f(x)|
    std::array<float, cells + 1> cdf_;
    std::array<bool, cells> negative_;
};

}  // namespace nacre
