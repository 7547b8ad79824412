#pragma once
// A material within another, bound to the point of the outer one.

#include "nacre/scene/material.h"

namespace nacre {

/// Binds when it is first asked: a shadow ray that only passes, or a viewer on the other side, does
/// not pay for what it never sees.
class NestedBsdf {
  public:
    NestedBsdf(const Material& material, const SurfacePoint& point, const Wavelengths& wavelengths,
               BsdfScratch& scratch)
        : material_(&material), point_(point), wavelengths_(wavelengths), scratch_(&scratch) {}

    const Bsdf* operator->() const {
        if (!bsdf_) bsdf_ = &material_->at(point_, wavelengths_, *scratch_);
        return bsdf_;
    }
    /// Zero without binding where the material lets nothing pass.
    Spectral null_transmission(const Vec3f& wo) const {
        return material_->flags() & has_null ? (*this)->null_transmission(wo) : Spectral(0.f);
    }

  private:
    const Material* material_;
    SurfacePoint point_;
    Wavelengths wavelengths_;
    BsdfScratch* scratch_;
    mutable const Bsdf* bsdf_ = nullptr;  // of one path, so of one thread
};

}  // namespace nacre
