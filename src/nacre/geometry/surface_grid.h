#pragma once
// Which points are near one another along a surface.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// A point of a surface among others.
struct SheetPoint {
    Point3f p;
    Vec3f n;
    std::uint32_t component;  ///< of the mesh, see triangle_components
    std::uint32_t index;      ///< the caller's
};

/// Whether two points that are close in space are taken to be close along the surface. The two
/// sides of a thin sheet are not: their normals oppose. Nor are separate components. The limit,
/// normals 120 degrees apart, lets points see one another across any edge but those sharper than
/// 60 degrees, where they do not and are somewhat closer. What this rule cannot tell: layers of one
/// component that face the same way, closer than the points' spacing; these share their points.
inline bool same_sheet(const SheetPoint& a, const SheetPoint& b) {
    return a.component == b.component && dot(a.n, b.n) > -0.5f;
}

/// Points sorted into the cells of a uniform grid, of which only the occupied ones are stored. The
/// order depends on the points alone.
class SurfaceGrid {
  public:
    /// Cells of side `radius`, or more where the coordinates would not fit into 31 bits.
    SurfaceGrid(std::span<const SheetPoint> points, float radius);

    std::size_t cells() const { return begin_.size() - 1; }
    /// All points, cell after cell; "slots" number them.
    std::span<const SheetPoint> points() const { return points_; }
    /// Slots of a cell.
    std::uint32_t begin(std::size_t cell) const { return begin_[cell]; }
    std::uint32_t end(std::size_t cell) const { return begin_[cell + 1]; }
    std::uint32_t cell_of(std::uint32_t slot) const { return cell_of_[slot]; }

    /// Ranges of slots that hold every point within the radius of any point of one cell.
    struct Around {
        std::array<std::array<std::uint32_t, 2>, 27> ranges;
        int count = 0;

        template <class Visit>
        void for_each(const Visit& visit) const {
            for (int i = 0; i < count; ++i)
                for (std::uint32_t slot = ranges[i][0]; slot < ranges[i][1]; ++slot) visit(slot);
        }
    };
    Around around(std::size_t cell) const { return around(coordinates_[cell]); }
    Around around(const Point3f& p) const { return around(coordinates(p)); }

  private:
    struct Coordinates {
        std::int32_t x, y, z;
        bool operator==(const Coordinates&) const = default;
    };

    Coordinates coordinates(const Point3f& p) const;
    Around around(const Coordinates& middle) const;
    /// Where the cell is in `table_`, or the free place where it belongs.
    std::size_t find(const Coordinates& c) const;
    void grow();

    Point3f lower_;
    double per_unit_ = 1;
    std::vector<SheetPoint> points_;
    std::vector<std::uint32_t> begin_, cell_of_;
    std::vector<Coordinates> coordinates_;  ///< of the cells
    std::vector<std::uint32_t> table_;      ///< open addressing; cell + 1, or 0 if free
};

}  // namespace nacre
