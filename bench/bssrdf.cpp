// Diffusion profiles, in evaluations (`items_per_second`) on one core: the classical dipole at 4096
// squared distances that stay in the cache, one after the other and in packs; four wavelengths at
// once; and tables of the same profile.
#include <benchmark/benchmark.h>

#include <array>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/bssrdf/radial_table.h"
#include "nacre/math/lanes_wide.h"
#include "nacre/math/random.h"

namespace {

using namespace nacre;

constexpr std::size_t count = 4096;

struct Distances {
    std::array<float, count> r2, u;
    Distances() {
        Random random(stream_key(1, 1));
        for (std::size_t i = 0; i < count; ++i) {
            const float r = 10.f * random.next();
            r2[i] = r * r;
            u[i] = random.next();
        }
    }
};
const Distances distances;

// Sums what `step(i)` returns for i = 0, stride, 2 stride, ...
template <class T, class Step>
void sum_over(benchmark::State& state, std::size_t stride, int items, Step&& step) {
    for (auto _ : state) {
        T sum(0.f);
        for (std::size_t i = 0; i < count; i += stride) sum += step(i);
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(std::int64_t(count / stride) * items * state.iterations());
}

template <class Model>
void one_by_one(benchmark::State& state) {
    const Model model(1.f, 0.01f, 1.3);
    sum_over<float>(state, 1, 1, [&](std::size_t i) { return model.eval(distances.r2[i]); });
}
template <class Model>
void packs(benchmark::State& state) {
    const Model model(Wide(1.f), Wide(0.01f), 1.3);
    sum_over<Wide>(state, Wide::size, Wide::size,
                   [&](std::size_t i) { return model.eval(Wide::load(&distances.r2[i])); });
}
BENCHMARK(one_by_one<Dipole<float>>)->Name("dipole/float");
BENCHMARK(packs<Dipole<Wide>>)->Name("dipole/packs");
BENCHMARK(one_by_one<BetterDipole<float>>)->Name("better_dipole/float");
BENCHMARK(packs<BetterDipole<Wide>>)->Name("better_dipole/packs");

// Items are wavelengths: four an evaluation.
void wavelengths(benchmark::State& state) {
    const Dipole<Spectral> model(Spectral(1.f, 2.f, 3.f, 4.f), Spectral(0.01f), 1.3);
    sum_over<Spectral>(state, 1, 4,
                       [&](std::size_t i) { return model.eval(Spectral(distances.r2[i])); });
}
BENCHMARK(wavelengths)->Name("dipole/wavelengths");

const RadialTable& table() {
    static const RadialTable t(*make_profile("dipole", ProfileMedium::reduced(1., 0.01, 1.3)));
    return t;
}
void table_values(benchmark::State& state) {
    sum_over<float>(state, 1, 1, [&](std::size_t i) { return table().eval(distances.r2[i]); });
}
void table_samples(benchmark::State& state) {
    sum_over<float>(state, 1, 1, [&](std::size_t i) { return table().sample(distances.u[i]); });
}
void table_densities(benchmark::State& state) {
    sum_over<float>(state, 1, 1, [&](std::size_t i) { return table().pdf(distances.r2[i]); });
}
BENCHMARK(table_values)->Name("table/eval");
BENCHMARK(table_samples)->Name("table/sample");
BENCHMARK(table_densities)->Name("table/pdf");

void table_wavelengths(benchmark::State& state) {
    const auto a = make_profile("dipole", ProfileMedium::reduced(1., 0.01, 1.3));
    const auto b = make_profile("dipole", ProfileMedium::reduced(2., 0.01, 1.3));
    const SpectralRadialTable t(
        std::array<const RadialProfile*, 4>{a.get(), b.get(), a.get(), b.get()});
    sum_over<Spectral>(state, 1, 4, [&](std::size_t i) { return t.eval(distances.r2[i]); });
}
BENCHMARK(table_wavelengths)->Name("table/wavelengths");

}  // namespace
