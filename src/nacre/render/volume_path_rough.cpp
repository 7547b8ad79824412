// The first boundary that a path meets, where it is rough.
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/first_boundary.h"
#include "nacre/render/volume_path.h"

namespace nacre {

bool VolumePath::split_at_rough_boundary(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                                         float eta, Vec2f u) {
    // The same facet, first as a mirror and then as a window. Either may send light nowhere.
    auto reflected = bsdf.sample(wo, 0.f, u), refracted = bsdf.sample(wo, 0x1.fffffep-1f, u);
    if (reflected && !(reflected->wi.z > 0.f)) reflected.reset();
    if (refracted && !(refracted->wi.z < 0.f)) refracted.reset();
    if (!reflected && !refracted) return false;
    const Vec3f h = normalize(reflected ? wo + reflected->wi : wo + refracted->wi * eta);
    const float share = fresnel_dielectric(std::abs(dot(wo, h)), eta);
    // Weights of multiple importance sampling go on with the densities of a single choice: any
    // number serves that both strategies agree on.
    if (reflected && refracted) {
        split_at_first_boundary(*this, share, 1.f - share, [&](VolumePath& reflection) {
            if (reflection.follow(at, bsdf, wo, *reflected)) reflection.trace();
        });
        return follow(at, bsdf, wo, *refracted);
    }
    throughput_ *= Spectral(reflected ? share : 1.f - share);
    return follow(at, bsdf, wo, reflected ? *reflected : *refracted);
}

}  // namespace nacre
