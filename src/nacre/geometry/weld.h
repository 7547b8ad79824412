#pragma once
// Vertices at exactly the same place as one.
#include <cstdint>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// Numbers distinct points in order of appearance. Coordinates are compared exactly (-0 equals 0):
/// a tolerance would close gaps that are meant, and needs a scale that no file states. Points must
/// not have NaN coordinates.
class Welder {
  public:
    /// Number of the point; new points are appended to `points`.
    std::uint32_t insert(Vec3f p);

    std::vector<Vec3f> points;

  private:
    void grow();

    std::vector<std::uint32_t> slots_;  ///< open addressing; point number + 1, or 0 if free
};

}  // namespace nacre
