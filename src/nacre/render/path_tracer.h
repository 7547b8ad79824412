#pragma once
// Monte Carlo path tracing among surfaces (Kajiya 1986) with next-event estimation and multiple
// importance sampling (Veach and Guibas 1995, balance heuristic), and recursive ray tracing
// (Whitted 1980) as its restriction to mirrors, refraction and direct light. Matter below surfaces
// is what a `Translucency` says it is; simulating it is the business of volume_path_tracer.h.
#include "nacre/render/integrator.h"
#include "nacre/render/light_chooser.h"
#include "nacre/render/translucency.h"

namespace nacre {

class PathTracer : public Integrator {
  public:
    /// Which estimators of direct light are used; switching one off is for tests and teaching.
    enum class Estimators { both, material_only, light_only };

    /// `recursive_only`: paths go on only at mirrors and smooth boundaries, as in Whitted's
    /// algorithm.
    PathTracer(const Scene& scene, bool recursive_only, Estimators estimators = Estimators::both);
    /// With approximations for some shapes (as many entries as shapes). `rr_depth` >= 0 counts in
    /// place of the scene's.
    PathTracer(const Scene& scene, Translucencies below, int rr_depth = -1);

    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override;
    /// One-sample estimate of the radiance that `material` at `at` sends towards `wo` (local), its
    /// own emission left out. For `EntryLobe` and white light it is T over the hemisphere: the
    /// irradiance that passes the boundary, over pi.
    Spectral reflected(const SurfacePoint& at, const Material& material, const Vec3f& wo,
                       Sampler& sampler, const Wavelengths& wavelengths, RayCounts& counts) const;

  private:
    friend class SurfacePath;

    const Scene& scene_;
    LightChooser lights_;
    Translucencies below_;
    bool recursive_only_ = false;
    Estimators estimators_ = Estimators::both;
    int rr_depth_;
    bool has_null_ = false;
};

}  // namespace nacre
