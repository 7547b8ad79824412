// Values of reflectance models: packs of directions against one after the other, in one run.
// `items_per_second` is evaluations per second on one core; random directions above the horizon,
// half of them near the mirror direction, 4096 pairs that stay in the cache.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "nacre/math/random.h"
#include "nacre/reflectance/registry.h"

namespace {

using namespace nacre;

struct Pairs {
    std::vector<Vec3f> wi, wo;
    Pairs() {
        Random random(stream_key(1, 1));
        const auto direction = [&] {
            const float z = 0.02f + 0.98f * random.next(), phi = 6.2831853f * random.next();
            const float s = std::sqrt(1.f - z * z);
            return Vec3f{s * std::cos(phi), s * std::sin(phi), z};
        };
        for (int i = 0; i < 4096; ++i) {
            wi.push_back(direction());
            const Vec3f jitter = direction() * 0.2f;
            const Vec3f near = Vec3f{-wi[i].x, -wi[i].y, wi[i].z} + jitter;
            wo.push_back(i % 2 ? direction() : normalize(near));
        }
    }
};

void evaluate(benchmark::State& state, const AnyModel& model, bool packs) {
    static const Pairs pairs;
    std::vector<float> out(pairs.wi.size());
    const ValuesF values = model.values_float(550.f);
    for (auto _ : state) {
        if (packs)
            model.evaluator().eval_many(values, pairs.wi, pairs.wo, out);
        else
            model.evaluator().eval_each(values, pairs.wi, pairs.wo, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(std::int64_t(out.size()) * state.iterations());
}

/// One benchmark for each behaviour of each model, at its first example.
const bool registered = [] {
    for (const ModelDescription* m : models())
        for (const Behaviour& b : m->behaviours) {
            const std::string settings = fmt::format("{} {}", b.options, b.examples.front());
            for (const bool packs : {true, false})
                benchmark::RegisterBenchmark(
                    fmt::format("{}{}{}/{}", m->name, b.options.empty() ? "" : "/", b.options,
                                packs ? "packs" : "float")
                        .c_str(),
                    [m, settings, packs](benchmark::State& state) {
                        evaluate(state, make_model(m->name, parse_settings(settings)), packs);
                    });
        }
    return true;
}();

}  // namespace
