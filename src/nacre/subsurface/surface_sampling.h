#pragma once
// Where the light that leaves a translucent object came in, by sampling the surface around the
// exit.
//
// A radius is drawn after the profile and projected onto the surface along one of three axes, the
// normal (1/2) and two tangents (1/4 each), by a probe ray through the whole object (A. King, C.
// Kulla, A. Conty, M. Fajardo 2013, BSSRDF Importance Sampling, SIGGRAPH Talks). All that the ray
// meets are candidates, each weighted by R over the density with which any axis and any lane would
// have found it; one of them is taken in proportion to its weight (resampling), so no part of the
// surface is out of reach and nothing is cut off.
#include "nacre/render/profile_tables.h"
#include "nacre/subsurface/single_scattering.h"
#include "nacre/technique/technique.h"

namespace nacre {

class SurfaceSampling final : public Translucency {
  public:
    /// `exit_scale` multiplies what leaves (1, or 1 over the mean transmittance of the boundary).
    /// `single` may be null.
    SurfaceSampling(const Scene& scene, std::uint32_t shape, const ObjectBoundary& boundary,
                    std::shared_ptr<const ProfileTables> profile, float exit_scale,
                    std::shared_ptr<const SingleScatteringTerm> single);

    Emergence emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                     const Wavelengths& wavelengths, RayCounts& counts) const override;

    TranslucencyPtr relit(const Relight&) const override;

  private:
    const Scene& scene_;
    std::uint32_t shape_;
    std::shared_ptr<const ProfileTables> profile_;
    float exit_scale_;
    std::shared_ptr<const SingleScatteringTerm> single_;
    float reach_;  // of probe rays: the object's diameter
};

}  // namespace nacre
