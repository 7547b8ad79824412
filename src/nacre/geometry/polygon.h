#pragma once
// Polygons of files as triangles.
#include <cstdint>
#include <span>
#include <vector>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// Cuts a polygon of n >= 3 corners into n - 2 triangles of corner numbers, which go round as the
/// polygon does; each side of the polygon is a side of exactly one triangle. Where the fan around
/// corner 0 covers the polygon (all convex ones), it is that fan; else ears are clipped
/// (Meisters 1975, Polygons Have Ears) in the plane of Newell's normal. Holes joined to the outline
/// by a bridge that is walked both ways are left open. A polygon that crosses itself gets n - 2
/// triangles all the same, some of which overlap.
void cut_polygon(std::span<const Point3f> corners, std::vector<Mesh::Triangle>& triangles);

/// Gathers the polygons of a mesh while it is read. Faces may name vertices that come after them,
/// so that how to cut is decided at the end.
class PolygonList {
  public:
    explicit PolygonList(Mesh& mesh) : mesh_(mesh) {}

    /// Adds a polygon of vertex numbers, or counts it as dropped if it has fewer than three.
    template <class Corners>
    void add(const Corners& corners) {
        if (corners.size() < 3) ++mesh_.dropped_triangles;
        if (corners.size() > 3) polygons_.push_back({mesh_.triangles.size(), corners.size()});
        for (std::size_t i = 2; i < corners.size(); ++i)
            mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    /// Cuts what is more than a triangle, once the mesh has all its positions.
    void cut();

  private:
    struct Polygon {
        std::size_t first_triangle, corners;
    };
    Mesh& mesh_;
    std::vector<Polygon> polygons_;
};

}  // namespace nacre
