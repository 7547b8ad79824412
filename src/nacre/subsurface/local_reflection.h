#pragma once
// The medium as a surface: all light leaves where it came in. What a BRDF can do for translucent
// matter: Lambert's law with the profile's total, below the same boundary.
#include "nacre/render/profile_tables.h"
#include "nacre/technique/technique.h"

namespace nacre {

class LocalReflection final : public Translucency {
  public:
    /// `exit_scale` multiplies what leaves (1, or 1 over the mean transmittance of the boundary).
    LocalReflection(const ObjectBoundary& boundary, std::shared_ptr<const ProfileTables> profile,
                    float exit_scale)
        : Translucency(boundary), profile_(std::move(profile)), exit_scale_(exit_scale) {}

    Emergence emerge(const SurfacePoint& exit, const Vec3f&, Sampler&, const Wavelengths& w,
                     RayCounts&) const override {
        return {Spectral(0.f), exit, profile_->total(w) * Spectral(exit_scale_)};
    }

  private:
    std::shared_ptr<const ProfileTables> profile_;
    float exit_scale_;
};

}  // namespace nacre
