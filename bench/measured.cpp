// Measured reflectance as renderers use it, in pairs of directions (`items_per_second`) on one core: three
// channels of 65,536 random pairs by the cosine, by single calls and by calls that take all. MERL's
// table holds GGX here; files of other formats come from ../shared and are left out where that is
// not there.
#include <benchmark/benchmark.h>

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>

#include "nacre/math/random.h"
#include "nacre/math/warp.h"
#include "nacre/measured/formats.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/surface.h"
#include "nacre/reflectance/registry.h"

namespace {

using namespace nacre;

constexpr std::size_t count = 65536;

struct Pairs {
    std::array<Vec3f, count> wi, wo;
    std::array<Vec2f, count> u;
    std::array<float, count> u1;
    Pairs() {
        Random random(stream_key(1, 1));
        for (std::size_t i = 0; i < count; ++i) {
            wi[i] = square_to_cosine_hemisphere(random.next2());
            wo[i] = square_to_cosine_hemisphere(random.next2());
            u[i] = random.next2();
            u1[i] = random.next();
        }
    }
};
const Pairs pairs;

/// A table of MERL's of a model.
std::string merl_bytes() {
    const AnyModel model = make_model("ggx", {{"alpha", "0.2"}});
    const std::int32_t header[3] = {90, 90, 180};
    const std::size_t nodes = 90 * 90 * 180;
    std::vector<double> plane(nodes);
    std::size_t i = 0;
    for (int h = 0; h < 90; ++h)
        for (int d = 0; d < 90; ++d)
            for (int p = 0; p < 180; ++p, ++i) {
                const double x = h / 90., degree = std::numbers::pi / 180.;
                const DirectionPair w = from_half_angle(
                    {.theta_h = x * x * 90. * degree, .theta_d = d * degree, .phi_d = p * degree});
                plane[i] = w.wi.z > 0. && w.wo.z > 0. ? 1500. * model.eval(w.wi, w.wo) : -1.;
            }
    std::string bytes(sizeof header + 3 * nodes * sizeof(double), '\0');
    std::memcpy(bytes.data(), header, sizeof header);
    for (int c = 0; c < 3; ++c)
        std::memcpy(bytes.data() + sizeof header + c * nodes * sizeof(double), plane.data(),
                    nodes * sizeof(double));
    return bytes;
}

const MeasuredSurface& surface(int which) {
    static std::array<std::unique_ptr<MeasuredSurface>, 3> made;
    static const char* files[] = {nullptr, "rgl/satin_rosaline_rgb.bsdf", "cornell/cayman.brdf"};
    auto& s = made[which];
    if (!s && which == 0) {
        const std::string bytes = merl_bytes();
        s = std::make_unique<MeasuredSurface>(parse_measured({bytes, "ggx.binary"}));
    } else if (!s) {
        s = std::make_unique<MeasuredSurface>(
            read_measured(std::filesystem::path(NACRE_SHARED_DIR "/data/brdf") / files[which]));
    }
    return *s;
}

/// By calls that answer all pairs at once.
template <class Step>
void run_many(benchmark::State& state, Step&& step) {
    try {
        surface(int(state.range(0)));
    } catch (const std::exception&) {
        state.SkipWithError("needs ../shared/data/brdf");
        return;
    }
    const MeasuredSurface& s = surface(int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(step(s));
    state.SetItemsProcessed(std::int64_t(count) * state.iterations());
    state.SetLabel(s.info().format);
}

template <class Step>
void run(benchmark::State& state, Step&& step) {
    run_many(state, [&](const MeasuredSurface& s) {
        float sum = 0.f;
        for (std::size_t i = 0; i < count; ++i) sum += step(s, i);
        return sum;
    });
}

void evaluate(benchmark::State& state) {
    run(state, [](const MeasuredSurface& s, std::size_t i) {
        float out[max_measured_channels];
        s.eval(pairs.wi[i], pairs.wo[i], out);
        return out[0] + out[1] + out[2];
    });
}
void density(benchmark::State& state) {
    run(state,
        [](const MeasuredSurface& s, std::size_t i) { return s.pdf(pairs.wi[i], pairs.wo[i]); });
}
void sample(benchmark::State& state) {
    run(state, [](const MeasuredSurface& s, std::size_t i) {
        const auto w = s.sample(pairs.wo[i], pairs.u1[i], pairs.u[i]);
        return w ? w->x : 0.f;
    });
}
void evaluate_many(benchmark::State& state) {
    run_many(state, [](const MeasuredSurface& s) {
        static std::vector<float> out(count * max_measured_channels);
        s.eval_many(pairs.wi, pairs.wo, std::span(out).first(count * s.info().channels), {});
        return out[0];
    });
}
void density_many(benchmark::State& state) {
    run_many(state, [](const MeasuredSurface& s) {
        static std::array<float, count> out;
        s.eval_many(pairs.wi, pairs.wo, {}, out);
        return out[0];
    });
}
void sample_many(benchmark::State& state) {
    run_many(state, [](const MeasuredSurface& s) {
        static std::array<Vec3f, count> out;
        s.sample_many(pairs.wo, pairs.u1, pairs.u, out);
        return out[0].x;
    });
}
BENCHMARK(evaluate)->DenseRange(0, 2);
BENCHMARK(evaluate_many)->DenseRange(0, 2);
BENCHMARK(density)->DenseRange(0, 2);
BENCHMARK(density_many)->DenseRange(0, 2);
BENCHMARK(sample)->DenseRange(0, 2);
BENCHMARK(sample_many)->DenseRange(0, 2);

}  // namespace
