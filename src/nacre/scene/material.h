#pragma once
// Materials: a reflectance model whose parameters are bound to textures, as the integrators see it.
//
// Directions are unit vectors in the local shading frame (z along the shading normal, on the
// outside of the surface) and point away from the surface: wo to where the path came from (the
// viewer), wi to where it goes (the light).
#include <memory>
#include <optional>

#include "nacre/geometry/ray_scene.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// What a material does; a bit set.
enum MaterialFlags : unsigned {
    reflects = 1,
    transmits = 2,   ///< light may pass to the other side with a change of direction
    has_smooth = 4,  ///< some of it is a density over directions: `eval` and `pdf` are not zero
    has_delta = 8,   ///< some of it is a mirror or a smooth boundary
    has_null = 16,   ///< some of it lets light pass straight on, as if there were no surface
};

struct MaterialSample {
    Vec3f wi;
    Spectral weight;  ///< f |cos| / pdf; for delta components the power that they carry over their
                      ///< probability
    float pdf = 0.f;  ///< per solid angle, of choosing wi by any smooth component; discrete
                      ///< probability if `delta`
    float eta = 1.f;  ///< index on the side of wi over index on the side of wo (1 unless refracted)
    bool delta = false;
    bool null =
        false;  ///< went straight through (wi = -wo): the surface was not there for this path
    bool single_wavelength =
        false;  ///< wi holds for lane 0 only: the other lanes of the path end here
};

class Material {
  public:
    virtual ~Material() = default;

    virtual unsigned flags() const = 0;
    /// BSDF times |cos theta_i|, without delta components. Radiance is transported: refraction
    /// scales by 1/eta^2.
    virtual Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                          const Wavelengths& wavelengths) const = 0;
    /// Solid-angle density with which `sample` draws wi through its smooth components, all of them
    /// together.
    virtual float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                      const Wavelengths& wavelengths) const = 0;
    /// Draws wi; empty when the path is absorbed. `u1` chooses the component, `u2` the direction.
    virtual std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                                 Vec2f u2,
                                                 const Wavelengths& wavelengths) const = 0;
    /// Share of light that passes straight through towards -wo: what a shadow ray keeps. Zero
    /// unless has_null.
    virtual Spectral null_transmission(const SurfacePoint& at, const Vec3f& wo,
                                       const Wavelengths& wavelengths) const {
        (void)at, (void)wo, (void)wavelengths;
        return Spectral(0.f);
    }
    /// Relative index of refraction inside over outside if the material is a smooth dielectric
    /// boundary
    /// without dispersion and tint, else 0. The random walk below a surface uses it to guide paths
    /// out through the boundary.
    virtual float smooth_boundary_eta() const { return 0.f; }
    /// The same of a rough dielectric boundary that is equally rough everywhere and without tint,
    /// else 0.
    virtual float rough_boundary_eta() const { return 0.f; }
    /// Whether all of it follows Lambert's law, so that the direction of the viewer makes no
    /// difference but for the side.
    virtual bool is_lambertian() const { return false; }
    virtual bool is_spectral() const { return false; }
};
using MaterialPtr = std::shared_ptr<const Material>;

}  // namespace nacre
