#pragma once
// A material at one point, with a scratch of its own.
#include "nacre/scene/material.h"

namespace nacre::test {

class Bound {
  public:
    explicit Bound(MaterialPtr material, const SurfacePoint& at = {},
                   const Wavelengths& w = Wavelengths::rgb_bands())
        : Bound(*material, at, w) {
        material_ = std::move(material);
    }
    /// `material` outlives it.
    explicit Bound(const Material& material, const SurfacePoint& at = {},
                   const Wavelengths& w = Wavelengths::rgb_bands())
        : scratch_(std::make_unique<BsdfScratch>()), bsdf_(&material.at(at, w, *scratch_)) {}

    const Bsdf* operator->() const { return bsdf_; }
    const Bsdf& operator*() const { return *bsdf_; }

  private:
    MaterialPtr material_;
    std::unique_ptr<BsdfScratch> scratch_;
    const Bsdf* bsdf_;
};

}  // namespace nacre::test
