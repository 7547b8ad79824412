#pragma once
// Tracking through a medium whose extinction varies in space but whose albedo does not. Collisions
// are drawn by a constant share of the extinction, tracking_chance or all of it; what of the
// absorption that leaves out is a weight along the way, exact since the integral of the extinction
// is known (path_state.h has the other way, for which tentative collisions would need to know it).
// With tracked_k = c_k sigma_t,k a collision leaves sigma_s,k / tracked_k, a way
// exp(-(1 - c_k) integral of sigma_t,k), and densities go by tracked_k alone. Other media are tracked
// by their extinction.
#include "nacre/render/path_state.h"
#include "nacre/render/volume_path_tracer.h"

namespace nacre {

struct VolumeTracking {
    Spectral tracked{1.f};  ///< share of the extinction
    float largest = 1.f;    ///< of the shares

    VolumeTracking(const VolumePathTracer::MediumInfo& info, const Medium& medium,
                   const Wavelengths& wavelengths)
        : medium_(medium), wavelengths_(wavelengths), extinction_(info.integrable) {
        if (!extinction_) return;
        const Spectral one(1.f);
        tracked = tracking_chance(medium.albedo->eval(wavelengths), Spectral(0.f));
        // An unused lane follows its neighbour.
        if (wavelengths.mode == ColorMode::rgb_bands) tracked.set(3, tracked[2]);
        if (all(tracked == one)) extinction_ = nullptr;
        largest = max_lane(tracked);
    }

    /// What the absorption that is not tracked leaves of light over the first `length` of a ray.
    Spectral remaining(const Ray& ray, float length) const {
        if (!extinction_) return Spectral(1.f);
        const Spectral passed = extinction_->integral(ray.o, ray.d, 0.f, length, wavelengths_);
        return exp((tracked - Spectral(1.f)) * passed * Spectral(medium_.scale));
    }

  private:
    const Medium& medium_;
    const Wavelengths& wavelengths_;
    const IntegrableVolume* extinction_;
};

}  // namespace nacre
