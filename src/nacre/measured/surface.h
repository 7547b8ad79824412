#pragma once
// Measured reflectance as renderers want it: never negative, with the cosine, with a value wherever
// light can come from, and drawn by importance. What a file does not say is decided here, so that
// `Measured` need not invent anything:
//
//   negative values          are 0;
//   beyond the largest       hold the value of the largest measured angle in the same azimuth (0 if
//   measured angles          there is none either);
//   light and viewer         RGL's files: the viewer is the direction that the measurement calls
//                            incident, as in Mitsuba 3, because the tables are drawn from for it.
//                            All others: as measured.
//
// RGL's files are drawn from by their own warps, those of patches by their patches
// (klems_sampler.h), the others by a table made here (half_vector_sampler.h; for light that passes
// through, of wi mirrored at the surface).
#include <memory>
#include <optional>
#include <span>

#include "nacre/measured/half_vector_sampler.h"
#include "nacre/measured/klems_sampler.h"
#include "nacre/measured/measured.h"
#include "nacre/measured/rgl_brdf.h"

namespace nacre {

class MeasuredSurface {
  public:
    explicit MeasuredSurface(std::unique_ptr<Measured> data);

    const MeasuredInfo& info() const { return data_->info(); }
    const Measured& data() const { return *data_; }
    bool reflects() const { return info().reflection_front || info().reflection_back; }
    bool transmits() const { return info().transmission_front || info().transmission_back; }

    /// f |cos(theta_i)|, sr^-1, one a channel: always written, 0 where there is none.
    void eval(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const;
    /// Draws wi; nothing where there is no light or the sample is lost.
    std::optional<Vec3f> sample(const Vec3f& wo, float u1, Vec2f u2) const;
    /// Density of `sample`, sr^-1.
    float pdf(const Vec3f& wi, const Vec3f& wo) const;
    /// `pdf`, and `eval` in `out`: quicker than one after the other.
    float eval_pdf(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const;
    struct Drawn {
        Vec3f wi;
        float pdf;
    };
    /// `sample` with its density, and `eval` there in `out`.
    std::optional<Drawn> draw(const Vec3f& wo, float u1, Vec2f u2, std::span<float> out) const;

    /// `eval` of many pairs in `values`, a row of channels each, and `pdf` in `densities`; either may
    /// be empty. As single calls but for rounding (1e-4 of the larger of a value and a hundredth of
    /// the largest); but for values of scattered samples several times as quick.
    void eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> values,
                   std::span<float> densities) const;
    /// `sample` of many; 0, 0, 0 where it gives nothing.
    void sample_many(std::span<const Vec3f> wo, std::span<const float> u1,
                     std::span<const Vec2f> u2, std::span<Vec3f> wi) const;

    /// The part of pairs of directions, by cosine of both, of which the file says nothing and that
    /// stay 0: of the front, light reflected.
    double black() const { return black_; }

  private:
    bool value(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const;
    void values_of_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                        std::span<float> out) const;
    /// One of the two sides that a viewer can be on.
    struct Side {
        std::optional<HalfVectorSampler> reflected, transmitted;
        float reflect_chance = 1.f;
    };
    Side make_side(bool front) const;
    bool reflects_in_front_alone() const {
        return front_.reflected && !front_.transmitted && !back_.reflected && !back_.transmitted;
    }
    const Side& side_of(const Vec3f& wo) const { return wo.z > 0.f ? front_ : back_; }

    std::unique_ptr<Measured> data_;
    const RglBrdf* rgl_ = nullptr;
    std::optional<KlemsSampler> klems_;
    Side front_, back_;
    double black_ = 0.;
};

}  // namespace nacre
