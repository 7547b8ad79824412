// Layers: photons a second, in packs against a plain loop, on one thread; adding and doubling.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/random.h"

namespace {

using namespace nacre;

constexpr double infinite = std::numeric_limits<double>::infinity();

Layer van_de_hulst() { return {0.9, 0.1, 0.75, 2., 1.}; }
Layer half_space() { return {0.9, 0.1, 0., infinite, 1.5}; }
Layer marble() { return {2.19, 0.0021, 0., infinite, 1.5}; }  // Jensen et al. 2001, red

/// Hanrahan and Krueger's walk, one photon in double precision, between air, with the standard
/// library's functions; what leaves at the top. MCML's roulette.
double walk(const Layer& l, Random& random) {
    const double f0 = std::pow((l.eta - 1.) / (l.eta + 1.), 2.);
    double x = 0., y = 0., z = 0., ux = 0., uy = 0., uz = 1., weight = 1. - f0;
    const auto next = [&] { return double(random.next_bits() >> 11) * 0x1p-53; };
    for (;;) {
        double step = -std::log(1. - next()) / l.sigma_t();
        for (;;) {  // to the collision, reflected at the faces
            const double face = uz > 0. ? l.thickness : 0.;
            const double distance = uz != 0. ? (face - z) / uz : infinite;
            if (step < distance) break;
            x += ux * distance, y += uy * distance, z = face, step -= distance;
            const double c = std::abs(uz), sine2 = (1. - c * c) * l.eta * l.eta;
            double r = 1.;
            if (sine2 < 1.) {
                const double t = std::sqrt(1. - sine2);
                const double s = (l.eta * c - t) / (l.eta * c + t),
                             p = (c - l.eta * t) / (c + l.eta * t);
                r = 0.5 * (s * s + p * p);
            }
            if (next() >= r) return uz < 0. ? weight : 0.;
            uz = -uz;
        }
        x += ux * step, y += uy * step, z += uz * step;
        weight *= l.albedo();
        if (weight < 1e-4) {
            if (next() >= 0.1) return 0.;
            weight *= 10.;
        }
        const double u = next();
        double c = 2. * u - 1.;
        if (l.g != 0.) {
            const double q = (1. - l.g * l.g) / (1. - l.g + 2. * l.g * u);
            c = (1. + l.g * l.g - q * q) / (2. * l.g);
        }
        const double s = std::sqrt(std::max(0., 1. - c * c));
        const double phi = 2. * std::numbers::pi * next(), a = s * std::cos(phi),
                     b = s * std::sin(phi);
        const double across = std::sqrt(std::max(0., 1. - uz * uz));
        if (across < 1e-6) {
            ux = a, uy = b, uz = std::copysign(1., uz) * c;
        } else {
            const double vx = ux, vy = uy;
            ux = a * (vx * uz) / across - b * vy / across + vx * c;
            uy = a * (vy * uz) / across + b * vx / across + vy * c;
            uz = uz * c - a * across;
        }
    }
}

void plain_loop(benchmark::State& state, const Layer& layer) {
    Random random(1);
    double sum = 0.;
    for (auto _ : state) sum += walk(layer, random);
    state.SetItemsProcessed(state.iterations());
    state.counters["reflectance"] = sum / double(state.iterations());
}

/// Packs with MCML's roulette (so that both do the same work) or the default; depth only, or also
/// the distance from the beam.
void packs(benchmark::State& state, const Layer& layer, bool same_roulette, bool lateral) {
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    SlabMonteCarloOptions options;
    options.photons = 1 << 20;
    if (same_roulette) options.roulette_weight = 1e-4, options.roulette_gain = 10.;
    if (lateral) options.bins.radius = 100, options.bins.radius_width = 0.1;
    SlabMonteCarloResult r;
    for (auto _ : state) {
        r = slab_monte_carlo({{layer}}, options);
        ++options.seed;
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(r.photons));
    state.counters["reflectance"] = r.totals.reflectance - r.totals.specular;
}

void all(const char* name, const Layer& layer) {
    const auto add = [&](const char* how, auto run) {
        benchmark::RegisterBenchmark((std::string(name) + "/" + how).c_str(), run);
    };
    add("plain", [=](benchmark::State& s) { plain_loop(s, layer); });
    add("packs", [=](benchmark::State& s) { packs(s, layer, true, false); });
    add("packs_lateral", [=](benchmark::State& s) { packs(s, layer, true, true); });
    add("packs_default_roulette", [=](benchmark::State& s) { packs(s, layer, false, false); });
}

/// 31 wavelengths of a skin of five layers with five indices.
void skin(benchmark::State& state) {
    const int nodes = int(state.range(0));
    const double normal[] = {1.};
    for (auto _ : state)
        for (int i = 0; i < 31; ++i) {
            const double s = std::pow((400. + 10. * i) / 500., -1.5), blood = 1. / (1. + i);
            const LayerStack stack{{{100. * s, 0.1 + blood, 0.92, 0.02, 1.55},
                                    {45. * s, 0.5 + 2. * blood, 0.8, 0.08, 1.4},
                                    {20. * s, 0.05 + 0.5 * blood, 0.8, 0.2, 1.36},
                                    {20. * s, 0.05 + 0.3 * blood, 0.8, 1.5, 1.38},
                                    {5. * s, 0.05, 0.75, 3., 1.44}}};
            benchmark::DoNotOptimize(adding_doubling(stack, normal, {}, {1e-4, nodes}));
        }
}
BENCHMARK(skin)->Arg(16)->Arg(24)->Arg(32)->Arg(0)->Unit(benchmark::kMillisecond);

void half_space_adding(benchmark::State& state) {
    const double normal[] = {1.};
    for (auto _ : state) benchmark::DoNotOptimize(adding_doubling({{half_space()}}, normal));
}
BENCHMARK(half_space_adding)->Unit(benchmark::kMicrosecond);

const bool registered = [] {
    all("van_de_hulst", van_de_hulst());
    all("half_space", half_space());
    all("marble", marble());
    return true;
}();

}  // namespace
