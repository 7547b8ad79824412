// Factorisation of BRDFs: the largest singular values against all of them, in one run, and measured
// data from the table to the textures.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>

#include "nacre/measured/factor/factorise.h"
#include "nacre/measured/factor/partial_svd.h"

namespace {

using namespace nacre;

const FactorMatrix& matrix_of(int side, FactorParameters parameters) {
    static std::map<std::pair<int, FactorParameters>, FactorMatrix> made;
    FactorMatrix& m = made[{side, parameters}];
    if (m.grid.side != side || m.values[0].empty())
        m = sample_matrix(*make_target("ward variant=duer kd=0.3 ks=0.3 alpha_u=0.2 alpha_v=0.5"),
                          {parameters, side});
    return m;
}

void report_difference(benchmark::State& state, const FactorMatrix& m) {
    const Svd part = partial_svd(m.values[0], m.grid.count(), 16);
    const Svd full = full_svd(m.values[0], m.grid.count());
    double largest = 0.;
    for (int j = 0; j < 16; ++j)
        largest = std::max(largest, std::abs(part.sigma[j] - full.sigma[j]) / full.sigma[0]);
    state.counters["difference"] = largest;
}

/// Sixteen singular values of the matrix of light and view directions.
void partial(benchmark::State& state) {
    const FactorMatrix& m = matrix_of(int(state.range(0)), FactorParameters::in_out);
    for (auto _ : state) benchmark::DoNotOptimize(partial_svd(m.values[0], m.grid.count(), 16));
    if (state.range(0) <= 16) report_difference(state, m);
}
void full(benchmark::State& state) {
    const FactorMatrix& m = matrix_of(int(state.range(0)), FactorParameters::in_out);
    for (auto _ : state) benchmark::DoNotOptimize(full_svd(m.values[0], m.grid.count()));
}
BENCHMARK(partial)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(full)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

/// A measured BRDF of 90 x 90 x 180 values, read, at R = 32: J = 1, 2, 4, 8 with all their errors.
void felt(benchmark::State& state) {
    const std::filesystem::path file = NACRE_SHARED_DIR "/data/brdf/merl/pink-felt.nbrdf.binary";
    if (!std::filesystem::exists(file)) {
        state.SkipWithError("no measured BRDF");
        return;
    }
    const auto target = make_target(file.string());
    FactorOptions o;
    o.grid = {FactorParameters(state.range(0)), 32};
    o.terms = {1, 2, 4, 8};
    for (auto _ : state) {
        const Factorisation f = factorise(*target, o);
        state.counters["error"] = f.errors.back().matrix;
        state.counters["sampling"] = f.seconds_sampling;
        state.counters["factoring"] = f.seconds_factoring;
    }
    state.SetLabel(std::string(name_of(o.grid.parameters)));
}
BENCHMARK(felt)
    ->Arg(int(FactorParameters::in_out))
    ->Arg(int(FactorParameters::half_difference))
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
