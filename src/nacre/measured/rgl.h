#pragma once
// The .bsdf files of the RGL material database as any measured file.
#include <memory>

#include "nacre/measured/formats.h"
#include "nacre/measured/rgl_brdf.h"

namespace nacre {

/// Light comes from wi as in the measurement: wi is the given direction of RglBrdf. Samples whose
/// exit lies below the horizon are missing.
class RglMeasured final : public Measured {
  public:
    /// Fills in what `info` counts.
    RglMeasured(RglBrdf brdf, MeasuredInfo info);
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    void eval_many(std::span<const Vec3d> wi, std::span<const Vec3d> wo, std::span<double> out,
                   std::span<bool> known) const override;
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;
    const RglBrdf& brdf() const { return brdf_; }

  private:
    RglBrdf brdf_;
};

/// Throws InputError for whatever is wrong with the file.
std::unique_ptr<RglMeasured> parse_rgl(const MeasuredSource& source);

/// A .bsdf file (rgl_writer.cpp) of what reflects in front, with colours or wavelengths.
WrittenMeasured write_rgl(const Measured& data, const WriteOptions& options);

}  // namespace nacre
