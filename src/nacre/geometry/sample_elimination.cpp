#include "nacre/geometry/sample_elimination.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>

#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/mesh_topology.h"
#include "nacre/geometry/surface_grid.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// What one candidate adds to the weight of another. Taken as nothing beyond 0.82 of 2 r, which
// holds a third of all pairs: there it is at most 0.18^8 = 1e-6, a sixtieth of what the nearest
// neighbours add in the end, 0.7 of 2 r away.
class Crowding {
  public:
    Crowding(double area, std::size_t count, std::size_t candidates)
        : diameter_(
              static_cast<float>(std::sqrt(2 * area / (std::numbers::sqrt3 * double(count))))),
          least_(static_cast<float>(diameter_ * 0.65 *
                                    (1 - std::pow(double(count) / double(candidates), 1.5)))) {}

    float reach() const { return 0.82f * diameter_; }
    float operator()(const SheetPoint& a, const SheetPoint& b) const {
        const float squared = length_squared(a.p - b.p);
        if (squared >= reach() * reach() || !same_sheet(a, b)) return 0.f;
        const float near = 1 - std::max(std::sqrt(squared), least_) / diameter_;
        const float near2 = near * near, near4 = near2 * near2;
        return near4 * near4;
    }

  private:
    float diameter_, least_;  ///< 2 r and 2 r_min
};

// What every candidate adds to the weights of those around it, by slots of the grid. Kept rather
// than found again at each elimination, which come in random order: one list in a row instead of
// the candidates of 27 cells.
class Neighbours {
  public:
    struct Other {
        std::uint32_t slot;
        float weight;
    };

    Neighbours(const SurfaceGrid& grid, const Crowding& crowding, const Work& work)
        : of_cell_(grid.cells()), of_slot_(grid.points().size()) {
        WorkPhase phase(work, "surface points: neighbours", grid.cells());
        const std::span<const SheetPoint> points = grid.points();
        tbb::parallel_for(std::size_t(0), grid.cells(), [&](std::size_t cell) {
            const SurfaceGrid::Around near = grid.around(cell);
            std::vector<Other> others;
            std::vector<std::size_t> ends;
            for (std::uint32_t slot = grid.begin(cell); slot < grid.end(cell); ++slot) {
                near.for_each([&](std::uint32_t other) {
                    const float weight = crowding(points[slot], points[other]);
                    if (weight > 0.f && other != slot) others.push_back({other, weight});
                });
                ends.push_back(others.size());
            }
            of_cell_[cell] = {others.begin(), others.end()};  // without spare room
            std::size_t begin = 0;
            for (std::uint32_t slot = grid.begin(cell); const std::size_t end : ends) {
                of_slot_[slot++] = std::span(of_cell_[cell]).subspan(begin, end - begin);
                begin = end;
            }
            phase.advance();
        });
    }

    std::span<const Other> of(std::uint32_t slot) const { return of_slot_[slot]; }

  private:
    std::vector<std::vector<Other>> of_cell_;  ///< for the slots of a cell, one after the other
    std::vector<std::span<const Other>> of_slot_;
};

// Which slots of the grid are left when all but `count` are eliminated.
std::vector<bool> survivors(const SurfaceGrid& grid, const Crowding& crowding, std::size_t count,
                            const Work& work) {
    const Neighbours neighbours(grid, crowding, work);
    std::vector<float> weight(grid.points().size());
    // Weights only ever fall, so an entry of the heap that is out of date is too high: it comes up
    // early and is put back with its present weight. That spares finding and moving the entries of
    // all neighbours of each eliminated point.
    struct Entry {
        float weight;
        std::uint32_t slot;
        bool operator<(const Entry& b) const {
            return weight != b.weight ? weight < b.weight : slot < b.slot;
        }
    };
    std::vector<Entry> entries(weight.size());
    for (std::uint32_t slot = 0; slot < weight.size(); ++slot) {
        for (const auto& other : neighbours.of(slot)) weight[slot] += other.weight;
        entries[slot] = {weight[slot], slot};
    }
    std::priority_queue<Entry> heap({}, std::move(entries));
    std::vector<bool> alive(weight.size(), true);
    constexpr std::size_t at_a_time = 1024;
    WorkPhase phase(work, "surface points: elimination",
                    heap.size() - std::min(heap.size(), count));
    while (heap.size() > count) {
        const Entry top = heap.top();
        heap.pop();
        if (top.weight > weight[top.slot]) {
            heap.push({weight[top.slot], top.slot});
            continue;
        }
        alive[top.slot] = false;
        if (heap.size() % at_a_time == 0) phase.advance(at_a_time);
        // Not below 0 by rounding.
        for (const auto& other : neighbours.of(top.slot))
            weight[other.slot] = std::max(0.f, weight[other.slot] - other.weight);
    }
    return alive;
}

}  // namespace

SurfacePointSet eliminated_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                  const EliminationOptions& options, const Work& work) {
    check_point_count(count);
    if (!(options.candidates >= 1.f && options.candidates <= 100.f))
        throw InputError(
            fmt::format("sample elimination from {} candidates per point; give a "
                        "number from 1 to 100",
                        options.candidates));
    const auto wanted = static_cast<std::size_t>(std::ceil(double(options.candidates) * count));
    if (wanted > kMaxSurfacePoints)
        throw InputError(
            fmt::format("sample elimination of {} points would take {} candidates; "
                        "the limit is {}: ask for fewer points or fewer candidates "
                        "per point, or use repulsion",
                        count, wanted, kMaxSurfacePoints));
    const SurfacePointSet dense = random_points(mesh, wanted, seed, work);
    const double area = std::accumulate(dense.area.begin(), dense.area.end(), 0.0);
    const std::vector<std::uint32_t> component = triangle_components(mesh);
    std::vector<SheetPoint> sheet(wanted);
    for (std::size_t i = 0; i < wanted; ++i)
        sheet[i] = {dense.p[i], dense.n[i], component[dense.triangle[i]],
                    static_cast<std::uint32_t>(i)};
    work.begin("surface points: grid");
    const Crowding crowding(area, count, wanted);
    const SurfaceGrid grid(sheet, crowding.reach());
    const std::vector<bool> left = survivors(grid, crowding, count, work);

    // In the order of the candidates, which is that of the triangles.
    std::vector<std::uint32_t> kept;
    kept.reserve(count);
    for (std::uint32_t slot = 0; slot < left.size(); ++slot)
        if (left[slot]) kept.push_back(grid.points()[slot].index);
    std::sort(kept.begin(), kept.end());
    SurfacePointSet points;
    resize(points, count);
    for (std::size_t i = 0; i < count; ++i) {
        points.p[i] = dense.p[kept[i]];
        points.n[i] = dense.n[kept[i]];
        points.triangle[i] = dense.triangle[kept[i]];
        points.barycentric[i] = dense.barycentric[kept[i]];
        points.area[i] = static_cast<float>(area / double(count));
    }
    return points;
}

}  // namespace nacre
