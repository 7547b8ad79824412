#pragma once
// Quantities that vary in space: density and albedo of heterogeneous media.
#include <memory>

#include "nacre/geometry/mesh.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

class Volume {
  public:
    virtual ~Volume() = default;
    /// Value at a world-space point. Outside of `bounds` a coefficient is zero, while an albedo
    /// goes on as at the edge (or as its wrap mode says): the medium ends where its extinction
    /// ends.
    virtual Spectral eval(const Point3f& p, const Wavelengths& wavelengths) const = 0;
    /// Largest value anywhere, any wavelength.
    virtual float max() const = 0;
    /// Upper bound inside a world-space box (for local majorants); `max()` unless something tighter
    /// is known.
    virtual float max_in(const Box3f& box) const {
        (void)box;
        return max();
    }
    /// World-space bounds of the data.
    virtual Box3f bounds() const = 0;
};
using VolumePtr = std::shared_ptr<const Volume>;

}  // namespace nacre
