#pragma once
// A BRDF of MERL as any measured file.
#include "nacre/measured/formats.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/merl.h"

namespace nacre {

class MerlMeasured final : public Measured {
  public:
    explicit MerlMeasured(MerlBrdf brdf);
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    bool eval_float(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const override {
        const auto value = brdf_.eval_float(wi, wo);
        for (int c = 0; c < 3 && value; ++c) out[c] = (*value)[c];
        return value.has_value();
    }
    void eval_float_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                         std::span<bool> known) const override {
        brdf_.eval_many(wi, wo, out, known);
    }
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;
    const MerlBrdf& brdf() const { return brdf_; }

  private:
    MerlBrdf brdf_;
};

/// Where a node stands, phi_h = 0; either direction may lie below the horizon.
HalfAngle merl_node_angles(int theta_h, int theta_d, int phi_d);

/// A .binary file (merl_writer.cpp) of what is isotropic and has colours.
WrittenMeasured write_merl(const Measured& data, const WriteOptions& options);

}  // namespace nacre
