// Evenly spread points on the bunny: time of both methods and of Voronoi shares for the 120,000
// points that two-pass renderings of it take. `user` is processor time of all threads. Needs
// ../shared/bench; says so where it is absent.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/surface_points.h"

namespace nacre {
namespace {

constexpr std::size_t count = 120'000;

const Mesh* bunny(benchmark::State& state) {
    const auto path = std::filesystem::path(NACRE_SHARED_DIR) / "bench" / "bunny_watertight.obj";
    if (!std::filesystem::exists(path)) {
        state.SkipWithError(("no mesh " + path.string()).c_str());
        return nullptr;
    }
    static const std::shared_ptr<const Mesh> mesh = load_mesh(path);
    return mesh.get();
}

template <class Make>
void spread(benchmark::State& state, const Make& make) {
    const Mesh* mesh = bunny(state);
    if (!mesh) return;
    for (auto _ : state) benchmark::DoNotOptimize(make(*mesh).p.data());
    state.SetItemsProcessed(std::int64_t(count) * state.iterations());
}

void random(benchmark::State& state) {
    spread(state, [](const Mesh& mesh) { return random_points(mesh, count, 1); });
}
void elimination(benchmark::State& state) {
    spread(state, [](const Mesh& mesh) { return eliminated_points(mesh, count, 1); });
}
void repulsion(benchmark::State& state) {
    spread(state, [&](const Mesh& mesh) {
        return repelled_points(mesh, count, 1, {.sweeps = int(state.range(0))});
    });
}
void voronoi_shares(benchmark::State& state) {
    spread(state, [&](const Mesh& mesh) {
        SurfacePointSet points = random_points(mesh, count, 1);
        assign_voronoi_shares(mesh, points, int(state.range(0)));
        return points;
    });
}

void settings(benchmark::internal::Benchmark* b) {
    b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK(random)->Apply(settings);
BENCHMARK(elimination)->Apply(settings);
BENCHMARK(repulsion)->ArgName("sweeps")->Arg(20)->Arg(40)->Apply(settings);
BENCHMARK(voronoi_shares)->ArgName("samples_per_point")->Arg(16)->Arg(64)->Apply(settings);

}  // namespace
}  // namespace nacre
