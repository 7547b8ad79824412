#pragma once
// Light that is scattered exactly once below a boundary, by shadow rays: Jensen et al. 2001,
// section 2.3 (bssrdf/single_scattering.h has the formulas). Rough boundaries let in the share that
// facets let pass, but turn light as smooth ones do.
#include "nacre/render/integrator.h"
#include "nacre/render/light_chooser.h"
#include "nacre/render/object_boundary.h"
#include "nacre/technique/path_technique.h"

namespace nacre {

class SingleScatteringTerm {
  public:
    /// `scene` outlives it; `shape` is the translucent shape, behind `boundary`.
    SingleScatteringTerm(const Scene& scene, std::uint32_t shape, const ObjectBoundary& boundary);

    /// One-sample estimate of the radiance that emerges at `exit` towards `wo` (local, z > 0), over
    /// the boundary's transmittance there. The light's way in is refracted as at a flat surface.
    Spectral radiance(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                      const Wavelengths& wavelengths, RayCounts& counts) const;

  private:
    const Scene& scene_;
    const Medium& medium_;
    std::uint32_t shape_;
    ObjectBoundary boundary_;
    float eta_;
    LightChooser lights_;
    bool has_null_;
};

/// The term, if the technique's "single_scattering" and the profile want it; else null.
std::shared_ptr<const SingleScatteringTerm> single_scattering_of(const ShapeInput& in,
                                                                 bool profile_includes_it);

}  // namespace nacre
