#pragma once
// Upper bounds of a heterogeneous medium's extinction over a coarse grid, so that tracking through
// it takes long steps where it is thin and none where it is empty.
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "nacre/geometry/ray_scene.h"
#include "nacre/scene/medium.h"

namespace nacre {

class MajorantGrid {
  public:
    MajorantGrid() = default;
    /// Empty for media whose extinction does not vary: one bound holds everywhere.
    explicit MajorantGrid(const Medium& medium);

    static constexpr int cells =
        24;  ///< along each side: tracking 24 cells costs less than one lookup saved a cell

    bool empty() const { return majorants_.empty(); }
    const Box3f& bounds() const { return bounds_; }
    float at(int x, int y, int z) const {
        return majorants_[static_cast<std::size_t>((z * cells + y) * cells + x)];
    }

  private:
    Box3f bounds_;
    std::vector<float> majorants_;
};

/// The pieces of a ray from 0 to `end` with constant bounds of the extinction (in all lanes),
/// nearest first; pieces that are empty of medium are left out. Amanatides and Woo 1987, A Fast
/// Voxel Traversal Algorithm.
class MajorantSegments {
  public:
    MajorantSegments(const MajorantGrid& grid, const Medium& medium, const Ray& ray, float end,
                     const Wavelengths& wavelengths);

    struct Segment {
        float begin, end, majorant;
    };
    std::optional<Segment> next();

  private:
    const MajorantGrid* grid_ = nullptr;  // null: a single segment
    float t_ = 0.f, end_ = 0.f, single_ = 0.f;
    std::array<int, 3> cell_{}, step_{};
    std::array<float, 3> next_t_{}, delta_t_{};
};

}  // namespace nacre
