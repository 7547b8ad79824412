#pragma once
// How light gets through the boundary of a translucent object, as techniques need it: the share
// that passes, by direction and on average. A smooth boundary follows Fresnel; of a rough one the
// shares are tabulated from its material, facets seen from one side only (single scattering by
// facets, as the complete simulation has it).
#include <memory>
#include <vector>

#include "nacre/optics/fresnel.h"
#include "nacre/scene/scene.h"

namespace nacre {

class ObjectBoundary {
  public:
    /// A smooth boundary of index inside over outside `eta` > 0; 1: none.
    ObjectBoundary(float eta);  // NOLINT: an index is a boundary
    /// A rough one. `material` outlives it and its rough_boundary_eta() is positive. Takes some 30
    /// ms.
    explicit ObjectBoundary(const Material& material);
    /// Of a translucent shape (scene/subsurface.h), which outlives it.
    static ObjectBoundary of(const ShapeBinding& shape);

    float eta() const { return eta_; }
    /// The material of a rough boundary; null if it is smooth.
    const Material* rough() const { return rough_; }
    /// Share of the light from outside that passes, at a cosine within [0, 1] with the normal.
    float transmittance(float cosine) const {
        return table_ ? tabulated(cosine) : 1.f - fresnel_dielectric(cosine, eta_);
    }
    /// The same over that of a smooth boundary: 1 if it is one, and where that lets nothing pass.
    float over_smooth(float cosine) const;
    /// Shares of even light from outside that pass and that are sent back. With a rough boundary
    /// they leave out what goes from facet to facet.
    double mean_transmittance() const { return mean_transmittance_; }
    double mean_reflectance() const { return mean_reflectance_; }

  private:
    float tabulated(float cosine) const;

    float eta_;
    const Material* rough_ = nullptr;
    std::shared_ptr<const std::vector<float>> table_;  // at equally spaced cosines
    double mean_transmittance_ = 1., mean_reflectance_ = 0.;
};

}  // namespace nacre
