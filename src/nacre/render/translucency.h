#pragma once
// What a path tracer must know of matter below a surface that it does not simulate: given where
// light leaves, where it came in.
//
// Light that falls on the boundary at x_i enters with the Fresnel transmittance T(w_i), wanders,
// and leaves at x_o. Approximations separate the three (Jensen et al. 2001, eq. 5):
//     L_o(x_o, w_o) = T(w_o) / n  1/pi  int R(x_o, x_i) int T(w_i) L(x_i, w_i) cos dw_i dA(x_i)
// T(w_o) is the path tracer's choice between reflection and what comes from below; everything else,
// n included (the mean transmittance, or 1 in the original paper), is the approximation's.
#include <memory>
#include <optional>

#include "nacre/render/integrator.h"
#include "nacre/render/object_boundary.h"

namespace nacre {

class PathTracer;

/// Where light enters a translucent object: a diffuse "reflector" of albedo 1 whose light passes
/// the boundary, T(w_i) / pi. A path that goes on from an entry point goes on from this material.
class EntryLobe final : public Material {
  public:
    explicit EntryLobe(ObjectBoundary boundary) : boundary_(std::move(boundary)) {}

    /// Whether light can fall onto the surface from `wi` (local): where interpolated normals lean
    /// over its edge, directions above them may lead inside.
    static bool is_outside(const SurfacePoint& at, const Vec3f& wi) {
        return wi.z > 0.f && dot(at.shading.to_world(wi), at.ng) > 0.f;
    }

    unsigned flags() const override { return reflects | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& wavelengths,
                   BsdfScratch& scratch) const override;

  private:
    ObjectBoundary boundary_;
};

/// One shape's matter. Immutable once built; `emerge` is called by many threads.
class Translucency {
  public:
    explicit Translucency(const ObjectBoundary& boundary) : boundary_(boundary), entry_(boundary) {}
    virtual ~Translucency() = default;

    struct Emergence {
        Spectral radiance{0.f};             ///< that is known already
        std::optional<SurfacePoint> entry;  ///< a place where the rest came in
        Spectral weight{0.f};               ///< of what `entry` there sends on
    };
    /// One-sample estimate of the radiance that emerges at `exit` towards `wo` (local, z > 0), over
    /// the boundary's transmittance in that direction.
    virtual Emergence emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                             const Wavelengths& wavelengths, RayCounts& counts) const = 0;

    /// What a change of lights is told with.
    struct Relight {
        const PathTracer& light;  ///< as it is now: for light that falls on the shape
        Statistics& statistics;
        const Work& work;
    };
    /// The same matter under the lights that the scene has now; null: it holds nothing of lights.
    virtual std::shared_ptr<const Translucency> relit(const Relight& now) const {
        (void)now;
        return nullptr;
    }

    const ObjectBoundary& boundary() const { return boundary_; }
    /// What a path goes on from at an entry: a "reflector" towards the `wo` of `emerge`, without
    /// the boundary's transmittance in that direction. Where light enters elsewhere than it leaves,
    /// `wo` means nothing there and the lobe must not look at it.
    virtual const Material& entry() const { return entry_; }

  private:
    ObjectBoundary boundary_;
    EntryLobe entry_;
};
using TranslucencyPtr = std::shared_ptr<const Translucency>;

/// One for each shape of a scene; null where nothing is approximated.
using Translucencies = std::vector<TranslucencyPtr>;

}  // namespace nacre
