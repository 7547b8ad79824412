// Throughput of the elementary functions on a path's four wavelengths, against the same four with
// the standard library.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "nacre/math/lanes_math.h"

namespace {

using nacre::Spectral;

template <class F>
void lanes(benchmark::State& state, F f) {
    Spectral x(0.1f, 0.7f, 1.3f, 2.9f);
    for (auto _ : state) {
        benchmark::DoNotOptimize(x);
        benchmark::DoNotOptimize(f(x));
    }
    state.SetItemsProcessed(4 * state.iterations());
}

template <class F>
void scalars(benchmark::State& state, F f) {
    std::array<float, 4> x{0.1f, 0.7f, 1.3f, 2.9f};
    for (auto _ : state) {
        benchmark::DoNotOptimize(x);
        for (float v : x) benchmark::DoNotOptimize(f(v));
    }
    state.SetItemsProcessed(4 * state.iterations());
}

BENCHMARK_CAPTURE(lanes, exp, [](Spectral x) { return nacre::exp(x); });
BENCHMARK_CAPTURE(scalars, exp, [](float x) { return std::exp(x); });
BENCHMARK_CAPTURE(lanes, log, [](Spectral x) { return nacre::log(x); });
BENCHMARK_CAPTURE(scalars, log, [](float x) { return std::log(x); });
BENCHMARK_CAPTURE(lanes, sin, [](Spectral x) { return nacre::sin(x); });
BENCHMARK_CAPTURE(scalars, sin, [](float x) { return std::sin(x); });

}  // namespace
