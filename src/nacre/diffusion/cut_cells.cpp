#include "nacre/diffusion/cut_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nacre/geometry/mesh_topology.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// Shares of faces that differ by less are rounding of sums over a row.
constexpr double rounding = 1e-9;

/// A convex polygon: a triangle that six planes may have cut.
struct Polygon {
    std::array<Vec3d, 12> corner;
    int count = 0;

    void add(const Vec3d& p) { corner[std::size_t(count++)] = p; }
};

/// The parts below and above a plane across an axis.
void split(const Polygon& all, std::size_t axis, double at, Polygon& below, Polygon& above) {
    below.count = above.count = 0;
    for (int i = 0; i < all.count; ++i) {
        const Vec3d& a = all.corner[std::size_t(i)];
        const Vec3d& b = all.corner[std::size_t((i + 1) % all.count)];
        const bool a_above = a[axis] >= at, b_above = b[axis] >= at;
        (a_above ? above : below).add(a);
        if (a_above == b_above) continue;
        Vec3d p = a + (b - a) * ((at - a[axis]) / (b[axis] - a[axis]));
        p[axis] = at;
        below.add(p);
        above.add(p);
    }
}

/// Calls `f` with the parts of a polygon between the planes of the grid across one axis.
template <class F>
void for_slabs(Polygon rest, std::size_t axis, const GridFrame& frame, F&& f) {
    double low = rest.corner[0][axis], high = low;
    for (int i = 1; i < rest.count; ++i) {
        low = std::min(low, rest.corner[std::size_t(i)][axis]);
        high = std::max(high, rest.corner[std::size_t(i)][axis]);
    }
    const auto slab = [&](double x) {
        return std::clamp(std::int32_t(std::floor((x - frame.origin[axis]) / frame.h)), 0,
                          frame.n[axis] - 1);
    };
    const std::int32_t last = slab(high);
    Polygon below, above;
    for (std::int32_t s = slab(low); s < last; ++s) {
        split(rest, axis, frame.origin[axis] + double(s + 1) * frame.h, below, above);
        if (below.count >= 3) f(below, s);
        rest = above;
        if (rest.count < 3) return;
    }
    f(rest, last);
}

/// What lies in a cell, summed over the pieces of triangles there.
struct Sums {
    CutCell cell;
    Vec3d
        moment;  ///< in each direction, the integral of the place within the cell times the normal
};

void add_piece(Sums& sums, const GridFrame& frame, const Polygon& p, const Vec3d& normal) {
    const Vec3d lower = frame.lower(sums.cell.at), center = frame.center(sums.cell.at);
    for (int i = 2; i < p.count; ++i) {
        const Vec3d &a = p.corner[0], &b = p.corner[std::size_t(i - 1)],
                    &c = p.corner[std::size_t(i)];
        const Vec3d vector = cross(b - a, c - a) * 0.5;
        const double area = dot(vector, normal);
        const Vec3d middle = (a + b + c) * (1. / 3.);
        sums.cell.area_vector += vector;
        sums.cell.area += area;
        sums.cell.centroid += middle * area;
        sums.cell.offset += dot(middle - center, vector);
        sums.moment += (middle - lower) * vector;
    }
}

void refuse_open(const Mesh& mesh) {
    const std::vector<SideIndex> neighbours = side_neighbours(mesh);
    const auto open = std::count(neighbours.begin(), neighbours.end(), kNoSide);
    if (open > 0)
        throw InputError(fmt::format(
            "the mesh{} has no closed interior: {} of its {} triangle sides have no "
            "other triangle beside them; close its holes (`nacre info` lists them)",
            mesh.name.empty() ? "" : fmt::format(" '{}'", mesh.name), open, neighbours.size()));
}

