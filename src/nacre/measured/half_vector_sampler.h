#pragma once
// Importance sampling of any BRDF that can be evaluated: a table of f cos(theta_i) over half vectors
// for a grid of viewers, of which it draws, mixed with directions by the cosine.
//
// Half vectors lie on the unit square of half_vector_square.h, of isotropic surfaces relative to the
// viewer's azimuth: highlights are finely resolved wherever the viewer stands. Tables for viewers between those of the grid are
// mixed, and the density is that of the mixture exactly (marginal_warp.h).
#include <functional>
#include <span>

#include "nacre/math/vec.h"
#include "nacre/measured/marginal_warp.h"

namespace nacre {

class HalfVectorSampler {
  public:
    /// `value` is f cos(theta_i), in any unit, of directions above the horizon; called from many
    /// threads. Negative values count as 0.
    HalfVectorSampler(const std::function<double(const Vec3f& wi, const Vec3f& wo)>& value,
                      bool isotropic);

    /// Draws wi for a viewer above the horizon; wi may lie below: that sample is lost.
    Vec3f sample(const Vec3f& wo, float u1, Vec2f u2) const;
    /// Density of `sample`, sr^-1; 0 unless both directions are above the horizon.
    float pdf(const Vec3f& wi, const Vec3f& wo) const;
    /// The same for many, as single calls but for rounding, and several times as quick.
    void sample_many(std::span<const Vec3f> wo, std::span<const float> u1,
                     std::span<const Vec2f> u2, std::span<Vec3f> wi) const;
    void pdf_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) const;
    /// Mean over viewers of the light that comes back from even light, in the unit of `value`.
    double mean() const { return mean_; }

    /// The share of directions by the cosine: what the table is too coarse for is found by them.
    static constexpr float by_cosine = 0.15f;

  private:
    bool isotropic_;
    double mean_ = 0.;
    ParameterGrid viewers_;
    MarginalWarp warp_;
};

}  // namespace nacre
