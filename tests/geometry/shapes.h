#pragma once
// Small helpers of the geometry tests.
#include <cmath>
#include <memory>
#include <utility>

#include "nacre/geometry/mesh.h"
#include "nacre/math/random.h"

namespace nacre::test {

/// Uniform on the unit sphere (Archimedes).
inline Vec3f random_direction(Random& random) {
    const Vec2f u = random.next2();
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.f, 1 - z * z));
    const float phi = 6.2831853f * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

inline std::shared_ptr<const Mesh> share(Mesh mesh) {
    mesh.positions.reserve(mesh.positions.size() + 1);
    return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace nacre::test
