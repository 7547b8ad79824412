#pragma once
// Participating media. Coefficients here are per scene unit: the loader has applied the scene's
// unit of length.
#include <memory>

#include "nacre/optics/phase.h"
#include "nacre/scene/volume.h"
#include "nacre/spectrum/spectrum.h"

namespace nacre {

struct MediumCoefficients {
    Spectral sigma_s, sigma_t;
};

/// A medium: extinction, single-scattering albedo and a phase function. Homogeneous where
/// `sigma_t_volume` and `albedo_volume` are null; otherwise each may vary in space, and `scale`
/// multiplies the extinction.
struct Medium {
    std::string id;
    SpectrumPtr sigma_t, albedo;  ///< homogeneous values (used where the volume is null)
    VolumePtr sigma_t_volume, albedo_volume;
    float scale = 1.f;
    PhaseFunction phase;

    bool homogeneous() const { return !sigma_t_volume && !albedo_volume; }
    /// Coefficients at a point (ignored by homogeneous media).
    MediumCoefficients coefficients(const Point3f& p, const Wavelengths& wavelengths) const;
    /// Upper bound of sigma_t over the whole medium, each lane by itself.
    Spectral majorant(const Wavelengths& wavelengths) const;
    bool is_spectral() const;
};
using MediumPtr = std::shared_ptr<const Medium>;

}  // namespace nacre
