#include "nacre/compare/model_comparison.h"

#include <tbb/task_arena.h>

#include <chrono>
#include <numbers>
#include <set>

#include "nacre/math/error.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

std::string id_of(const ModelSpec& spec) {
    return spec.settings.empty() ? spec.name
                                 : fmt::format("{} {}", spec.name, settings_text(spec.settings));
}

double seconds_per_million(const AnyModel& model) {
    constexpr std::size_t count = 16384;
    std::vector<Vec3f> wi(count), wo(count);
    std::vector<float> out(count);
    Random random(stream_key(5, 1));
    const auto draw = [&] {
        const float z = std::max(random.next(), 0.01f), s = std::sqrt(1.f - z * z);
        const float phi = 2.f * std::numbers::pi_v<float> * random.next();
        return Vec3f(s * std::cos(phi), s * std::sin(phi), z);
    };
    for (std::size_t i = 0; i < count; ++i) {
        wi[i] = draw();
        wo[i] = draw();
    }
    std::array<double, 7> seconds;
    for (double& s : seconds) {
        const auto begin = std::chrono::steady_clock::now();
        model.eval_many(wi, wo, out);
        s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    std::nth_element(seconds.begin(), seconds.begin() + 3, seconds.end());
    return seconds[3] / count * 1e6;
}

void measure(ComparedModel& m, const BrdfPortrait& reference) {
    const AnyModel& model = m.fit->model;
    m.portrait = make_portrait(bands_of(model));
    m.albedo_difference = albedo_difference(m.portrait, reference);
    for (int i = 0; i < BrdfPortrait::albedo_count; ++i)
        for (int c = 0; c < 3; ++c)
            if (m.portrait.albedo[i][c] > m.largest_albedo) {
                m.largest_albedo = m.portrait.albedo[i][c];
                m.largest_albedo_angle = BrdfPortrait::albedo_angle(i);
            }
    m.seconds_per_million = seconds_per_million(model);
    const Behaviour& behaviour = behaviour_of(model);
    m.reciprocal = behaviour.reciprocal;
    m.energy = behaviour.energy;
}

ModelComparison compare(std::span<const ModelSpec> models, const Target& target,
                        const ModelComparisonOptions& options) {
    ModelComparison r;
    r.metric = options.metric;
    r.target = target.name();
    check_models(models);
    for (const ModelSpec& spec : models)
        r.models.push_back({.id = id_of(spec),
                            .description = &find_evaluator(spec.name).description(),
                            .why = {},
                            .fit = {}});
    const TargetSamples samples = sample_target(target);
    r.directions = samples.size();
    r.missing_directions = samples.missing;
    r.isotropic = samples.isotropic;
    r.reference = make_portrait(bands_of(target));
    r.pictures["reference"] = r.reference.sphere;
    r.pictures["slice reference"] = r.reference.slice;

    const auto stopped = [&] { return options.stop && *options.stop; };
    const int total = int(models.size());
    for (int i = 0; i < total && !stopped(); ++i) {
        ComparedModel& m = r.models[i];
        if (options.progress) options.progress(m.id, i, total);
        try {
            m.fit = fit_model(find_evaluator(models[i].name), models[i].settings, samples,
                              {.metric = options.metric, .stop = options.stop});
            if (stopped()) break;
            measure(m, r.reference);
            m.status = ComparedModel::Status::ok;
            r.pictures[m.id] = m.portrait.sphere;
            r.pictures["slice " + m.id] = m.portrait.slice;
        } catch (const RunError& e) {
            m.status = ComparedModel::Status::failed;
            m.why = e.what();
        }
    }
    r.complete = std::none_of(r.models.begin(), r.models.end(), [](const ComparedModel& m) {
        return m.status == ComparedModel::Status::missing;
    });
    if (options.progress) options.progress("", total, total);
    return r;
}

}  // namespace

const Behaviour& behaviour_of(const AnyModel& model) {
    const ModelDescription& d = model.description();
    const ValuesD values = model.values_double(550.);
    for (const Behaviour& b : d.behaviours) {
        bool fits = true;
        for (const Setting& s : parse_settings(b.options)) {
            const auto* word = std::get_if<std::string>(&s.value);
            for (int i : find_parameters(d.name, d.parameters, s.name)) {
                const double is = d.parameters[i].kind == ParameterKind::choice ? values.option[i]
                                                                                : values.scalar[i];
                const double wanted =
                    word ? find_choice(d.name, d.parameters[i], *word) : std::get<double>(s.value);
                fits = fits && is == wanted;
            }
        }
        if (fits) return b;
    }
    return d.behaviours.front();
}

void check_models(std::span<const ModelSpec> models) {
    std::set<std::string> ids;
    for (const ModelSpec& spec : models) {
        AnyModel(find_evaluator(spec.name), spec.settings, Bounds::ranges_only);
        if (!ids.insert(id_of(spec)).second)
            throw InputError(fmt::format("the model '{}' is given twice", id_of(spec)));
    }
}

ModelComparison compare_models(std::span<const ModelSpec> models, const Target& target,
                               const ModelComparisonOptions& options) {
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    return arena.execute([&] { return compare(models, target, options); });
}

}  // namespace nacre
