#pragma once
// Radii drawn in shaders with the density of R (profile_radii.glsl): for each band, how much of the
// light leaves beyond a radius, and beyond which radius a share of it leaves.
#include "nacre/realtime/band_profiles.h"

namespace nacre {

class ProfileRadii {
  public:
    explicit ProfileRadii(const BandProfiles& profiles);

    /// Binds the textures of profile.glsl and of profile_radii.glsl and sets their uniforms.
    void bind(ComputePass& pass, int profile_unit, int radii_unit) const;
    std::size_t bytes() const { return profile_.bytes() + radii_.bytes(); }

    /// Of the whole plane, in each band.
    Vec3f totals() const { return totals_; }
    /// Beyond which a thousandth of the light is left, in the band that reaches farthest.
    float deepest() const { return deepest_; }
    /// The band that reaches farthest: half of its light leaves beyond the largest radius.
    int widest() const { return widest_; }

  private:
    Texture profile_, radii_;
    Vec3f totals_ = {};
    float deepest_ = 0, low_ = 0, range_ = 0;
    int widest_ = 0;
};

}  // namespace nacre
