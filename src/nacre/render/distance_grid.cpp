#include "nacre/render/distance_grid.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

// Cells are made in blocks of this many along a side: one query at the block's centre tells which
// cells need their own.
constexpr unsigned block = 8;
// Distances need not be known better than this: exact ones take many times as long deep inside a
// fine mesh.
constexpr float tolerance = 0.1f;

}  // namespace

DistanceGrid::DistanceGrid(const RayScene& rays, const Box3f& bounds, float cell_size,
                           int max_cells, const Work& work) {
    const Vec3f d = bounds.diagonal();
    const float longest = std::max({d.x, d.y, d.z});
    size_ = std::max(cell_size, longest / static_cast<float>(max_cells - 2));
    inverse_size_ = 1.f / size_;
    // A margin of one cell all around: a path that rounding puts a little outside is not lost.
    origin_ = bounds.lower - Vec3f(size_, size_, size_);
    const auto count = [&](float extent) {
        return static_cast<unsigned>(std::ceil(extent * inverse_size_)) + 2;
    };
    nx_ = count(d.x), ny_ = count(d.y), nz_ = count(d.z);
    cells_.resize(std::size_t(nx_) * ny_ * nz_);

    const auto blocks = [](unsigned n) { return (n + block - 1) / block; };
    const unsigned bx = blocks(nx_), by = blocks(ny_), bz = blocks(nz_);
    const float unlimited = length(d) + 4.f * size_;
    WorkPhase phase(work, "distance grid", bx * by * bz);
    tbb::parallel_for(0u, bx * by * bz, [&](unsigned b) {
        phase.advance();
        const unsigned x0 = b % bx * block, y0 = b / bx % by * block, z0 = b / (bx * by) * block;
        const Point3f middle =
            origin_ +
            Vec3f(float(x0) + block / 2, float(y0) + block / 2, float(z0) + block / 2) * size_;
        const float middle_distance = rays.distance(middle, unlimited, {}, tolerance);
        for (unsigned z = z0; z < std::min(z0 + block, nz_); ++z)
            for (unsigned y = y0; y < std::min(y0 + block, ny_); ++y) {
                float before = unlimited;  // distance at the cell before in the row
                for (unsigned x = x0; x < std::min(x0 + block, nx_); ++x) {
                    const Point3f c =
                        origin_ + Vec3f(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) * size_;
                    const float offset = length(c - middle);
                    // The triangle inequality bounds the distance from both sides. Deep inside, the
                    // lower bound is good enough (within a factor of three); nearer the surface the
                    // upper one shortens the search.
                    float distance = (1.f - tolerance) * middle_distance - offset;
                    if (distance < offset) {
                        const float most =
                            std::min(middle_distance + offset, before + size_) + 1e-3f * size_;
                        before = rays.distance(c, most, {}, tolerance);
                        distance = (1.f - tolerance) * before;
                    }
                    cells_[index(int(x), int(y), int(z))] = {
                        std::max(0.f, distance - half_diagonal()), -1};
                }
            }
    });
}

Point3f DistanceGrid::center(std::size_t cell) const {
    const std::size_t x = cell % nx_, y = cell / nx_ % ny_, z = cell / (std::size_t(nx_) * ny_);
    return origin_ + Vec3f(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) * size_;
}

}  // namespace nacre
