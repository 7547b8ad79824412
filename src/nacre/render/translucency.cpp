#include "nacre/render/translucency.h"

#include "nacre/math/sampling.h"

namespace nacre {

Spectral EntryLobe::eval(const SurfacePoint& at, const Vec3f&, const Vec3f& wi,
                         const Wavelengths&) const {
    if (!is_outside(at, wi)) return Spectral(0.f);
    return Spectral((boundary_.transmittance(wi.z)) * cosine_hemisphere_pdf(wi.z));
}

float EntryLobe::pdf(const SurfacePoint&, const Vec3f&, const Vec3f& wi, const Wavelengths&) const {
    return cosine_hemisphere_pdf(wi.z);
}

std::optional<MaterialSample> EntryLobe::sample(const SurfacePoint& at, const Vec3f&, float,
                                                Vec2f u2, const Wavelengths&) const {
    MaterialSample s;
    s.wi = square_to_cosine_hemisphere(u2);
    s.pdf = cosine_hemisphere_pdf(s.wi.z);
    if (!(s.pdf > 0.f) || !is_outside(at, s.wi)) return std::nullopt;
    s.weight = Spectral(boundary_.transmittance(s.wi.z));
    return s;
}

}  // namespace nacre
