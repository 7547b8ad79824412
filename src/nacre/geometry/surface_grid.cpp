#include "nacre/geometry/surface_grid.h"

#include <algorithm>
#include <cmath>

#include "nacre/geometry/mesh.h"
#include "nacre/math/random.h"

namespace nacre {

SurfaceGrid::SurfaceGrid(std::span<const SheetPoint> points, float radius) {
    Box3f box;
    for (const SheetPoint& point : points) box.extend(point.p);
    lower_ = box.lower;
    const Vec3f size = points.empty() ? Vec3f{} : box.diagonal();
    const double widest = std::max({size.x, size.y, size.z});
    per_unit_ = 1 / std::max(double(radius), widest * 0x1p-30);

    std::vector<std::uint32_t> cell;
    cell.reserve(points.size());
    std::vector<std::uint32_t> counts;
    table_.assign(64, 0);
    for (const SheetPoint& point : points) {
        const Coordinates c = coordinates(point.p);
        std::size_t at = find(c);
        if (!table_[at]) {
            // A third full at most: half of all queries are for cells that are not there, and each
            // looks at all entries up to the next free place.
            if (3 * coordinates_.size() >= table_.size()) {
                grow();
                at = find(c);
            }
            coordinates_.push_back(c);
            counts.push_back(0);
            table_[at] = static_cast<std::uint32_t>(coordinates_.size());
        }
        cell.push_back(table_[at] - 1);
        ++counts[cell.back()];
    }
    begin_.reserve(counts.size() + 1);
    begin_.push_back(0);
    for (const std::uint32_t n : counts) begin_.push_back(begin_.back() + n);
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    points_.resize(points.size());
    cell_of_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t slot = next[cell[i]]++;
        points_[slot] = points[i];
        cell_of_[slot] = cell[i];
    }
}

SurfaceGrid::Coordinates SurfaceGrid::coordinates(const Point3f& p) const {
    const auto cell = [&](float x, float lower) {
        return static_cast<std::int32_t>((double(x) - lower) * per_unit_ + 1) - 1;
    };
    return {cell(p.x, lower_.x), cell(p.y, lower_.y), cell(p.z, lower_.z)};
}

std::size_t SurfaceGrid::find(const Coordinates& c) const {
    const std::uint64_t xy = std::uint64_t(std::uint32_t(c.x)) << 32 | std::uint32_t(c.y);
    std::size_t at = mix_bits(xy ^ mix_bits(std::uint32_t(c.z))) & (table_.size() - 1);
    while (table_[at] && coordinates_[table_[at] - 1] != c) at = (at + 1) & (table_.size() - 1);
    return at;
}

void SurfaceGrid::grow() {
    table_.assign(2 * table_.size(), 0);
    for (std::size_t i = 0; i < coordinates_.size(); ++i)
        table_[find(coordinates_[i])] = static_cast<std::uint32_t>(i + 1);
}

SurfaceGrid::Around SurfaceGrid::around(const Coordinates& middle) const {
    Around near;
    for (std::int32_t z = -1; z <= 1; ++z)
        for (std::int32_t y = -1; y <= 1; ++y)
            for (std::int32_t x = -1; x <= 1; ++x) {
                const Coordinates c = {middle.x + x, middle.y + y, middle.z + z};
                if (const std::uint32_t found = table_[find(c)])
                    near.ranges[near.count++] = {begin_[found - 1], begin_[found]};
            }
    return near;
}

}  // namespace nacre
