#pragma once
// Measured reflectance that tests make of functions.
#include <functional>

#include "nacre/measured/measured.h"

namespace nacre::test {

/// Values everywhere in front, or where `known` says so.
class MadeSource final : public Measured {
  public:
    using Value = std::function<double(int channel, const Vec3d& wi, const Vec3d& wo)>;

    explicit MadeSource(Value value, bool isotropic = true, std::vector<double> wavelengths = {})
        : value_(std::move(value)) {
        info_.description = "made by a test";
        info_.isotropic = isotropic;
        info_.channels = wavelengths.empty() ? 3 : int(wavelengths.size());
        info_.wavelengths = std::move(wavelengths);
        info_.largest_incidence = info_.largest_exit = 90.;
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        const bool through = wo.z < 0. && info_.transmission_front;
        if (!(wi.z > 0. && (wo.z > 0. || through)) || (known && !known(wi, wo))) return false;
        for (int c = 0; c < info_.channels; ++c) out[c] = value_(c, wi, wo);
        return true;
    }
    void for_each_sample(const std::function<void(const MeasuredSample&)>&) const override {}
    MeasuredInfo& info_to_change() { return info_; }

    std::function<bool(const Vec3d& wi, const Vec3d& wo)> known;

  private:
    Value value_;
};

}  // namespace nacre::test
