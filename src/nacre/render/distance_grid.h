#pragma once
// A coarse grid over a medium that bounds the distance to the nearest surface from below, so that
// short free paths need no ray. Cells near surfaces may carry an index into a table of somebody
// else's (the exit guide).
#include <cstdint>
#include <vector>

#include "nacre/geometry/ray_scene.h"
#include "nacre/math/work.h"

namespace nacre {

class DistanceGrid {
  public:
    struct Cell {
        float clearance = 0.f;    ///< every point of the cell is at least this far from any surface
        std::int32_t guide = -1;  ///< -1: none
        bool outside = false;
    };

    /// No bounds known: every clearance is 0 and nowhere is outside.
    DistanceGrid() = default;
    /// Covers `bounds` with cells of about `cell_size`, but at most `max_cells` along the longest
    /// side. The distance is to all shapes of `rays`, exact at the cell's centre, less half its
    /// diagonal. Throws Stopped if `work` says so.
    DistanceGrid(const RayScene& rays, const Box3f& bounds, float cell_size, int max_cells,
                 const Work& work = {});

    Cell locate(const Point3f& p) const {
        if (cells_.empty()) return {};
        const Vec3f q = (p - origin_) * inverse_size_;
        const auto x = static_cast<int>(q.x), y = static_cast<int>(q.y), z = static_cast<int>(q.z);
        // A negative coordinate between 0 and -1 truncates to 0: harmless, the grid has a margin.
        if (static_cast<unsigned>(x) >= nx_ || static_cast<unsigned>(y) >= ny_ ||
            static_cast<unsigned>(z) >= nz_)
            return {0.f, -1, true};
        const Stored& cell = cells_[index(x, y, z)];
        return {cell.clearance, cell.guide, false};
    }

    float cell_size() const { return size_; }
    float half_diagonal() const { return 0.8660255f * size_; }  // sqrt(3)/2, rounded up
    std::size_t memory() const { return cells_.size() * sizeof(Stored); }
    std::size_t cell_count() const { return cells_.size(); }
    Point3f center(std::size_t cell) const;
    float clearance(std::size_t cell) const { return cells_[cell].clearance; }
    /// Every clearance is 0 from now on: all rays are traced.
    void forget_distances() {
        for (Stored& cell : cells_) cell.clearance = 0.f;
    }
    void set_guide(std::size_t cell, std::int32_t guide) { cells_[cell].guide = guide; }

  private:
    struct Stored {
        float clearance;
        std::int32_t guide;
    };
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * ny_ + static_cast<std::size_t>(y)) * nx_ +
               static_cast<std::size_t>(x);
    }

    Point3f origin_;
    float size_ = 0.f, inverse_size_ = 0.f;
    unsigned nx_ = 0, ny_ = 0, nz_ = 0;
    std::vector<Stored> cells_;
};

}  // namespace nacre
