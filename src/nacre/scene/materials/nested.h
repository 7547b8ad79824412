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

/// A smooth sample that one part of a mixture drew, as one of the mixture's: any part might have
/// drawn it. If it holds for one lane, so does its value.
template <class Mixture>
std::optional<BsdfSample> drawn_by_all(const Mixture& mixture, BsdfSample s, const Vec3f& wo) {
    s.pdf = mixture.pdf(s.wi, wo);
    if (!(s.pdf > 0.f)) return std::nullopt;
    const Spectral f = mixture.eval(s.wi, wo) / s.pdf;
    s.weight = s.single_wavelength ? Spectral(f[0], 0.f, 0.f, 0.f) : f;
    return s;
}

}  // namespace nacre
