#include "nacre/scene/media/volume_grid.h"

#include <tbb/parallel_for.h>

#include <mutex>

#include "nacre/math/error.h"
#include "nacre/scene/integrable_volume.h"
#include "nacre/spectrum/uplift.h"

namespace nacre {

namespace {

/// Voxels of a coarse cell along each axis, for bounds inside a box.
constexpr int brick_size = 8;

class GridVolume final : public IntegrableVolume {
  public:
    GridVolume(std::shared_ptr<const VoxelGrid> grid, const GridVolumeOptions& options)
        : grid_(std::move(grid)),
          n_{grid_->nx, grid_->ny, grid_->nz},
          filter_(options.filter),
          wrap_(options.wrap),
          everywhere_(options.role == ColorRole::reflectance) {
        const Transform::Matrix m = options.to_world.inverse().matrix();
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                to_voxels_[row][column] = static_cast<float>(m[4 * row + column] * n_[row]);
            shift_[row] = static_cast<float>(m[4 * row + 3] * n_[row]);
        }
        for (int corner = 0; corner < 8; ++corner)
            bounds_.extend(options.to_world.point(
                {float(corner & 1), float((corner >> 1) & 1), float(corner >> 2)}));
        build_bricks();
    }

    Spectral eval(const Point3f& p, const Wavelengths& w) const override {
        const Vec3f q = to_voxels(p);
        return everywhere_ || inside(q) ? value(q, w) : Spectral(0.f);
    }

    float max() const override { return max_; }

    // Between the planes where interpolation changes voxels the value is a cubic polynomial of the
    // distance, which Simpson's rule integrates exactly.
    Spectral integral(const Point3f& origin, const Vec3f& direction, float begin, float end,
                      const Wavelengths& w) const override {
        const Vec3f o = to_voxels(origin);
        Vec3f d;
        for (int i = 0; i < 3; ++i) d[i] = dot(to_voxels_[i], direction);
        const bool smooth = filter_ == VolumeFilter::trilinear;
        const float shift = smooth ? 0.5f : 0.f;
        float t = begin;
        for (int i = 0; i < 3; ++i) {
            if (std::abs(d[i]) < 1e-12f) {
                if (o[i] < 0.f || o[i] > n_[i]) return Spectral(0.f);
                continue;
            }
            const float a = -o[i] / d[i], b = (n_[i] - o[i]) / d[i];
            t = std::max(t, std::min(a, b));
            end = std::min(end, std::max(a, b));
        }
        Spectral sum(0.f);
        if (!(t < end)) return sum;
        Vec3f plane;  // the next one along each axis
        for (int i = 0; i < 3; ++i) {
            const float q = o[i] + d[i] * t - shift;
            plane[i] = shift + (d[i] > 0.f ? std::floor(q) + 1.f : std::ceil(q) - 1.f);
        }
        const auto at = [&](float s) { return value(o + d * s, w); };
        Spectral last = smooth ? at(t) : Spectral(0.f);
        while (t < end) {
            int axis = -1;
            float next = end;
            for (int i = 0; i < 3; ++i) {
                if (std::abs(d[i]) < 1e-12f) continue;
                const float s = (plane[i] - o[i]) / d[i];
                if (s < next) {
                    next = s;
                    axis = i;
                }
            }
            if (axis >= 0) plane[axis] += d[axis] > 0.f ? 1.f : -1.f;
            if (!(next > t)) continue;
            const Spectral middle = at(0.5f * (t + next)), here = smooth ? at(next) : middle;
            sum += (smooth ? last + middle * Spectral(4.f) + here : middle * Spectral(6.f)) *
                   Spectral((next - t) * (1.f / 6.f));
            last = here;
            t = next;
        }
        return sum;
    }

