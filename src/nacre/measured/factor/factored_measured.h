#pragma once
// A folder of factors (textures.h) as measured reflectance, so that whatever takes measured files
// takes it: `nacre data`, <bsdf type="measured">, comparisons.
#include "nacre/measured/factor/brdf.h"
#include "nacre/measured/measured.h"

namespace nacre {

/// Its samples are the N x N pairs of texels' middles, row by row; those of which a direction is
/// below the horizon count as missing.
class FactoredMeasured final : public Measured {
  public:
    explicit FactoredMeasured(FactoredBrdf brdf);
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    bool eval_float(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const override;
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;

  private:
    FactoredBrdf brdf_;
};

}  // namespace nacre
