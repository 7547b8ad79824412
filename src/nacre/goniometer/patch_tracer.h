#pragma once
// One ray of the virtual gonioreflectometer, from the light until it leaves the patch.
#include <cstdint>
#include <optional>

#include "nacre/goniometer/measurement.h"
#include "nacre/math/random.h"

namespace nacre {

/// What became of one ray.
struct Arrival {
    enum class Where : std::uint8_t { nowhere, above, below, cut, gone } where = Where::nowhere;
    std::uint32_t bin = 0;
    Spectral weight{0.f};
};

class PatchTracer {
  public:
    /// All three outlive it.
    PatchTracer(const Patch& patch, const MeasureOptions& options, const DirectionCell& incidence)
        : patch_(patch), options_(options), incidence_(incidence) {}

    /// Safe to call from many threads. Throws RunError for light that is no number, InputError for
    /// media that have no end.
    Arrival trace(Random random) const;

  private:
    /// The next direction, in world coordinates, with the weight of light that goes that way.
    std::optional<BsdfSample> scatter(const SurfacePoint& at, const Vec3f& d, Random& random,
                                      BsdfScratch& scratch) const;
    /// The flight through a medium to a surface or a collision, and what it leaves of the weight.
    Flight fly_within(const PatchMedium& medium, const Point3f& o, const Vec3f& d, Spectral& weight,
                      Random& random) const;

    const Patch& patch_;
    const MeasureOptions& options_;
    const DirectionCell& incidence_;
};

}  // namespace nacre
