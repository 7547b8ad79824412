#pragma once
// Volumes whose integral along a line is known, so that light through an absorber needs no
// estimate.
#include "nacre/scene/volume.h"

namespace nacre {

class IntegrableVolume : public Volume {
  public:
    /// Exact integral of `eval` along o + t d, d a unit vector, from t = `begin` to `end`.
    virtual Spectral integral(const Point3f& o, const Vec3f& d, float begin, float end,
                              const Wavelengths& wavelengths) const = 0;
};

}  // namespace nacre