    float max_in(const Box3f& box) const override {
        if (box.empty()) return 0.f;
        // The box in voxel coordinates, by interval arithmetic on the affine map.
        int low[3], high[3];
        for (int row = 0; row < 3; ++row) {
            float lower = shift_[row], upper = shift_[row];
            for (int c = 0; c < 3; ++c) {
                const float a = to_voxels_[row][c] * box.lower[c],
                            b = to_voxels_[row][c] * box.upper[c];
                lower += std::min(a, b);
                upper += std::max(a, b);
            }
            // Rounding of the map, some ulp of the largest term, must not lose a voxel.
            const float slack = 1e-3f + 1e-5f * std::max(std::abs(lower), std::abs(upper));
            if (!everywhere_ && (upper + slack < 0.f || lower - slack > n_[row])) return 0.f;
            // Interpolation reaches half a voxel further and takes both neighbours.
            const float first = std::floor(lower - slack - 0.5f),
                        last = std::floor(upper + slack - 0.5f) + 1.f;
            const bool wraps = wrap_ != VolumeWrap::clamp && (first < 0.f || last >= n_[row]);
            low[row] = wraps ? 0 : static_cast<int>(std::clamp(first, 0.f, n_[row] - 1.f));
            high[row] =
                wraps ? n_[row] - 1 : static_cast<int>(std::clamp(last, 0.f, n_[row] - 1.f));
        }
        float largest = 0.f;
        for (int z = low[2] / brick_size; z <= high[2] / brick_size; ++z)
            for (int y = low[1] / brick_size; y <= high[1] / brick_size; ++y)
                for (int x = low[0] / brick_size; x <= high[0] / brick_size; ++x)
                    largest = std::max(largest, bricks_[brick(x, y, z)]);
        return largest;
    }

    Box3f bounds() const override { return bounds_; }

  private:
    /// At a place in units of voxels.
    Spectral value(const Vec3f& q, const Wavelengths& w) const {
        const Cell cell = find(q);
        if (grid_->channels == 1) {
            const float v = interpolate(
                cell, [&](std::size_t i) { return grid_->data[i]; }, 0.f);
            return w.mode == ColorMode::rgb_bands ? Spectral(v, v, v, 0.f) : Spectral(v);
        }
        if (w.mode == ColorMode::rgb_bands)
            return interpolate(
                cell,
                [&](std::size_t i) {
                    const float* rgb = &grid_->data[3 * i];
                    return Spectral(rgb[0], rgb[1], rgb[2], 0.f);
                },
                Spectral(0.f));
        const std::vector<SpectralVoxel>& spectral = spectral_voxels();
        return interpolate(
            cell,
            [&](std::size_t i) { return spectral[i].shape.eval(w.lambda) * spectral[i].scale; },
            Spectral(0.f));
    }

    /// A quantity as scale times a smooth spectrum.
    struct SpectralVoxel {
        SigmoidPolynomial shape;
        float scale;
    };
    /// The two neighbours along each axis (as offsets into the grid) and the weight of the second.
    struct Cell {
        std::size_t offset[3][2];
        float weight[3];
    };

    /// In units of voxels, 0 at the lower face of the first one.
    Vec3f to_voxels(const Point3f& p) const {
        Vec3f q = shift_;
        for (int row = 0; row < 3; ++row)
            q[row] +=
                to_voxels_[row][0] * p.x + to_voxels_[row][1] * p.y + to_voxels_[row][2] * p.z;
        return q;
    }

    bool inside(const Vec3f& q) const {
        return q.x >= 0.f && q.y >= 0.f && q.z >= 0.f && q.x <= n_[0] && q.y <= n_[1] &&
               q.z <= n_[2];
    }

    /// Brings a coordinate into [0, n].
    float wrapped(float q, int n) const {
        const auto size = static_cast<float>(n);
        switch (wrap_) {
            case VolumeWrap::clamp:
                break;
            case VolumeWrap::repeat:
                q -= size * std::floor(q / size);
                break;
            case VolumeWrap::mirror:
                q -= 2.f * size * std::floor(q / (2.f * size));
                if (q > size) q = 2.f * size - q;
                break;
        }
        return std::clamp(q, 0.f, size);
    }

    Cell find(const Vec3f& q) const {
        Cell cell;
        std::size_t stride = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const int n = n_[axis];
            const float x = wrapped(q[axis], n);
            int i, j;
            if (filter_ == VolumeFilter::nearest) {
                i = j = std::min(static_cast<int>(x), n - 1);
                cell.weight[axis] = 0.f;
            } else {
                const float below = std::floor(x - 0.5f);
                cell.weight[axis] = x - 0.5f - below;
                i = static_cast<int>(below);
                j = i + 1;
                const bool repeat = wrap_ == VolumeWrap::repeat;
                if (i < 0) i = repeat ? n - 1 : 0;
                if (j >= n) j = repeat ? 0 : n - 1;
            }
            cell.offset[axis][0] = stride * static_cast<std::size_t>(i);
            cell.offset[axis][1] = stride * static_cast<std::size_t>(j);
            stride *= static_cast<std::size_t>(n);
        }
        return cell;
    }

