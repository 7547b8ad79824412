#pragma once
// Polygons of mesh files cut into triangles. Only for the .cpp files of this room.
#include "nacre/geometry/mesh.h"

namespace nacre {

/// Collects the polygons of a file. They are added as fans around their first corner, because
/// a file may name vertices before it places them; cut_concave() then replaces the fans that leave
/// their polygon.
class Polygons {
  public:
    /// Adds a polygon of vertex indices as a fan, or counts it as dropped if it has fewer than
    /// three corners.
    void add(Mesh& mesh, const std::vector<std::uint32_t>& corners);
    /// Cuts polygons again whose fan has triangles turned against the polygon; to be called once,
    /// when the positions are complete. Each is cut by ears (Meisters 1975, Polygons Have Ears,
    /// Amer. Math. Monthly 82(6)) in the plane of its normal after Newell: every edge of the
    /// polygon is an edge of one triangle, and every cut an edge of two. Holes may be joined to the
    /// outline by edges that are passed twice. Polygons that cross themselves are cut into
    /// triangles of the same signed area. n corners take O(n) tests of O(r), r of them reflex.
    void cut_concave(Mesh& mesh) const;

  private:
    /// Polygons of equally many corners, one after another in the mesh's triangles.
    struct Run {
        std::size_t first, corners, count;
    };
    std::vector<Run> runs_;
};

}  // namespace nacre
