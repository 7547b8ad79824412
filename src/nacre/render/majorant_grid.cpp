#include "nacre/render/majorant_grid.h"

#include <algorithm>
#include <cmath>

namespace nacre {

MajorantGrid::MajorantGrid(const Medium& medium) {
    if (!medium.sigma_t_volume) return;
    const Volume& volume = *medium.sigma_t_volume;
    bounds_ = volume.bounds();
    const Vec3f size = bounds_.diagonal() * (1.f / cells);
    majorants_.reserve(std::size_t(cells) * cells * cells);
    for (int z = 0; z < cells; ++z)
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x) {
                Box3f box;
                box.extend(bounds_.lower + size * Vec3f(float(x), float(y), float(z)));
                box.extend(bounds_.lower + size * Vec3f(float(x + 1), float(y + 1), float(z + 1)));
                majorants_.push_back(volume.max_in(box) * medium.scale);
            }
}

MajorantSegments::MajorantSegments(const MajorantGrid& grid, const Medium& medium, const Ray& ray,
                                   float end, const Wavelengths& wavelengths) {
    if (grid.empty()) {
        single_ = max_lane(medium.majorant(wavelengths));
        end_ = end;
        return;
    }
    // Clip to the volume's bounds, then set up the traversal.
    const Box3f& box = grid.bounds();
    float near = 0.f, far = end;
    for (std::size_t i = 0; i < 3; ++i) {
        const float inverse = 1.f / ray.d[i];
        float a = (box.lower[i] - ray.o[i]) * inverse, b = (box.upper[i] - ray.o[i]) * inverse;
        if (a > b) std::swap(a, b);
        // Comparisons written so that NaN (a ray in a face's plane) changes nothing.
        if (a > near) near = a;
        if (b < far) far = b;
    }
    if (!(near < far)) return;
    grid_ = &grid;
    t_ = near;
    end_ = far;
    const Point3f p = ray.o + ray.d * near;
    const Vec3f size = box.diagonal() * (1.f / MajorantGrid::cells);
    for (std::size_t i = 0; i < 3; ++i) {
        cell_[i] = std::clamp(static_cast<int>((p[i] - box.lower[i]) / size[i]), 0,
                              MajorantGrid::cells - 1);
        step_[i] = ray.d[i] >= 0.f ? 1 : -1;
        const bool moves = std::abs(ray.d[i]) > 1e-12f;
        const float face =
            box.lower[i] + size[i] * static_cast<float>(cell_[i] + (step_[i] > 0 ? 1 : 0));
        delta_t_[i] = moves ? size[i] / std::abs(ray.d[i]) : std::numeric_limits<float>::infinity();
        next_t_[i] = moves ? (face - ray.o[i]) / ray.d[i] : std::numeric_limits<float>::infinity();
    }
}

std::optional<MajorantSegments::Segment> MajorantSegments::next() {
    if (!(t_ < end_)) return {};
    if (!grid_) {
        const Segment all{t_, end_, single_};
        t_ = end_;
        return all;
    }
    const std::size_t axis = static_cast<std::size_t>(
        std::min_element(next_t_.begin(), next_t_.end()) - next_t_.begin());
    const Segment segment{t_, std::min(end_, std::max(t_, next_t_[axis])),
                          grid_->at(cell_[0], cell_[1], cell_[2])};
    t_ = next_t_[axis];
    cell_[axis] += step_[axis];
    next_t_[axis] += delta_t_[axis];
    if (cell_[axis] < 0 || cell_[axis] >= MajorantGrid::cells) t_ = end_;
    return segment;
}

}  // namespace nacre
