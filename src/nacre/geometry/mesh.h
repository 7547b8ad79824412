#pragma once
// A triangle mesh, as every reader makes it and every technique takes it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

struct Box3f {
    Point3f lower{1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f};

    void extend(const Point3f& p) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    void extend(const Box3f& b) {
        extend(b.lower);
        extend(b.upper);
    }
    bool empty() const { return lower.x > upper.x; }
    Vec3f diagonal() const { return upper - lower; }
    Point3f center() const { return (lower + upper) * 0.5f; }
};

/// Triangles over shared vertices. `normals` and `uvs` are empty or as many as `positions`.
/// Orientation: counter-clockwise seen from outside. For ray queries reserve room for one position
/// more than there are (`positions.reserve(n + 1)`): Embree reads 16 bytes of every 12-byte vertex,
/// and a mesh without that room is copied.
struct Mesh {
    using Triangle = std::array<std::uint32_t, 3>;

    std::string name;
    std::vector<Point3f> positions;
    std::vector<Vec3f> normals;
    std::vector<Vec2f> uvs;
    std::vector<Triangle> triangles;
    /// Triangles of the file that a reader left out because two of their corners coincide.
    std::size_t dropped_triangles = 0;

    Box3f bounds() const {
        Box3f box;
        for (const Point3f& p : positions) box.extend(p);
        return box;
    }
};

}  // namespace nacre
