#pragma once
// What the complete simulation finds on a straight way: used by volume_path*.cpp alone.
#include <algorithm>

#include "nacre/math/fast.h"
#include "nacre/render/shadow_walk.h"
#include "nacre/render/volume_path.h"

namespace nacre {

/// What lies on the way of a shadow ray: surfaces that let pass, and the media between them.
struct VolumePath::WayToLight {
    VolumePath& path;
    const Medium* medium;
    Random& random;
    Connection c{Spectral(1.f), Spectral(1.f)};

    bool opaque_only() const { return !path.tracer_.has_null_ && !medium; }
    bool passes(const ShapeBinding& shape) const { return shape.material->flags() & has_null; }
    bool segment(const Ray& ray, float length) {
        if (medium && medium->homogeneous()) {
            const MediumLanes lanes = path.lanes_of(*medium, ray.o);
            const Spectral t = lanes.transmittance(length);
            c.kept *= t;
            c.density *= lanes.passing(t);
        } else if (medium) {
            ratio_tracking(ray, length);
        }
        return max_lane(c.kept) > 0.f;
    }
    bool surface(const ShapeBinding& shape, const SurfacePoint& at, const Vec3f& d) {
        BsdfScratch scratch;
        const Spectral passing = shape.material->at(at, path.wavelengths_, scratch)
                                     .null_transmission(at.shading.to_local(-d));
        c.kept *= passing;
        c.density *= Spectral(path.mean_of(passing));
        if (shape.separates_media) medium = dot(d, at.ng) > 0.f ? shape.exterior : shape.interior;
        return true;
    }

    // Novak, Selle, Jarosz 2014, Residual Ratio Tracking for Estimating Attenuation in
    // Participating Media, TOG 33(6).
    void ratio_tracking(const Ray& ray, float length) {
        const VolumePathTracer::MediumInfo& info = path.tracer_.info(medium);
        const VolumeTracking tracking(info, *medium, path.wavelengths_);
        c.kept *= tracking.remaining(ray, length);
        MajorantSegments segments(info.majorants, *medium, ray, length, path.wavelengths_);
        while (const auto s = segments.next()) {
            const float majorant = s->majorant * tracking.largest;
            if (!(majorant > 0.f)) continue;
            for (float t = s->begin;;) {
                t += -fast_log(1.f - random.next()) / majorant;
                if (t >= s->end) break;
                const Spectral sigma_t =
                    medium->coefficients(ray.o + ray.d * t, path.wavelengths_).sigma_t;
                const Spectral passed =
                    max(Spectral(0.f),
                        Spectral(1.f) - sigma_t * tracking.tracked * Spectral(1.f / majorant));
                c.kept *= passed;
                c.density *= passed;
            }
        }
    }
};

}  // namespace nacre