/// Sums over the pieces of all triangles, in order of the cells' numbers.
std::vector<Sums> clip_all(const Mesh& mesh, const GridFrame& frame,
                           std::vector<std::int32_t>& of_cell) {
    std::vector<Sums> all;
    for (const Mesh::Triangle& t : mesh.triangles) {
        Polygon whole;
        for (const std::uint32_t corner : t) whole.add(Vec3d(mesh.positions[corner]));
        const Vec3d vector =
            cross(whole.corner[1] - whole.corner[0], whole.corner[2] - whole.corner[0]);
        const double twice = length(vector);
        if (!(twice > 0.)) continue;
        const Vec3d normal = vector * (1. / twice);
        for_slabs(whole, 2, frame, [&](const Polygon& in_z, std::int32_t k) {
            for_slabs(in_z, 1, frame, [&](const Polygon& in_y, std::int32_t j) {
                for_slabs(in_y, 0, frame, [&](const Polygon& piece, std::int32_t i) {
                    const CellPlace at{i, j, k};
                    std::int32_t& index = of_cell[frame.number(at)];
                    if (index < 0) {
                        index = std::int32_t(all.size());
                        all.emplace_back().cell.at = at;
                    }
                    add_piece(all[std::size_t(index)], frame, piece, normal);
                });
            });
        });
    }
    return all;
}

/// Turns sums into shares: goes down every row of cells and adds up what the surface shows it.
void shares_along(std::size_t axis, const GridFrame& frame,
                  const std::vector<std::int32_t>& of_cell, std::vector<Sums>& sums,
                  CutSurface* inside) {
    const std::size_t one = (axis + 1) % 3, two = (axis + 2) % 3;
    const double face = frame.h * frame.h;
    CellPlace c{};
    for (c[two] = 0; c[two] < frame.n[two]; ++c[two]) {
        for (c[one] = 0; c[one] < frame.n[one]; ++c[one]) {
            double share = 0.;
            for (c[axis] = frame.n[axis] - 1; c[axis] >= 0; --c[axis]) {
                const std::size_t number = frame.number(c);
                const std::int32_t index = of_cell[number];
                if (index < 0) {
                    if (!inside || share < 0.5) continue;
                    if (!inside->inside.empty() && inside->inside.back()[0] == number + 1)
                        inside->inside.back()[0] = number;
                    else
                        inside->inside.push_back({number, number + 1});
                    continue;
                }
                Sums& s = sums[std::size_t(index)];
                s.cell.aperture[2 * axis + 1] = share;
                // The same from any of the three directions.
                if (axis == 0) s.cell.volume = share + s.moment[0] / (face * frame.h);
                share += s.cell.area_vector[axis] / face;
                if (std::abs(share - std::round(share)) < rounding) share = std::round(share);
                s.cell.aperture[2 * axis] = share;
            }
        }
    }
}

}  // namespace

GridFrame GridFrame::around(const Box3f& box, double cells, Vec3d shift) {
    const Vec3d size = Vec3d(box.diagonal());
    GridFrame f;
    f.h = std::max({size.x, size.y, size.z}) / cells;
    for (std::size_t a = 0; a < 3; ++a) {
        f.origin[a] = double(box.lower[a]) - (1. + shift[a]) * f.h;
        f.n[a] = std::int32_t(std::ceil(size[a] / f.h + 1. + shift[a])) + 1;
    }
    return f;
}

CutSurface cut_cells(const Mesh& mesh, const GridFrame& frame) {
    refuse_open(mesh);
    std::vector<std::int32_t> of_cell(frame.count(), -1);
    std::vector<Sums> sums = clip_all(mesh, frame, of_cell);
    CutSurface result;
    result.frame = frame;
    for (std::size_t axis = 0; axis < 3; ++axis)
        shares_along(axis, frame, of_cell, sums, axis == 0 ? &result : nullptr);
    double volume = 0.;
    for (Sums& s : sums) {
        CutCell& c = s.cell;
        volume += c.volume;
        c.volume = std::clamp(c.volume, 0., 1.);
        for (double& a : c.aperture) {
            if (a < -rounding || a > 1. + rounding) ++result.overlaps;
            a = std::clamp(a, 0., 1.);
        }
        if (c.area > 0.) {
            c.centroid = c.centroid * (1. / c.area);
            c.offset /= c.area;
        }
        result.cells.push_back(c);
    }
    for (const auto& run : result.inside) volume += double(run[1] - run[0]);
    if (!(volume > 0.))
        throw InputError(fmt::format(
            "the mesh{} encloses nothing{}",
            mesh.name.empty() ? "" : fmt::format(" '{}'", mesh.name),
            volume < 0. ? ": its triangles face inwards; turn them round (flip_normals)" : ""));
    std::sort(result.cells.begin(), result.cells.end(), [&](const CutCell& a, const CutCell& b) {
        return frame.number(a.at) < frame.number(b.at);
    });
    std::sort(result.inside.begin(), result.inside.end());
    return result;
}

}  // namespace nacre
