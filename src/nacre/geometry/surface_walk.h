#pragma once
// Straight walks over a mesh.
#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/mesh_topology.h"

namespace nacre {

/// Moves places along the surface of a mesh, which must outlive this.
class SurfaceWalk {
  public:
    explicit SurfaceWalk(const Mesh& mesh) : mesh_(mesh), neighbours_(side_neighbours(mesh)) {}

    Vec3d position(const SurfacePlace& place) const;
    /// Where a straight walk of `displacement`, a vector in the plane of the place's triangle,
    /// ends. At an edge what is left of it is turned into the next triangle's plane, as if the two
    /// were unfolded. At a boundary (or an edge of three triangles or more) the walk goes on along
    /// the edge with the component in its direction. Flat triangles are passed without a step. A
    /// walk that has crossed 1000 edges stops there.
    SurfacePlace walk(SurfacePlace from, Vec3d displacement) const;

  private:
    Vec3d corner(SideIndex side) const {
        return Vec3d(mesh_.positions[mesh_.triangles[side / 3][side % 3]]);
    }
    bool flat(std::uint32_t triangle) const;
    SideIndex across(SideIndex side, const Vec3d& p) const;

    const Mesh& mesh_;
    std::vector<SideIndex> neighbours_;
};

}  // namespace nacre
