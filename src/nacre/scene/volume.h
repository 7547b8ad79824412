#pragma once
// Quantities that vary in space: density and albedo of heterogeneous media.
#include <memory>

#include "nacre/geometry/mesh.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

class Volume {
  public:
    virtual ~Volume() = default;
    /// Value at a world-space point; zero outside the volume's bounds.
    virtual Spectral eval(const Point3f& p, const Wavelengths& wavelengths) const = 0;
    /// Largest value anywhere, any wavelength.
    virtual float max() const = 0;
    /// Upper bound inside a world-space box (for local majorants); `max()` unless something tighter
    /// is known.
    virtual float max_in(const Box3f& box) const {
        (void)box;
        return max();
    }
    /// World-space bounds outside of which the value is zero.
    virtual Box3f bounds() const = 0;
};
using VolumePtr = std::shared_ptr<const Volume>;

}  // namespace nacre
