#include "nacre/render/shadow_walk.h"

#include <algorithm>

namespace nacre {

namespace {

struct SurfacesAlone {
    const Wavelengths& wavelengths;
    bool opaque;
    Spectral kept{1.f};

    bool opaque_only() const { return opaque; }
    bool passes(const ShapeBinding& shape) const { return shape.material->flags() & has_null; }
    bool segment(const Ray&, float) const { return true; }
    bool surface(const ShapeBinding& shape, const SurfacePoint& at, const Vec3f& d) {
        BsdfScratch scratch;
        kept *=
            shape.material->at(at, wavelengths, scratch).null_transmission(at.shading.to_local(-d));
        return max_lane(kept) > 0.f;
    }
};

}  // namespace

bool has_null_surfaces(const Scene& scene) {
    return std::ranges::any_of(
        scene.shapes, [](const ShapeBinding& s) { return s.material->flags() & has_null; });
}

Spectral surface_transmittance(const Scene& scene, bool scene_has_null, const ShadowRay& shadow,
                               const Wavelengths& wavelengths, RayCounts& counts) {
    SurfacesAlone way{wavelengths, !scene_has_null};
    return walk_to_light(scene, shadow, counts, way) ? way.kept : Spectral(0.f);
}

}  // namespace nacre
