// The hierarchy of the two-pass technique on the benchmark bunny of marble, points one transport
// mean free path apart, irradiance as of a light from the side: time of a lookup at surface points,
// its mean relative error against the sum over all points, and time to build. One thread.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/surface_points.h"
#include "nacre/optics/media.h"
#include "nacre/subsurface/two_pass.h"

namespace {

using namespace nacre;

struct Bunny {
    SurfacePointSet points;
    std::vector<float> power;
    std::vector<DipoleKernel> kernels;

    Bunny() {
        const std::filesystem::path file = NACRE_SHARED_DIR "/bench/bunny_watertight.obj";
        if (!std::filesystem::exists(file)) return;
        const MeasuredMedium& marble = measured_media().find("marble");
        for (int c = 0; c < 3; ++c)
            kernels.push_back(make_kernel(
                "dipole", ProfileMedium::reduced(marble.sigma_s_prime[std::size_t(c)],
                                                 marble.sigma_a[std::size_t(c)], marble.eta)));
        const Vec3f t = marble.sigma_t_prime();
        points = points_for_spacing(*load_mesh(file), 1. / std::max({t.x, t.y, t.z}),
                                    PointMethod::elimination, 1);
        const Vec3f light = normalize(Vec3f{-1.f, 1.f, 0.5f});
        for (std::size_t i = 0; i < points.p.size(); ++i)
            for (int c = 0; c < 3; ++c)
                power.push_back(points.area[i] * (0.1f + std::max(0.f, dot(points.n[i], light))));
    }
    IrradianceTree tree(float epsilon) const { return {points.p, points.area, power, 3, epsilon}; }
};

const Bunny& bunny() {
    static const Bunny b;
    return b;
}

/// Exits between the points, as pixels see them: every 97th point moved by a little.
Point3f exit_at(std::size_t i) {
    const Bunny& b = bunny();
    const std::size_t k = i * 97 % b.points.p.size();
    return b.points.p[k] + Framef::around(b.points.n[k]).s * 0.15f;
}

void lookup(benchmark::State& state) {
    const Bunny& b = bunny();
    if (b.points.p.empty()) return state.SkipWithError("../shared/bench is absent");
    const IrradianceTree tree = b.tree(float(state.range(0)) * 1e-3f);
    float m[3];
    std::size_t i = 0;
    for (auto _ : state) {
        tree.gather(exit_at(i++), b.kernels, m);
        benchmark::DoNotOptimize(m);
    }
    const IrradianceTree exact = b.tree(0.f);
    double error = 0.;
    constexpr int checked = 200;
    for (std::size_t k = 0; k < checked; ++k) {
        float e[3];
        tree.gather(exit_at(37 * k), b.kernels, m);
        exact.gather(exit_at(37 * k), b.kernels, e);
        for (int c = 0; c < 3; ++c) error += std::abs(m[c] - e[c]) / e[c] / (3 * checked);
    }
    state.counters["points"] = double(b.points.p.size());
    state.counters["mean_error"] = error;
}
BENCHMARK(lookup)->ArgName("milli_sr")->Arg(20)->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Arg(1000);

void build(benchmark::State& state) {
    const Bunny& b = bunny();
    if (b.points.p.empty()) return state.SkipWithError("../shared/bench is absent");
    for (auto _ : state) benchmark::DoNotOptimize(b.tree(0.05f).bytes());
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

}  // namespace
