#pragma once
// Materials: a reflectance model whose parameters are bound to textures, as the integrators see it.
#include <memory>

#include "nacre/geometry/ray_scene.h"
#include "nacre/reflectance/bsdf.h"
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

class Material {
  public:
    virtual ~Material() = default;

    virtual unsigned flags() const = 0;
    /// The material at one point, for the wavelengths of one path: textures looked up, the model
    /// prepared. A vertex binds it once and asks it for the light sample and for its own. Valid
    /// until `scratch` is reset or dies, and while the material lives; of `point` and `wavelengths`
    /// it keeps what it needs.
    virtual const Bsdf& at(const SurfacePoint& point, const Wavelengths& wavelengths,
                           BsdfScratch& scratch) const = 0;
    /// Relative index of refraction inside over outside if the material is a smooth dielectric
    /// boundary without dispersion and tint, else 0. The random walk below a surface uses it to
    /// guide paths out through the boundary.
    virtual float smooth_boundary_eta() const { return 0.f; }
    /// The same of a rough dielectric boundary that is equally rough everywhere and without tint,
    /// else 0.
    virtual float rough_boundary_eta() const { return 0.f; }
    /// The same however roughness and tint vary: of any boundary of facets that reflect or refract.
    virtual float facet_eta() const { return 0.f; }
    /// Whether all of it follows Lambert's law, so that the direction of the viewer makes no
    /// difference but for the side.
    virtual bool is_lambertian() const { return false; }
    virtual bool is_spectral() const { return false; }
};
using MaterialPtr = std::shared_ptr<const Material>;

}  // namespace nacre