    template <class T, class F>
    T interpolate(const Cell& cell, F&& at, T sum) const {
        if (filter_ == VolumeFilter::nearest)
            return at(cell.offset[0][0] + cell.offset[1][0] + cell.offset[2][0]);
        for (int z = 0; z < 2; ++z) {
            const float wz = z ? cell.weight[2] : 1.f - cell.weight[2];
            for (int y = 0; y < 2; ++y) {
                const float wy = wz * (y ? cell.weight[1] : 1.f - cell.weight[1]);
                const std::size_t row = cell.offset[2][z] + cell.offset[1][y];
                sum += at(row + cell.offset[0][0]) * (wy * (1.f - cell.weight[0]));
                sum += at(row + cell.offset[0][1]) * (wy * cell.weight[0]);
            }
        }
        return sum;
    }

    std::size_t brick(int x, int y, int z) const {
        return (std::size_t(z) * bricks_n_[1] + y) * bricks_n_[0] + x;
    }

    void build_bricks() {
        for (int axis = 0; axis < 3; ++axis)
            bricks_n_[axis] = (n_[axis] + brick_size - 1) / brick_size;
        bricks_.assign(std::size_t(bricks_n_[0]) * bricks_n_[1] * bricks_n_[2], 0.f);
        const float* value = grid_->data.data();
        for (int z = 0; z < n_[2]; ++z)
            for (int y = 0; y < n_[1]; ++y)
                for (int x = 0; x < n_[0]; ++x) {
                    float& bound = bricks_[brick(x / brick_size, y / brick_size, z / brick_size)];
                    float largest = 0.f;
                    for (int c = 0; c < grid_->channels; ++c) largest = std::max(largest, *value++);
                    // A smooth spectrum exceeds the largest band of its colour where that is
                    // saturated, but never its scale of twice the largest band, nor 1 as an albedo.
                    if (grid_->channels == 3) largest = everywhere_ ? 1.f : 2.f * largest;
                    bound = std::max(bound, largest);
                }
        for (const float bound : bricks_) max_ = std::max(max_, bound);
    }

    /// Fitted when first asked for: RGB renders need none of it.
    const std::vector<SpectralVoxel>& spectral_voxels() const {
        std::call_once(spectral_made_, [this] {
            std::vector<SpectralVoxel> made(grid_->data.size() / 3);
            tbb::parallel_for(std::size_t(0), made.size(), [&](std::size_t i) {
                const float* d = &grid_->data[3 * i];
                const Vec3f rgb{d[0], d[1], d[2]};
                const float scale = everywhere_ ? 1.f : 2.f * std::max({rgb.x, rgb.y, rgb.z});
                if (scale > 0.f) made[i] = {fit_rgb(rgb * (1.f / scale)), scale};
            });
            spectral_ = std::move(made);
        });
        return spectral_;
    }

    std::shared_ptr<const VoxelGrid> grid_;
    int n_[3];
    VolumeFilter filter_;
    VolumeWrap wrap_;
    bool everywhere_;  ///< an albedo: defined outside the bounds, too
    Vec3f to_voxels_[3], shift_;
    Box3f bounds_;
    int bricks_n_[3];
    std::vector<float> bricks_;
    float max_ = 0.f;
    mutable std::once_flag spectral_made_;
    mutable std::vector<SpectralVoxel> spectral_;
};

}  // namespace

VolumePtr make_grid_volume(std::shared_ptr<const VoxelGrid> grid, const GridVolumeOptions& options,
                           const std::string& name) {
    const VoxelGrid& g = *grid;
    const bool albedo = options.role == ColorRole::reflectance;
    for (std::size_t i = 0; i < g.data.size(); ++i) {
        const float v = g.data[i];
        if (v >= 0.f && std::isfinite(v) && (!albedo || v <= 1.f)) continue;
        const std::size_t voxel = i / g.channels, plane = std::size_t(g.nx) * g.ny;
        throw InputError(fmt::format("{}: voxel ({}, {}, {}) has the value {}; {}", name,
                                     voxel % g.nx, voxel % plane / g.nx, voxel / plane, v,
                                     albedo ? "an albedo must lie within [0, 1]"
                                            : "a coefficient must be finite and at least 0"));
    }
    return std::make_shared<GridVolume>(std::move(grid), options);
}

}  // namespace nacre
