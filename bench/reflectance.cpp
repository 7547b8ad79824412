// Values of reflectance models: packs of directions against one after the other, in one run.
// `items_per_second` is evaluations per second on one core; random directions above the horizon,
// half of them near the mirror direction, 4096 pairs that stay in the cache.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "nacre/math/random.h"
#include "nacre/reflectance/blinn_phong.h"
#include "nacre/reflectance/blinn_torrance_sparrow.h"
#include "nacre/reflectance/cook_torrance.h"
#include "nacre/reflectance/eon.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/ggx_smith.h"
#include "nacre/reflectance/he_torrance.h"
#include "nacre/reflectance/lafortune.h"
#include "nacre/reflectance/lambert.h"
#include "nacre/reflectance/metallic_roughness.h"
#include "nacre/reflectance/models.h"
#include "nacre/reflectance/oren_nayar.h"
#include "nacre/reflectance/phong.h"
#include "nacre/reflectance/poulin_fournier.h"
#include "nacre/reflectance/registry.h"
#include "nacre/reflectance/schlick.h"
#include "nacre/reflectance/schlick_ct.h"
#include "nacre/reflectance/torrance_sparrow.h"
#include "nacre/reflectance/ward.h"

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

/// One pair after the other.
using EvalEach = void (*)(const ValuesF&, const Pairs&, std::vector<float>&);
template <template <class, class, class> class Model>
void eval_each(const ValuesF& values, const Pairs& pairs, std::vector<float>& out) {
    const Model<float, float, float> model = make_model_of<Model, float, float, float>(values);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = model.eval(pairs.wi[i], pairs.wo[i]);
}

EvalEach eval_each_of(const ModelDescription& model) {
#define NACRE_EVAL_EACH(Model) \
    if (&Model<float, float, float>::describe() == &model) return eval_each<Model>;
    NACRE_MODELS(NACRE_EVAL_EACH)
#undef NACRE_EVAL_EACH
    return nullptr;
}

void evaluate(benchmark::State& state, const AnyModel& model, bool packs) {
    static const Pairs pairs;
    std::vector<float> out(pairs.wi.size());
    const ValuesF values = model.values_float(550.f);
    const EvalEach each = eval_each_of(model.description());
    for (auto _ : state) {
        if (packs)
            model.evaluator().eval_many(values, pairs.wi, pairs.wo, out);
        else
            each(values, pairs, out);
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
