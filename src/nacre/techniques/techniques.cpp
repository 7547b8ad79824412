#include "nacre/techniques/techniques.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/technique/integrator_technique.h"
#include "nacre/text/split_words.h"

namespace nacre {
// Those on the GPU, if the library was built with them.
#ifdef NACRE_REALTIME
#define NACRE_REALTIME_TECHNIQUES(X) \
    X(translucent_shadow_map)        \
    X(image_space)                   \
    X(screen_diffusion)              \
    X(separable)                     \
    X(thickness_trick)
#else
#define NACRE_REALTIME_TECHNIQUES(X)
#endif

// Each technique's line: the function NAME_technique() of its own file describes it.
#define NACRE_TECHNIQUES(X) \
    X(simulation)           \
    X(local_reflection)     \
    X(local_scattering)     \
    X(surface_sampling)     \
    X(random_walk)          \
    X(two_pass)             \
    X(diffusion_grid)       \
    NACRE_REALTIME_TECHNIQUES(X)

#define NACRE_DECLARE_TECHNIQUE(name) const TechniqueDescription& name##_technique();
NACRE_TECHNIQUES(NACRE_DECLARE_TECHNIQUE)
#undef NACRE_DECLARE_TECHNIQUE

const Catalogue<TechniqueDescription>& techniques() {
    static const Catalogue<TechniqueDescription> all = [] {
#define NACRE_DESCRIBE_TECHNIQUE(name) &name##_technique(),
        const TechniqueDescription* descriptions[] = {NACRE_TECHNIQUES(NACRE_DESCRIBE_TECHNIQUE)};
#undef NACRE_DESCRIBE_TECHNIQUE
        return Catalogue<TechniqueDescription>("technique", descriptions);
    }();
    return all;
}

std::string TechniqueChoice::option(std::string_view name) const {
    const auto found = std::find_if(options.rbegin(), options.rend(),
                                    [&](const auto& option) { return option.first == name; });
    return found == options.rend() ? "" : found->second;
}

std::vector<TechniqueChoice> variants_of(const TechniqueDescription& technique) {
    std::vector<TechniqueChoice> result;
    for (const std::string_view variant : split_words(technique.variants, "|")) {
        TechniqueChoice& choice = result.emplace_back(std::string(technique.name));
        for (const std::string_view setting : split_words(variant)) {
            const std::size_t equals = setting.find('=');
            choice.options.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
        }
    }
    if (result.empty()) result.push_back({std::string(technique.name)});
    return result;
}

TechniqueChoice checked(const TechniqueChoice& choice) {
    const TechniqueDescription& technique = techniques().find(choice.technique);
    Settings settings;
    for (const auto& [name, value] : choice.options) settings.push_back({name, value});
    const ParameterValues values(technique.name, technique.parameters, settings);
    TechniqueChoice result{std::string(technique.name)};
    for (const auto& [name, value] : choice.options) {
        const int i = find_parameters(technique.name, technique.parameters, name).front();
        const Parameter& p = technique.parameters[std::size_t(i)];
        result.options.emplace_back(
            p.name, p.kind == ParameterKind::choice ? std::string(values.word(p.name)) : value);
    }
    return result;
}

TechniquePtr prepare(const Scene& scene, const RenderPlan& plan, const Work& work) {
    const TechniqueDescription* technique = nullptr;
    for (const ShapeTechnique& s : plan.shapes) {
        if (!s.technique) continue;
        if (!technique) technique = s.technique;
        if (technique == s.technique || (technique->below && s.technique->below) ||
            (technique->realtime && s.technique->realtime))
            continue;
        const bool first = !technique->below && !technique->realtime;
        throw InputError(fmt::format(
            "{}'{}' {} the whole scene: give all translucent shapes this method, or none", s.place,
            first ? technique->name : s.technique->name,
            (first ? technique : s.technique)->simulates ? "simulates" : "renders"));
    }
    if (!technique && plan.is_simulation()) technique = &simulation_technique();
    if (technique) return technique->prepare({scene, plan.shapes, plan.seed}, work);
    return std::make_unique<IntegratorTechnique>(
        scene, plan.integrator,
        [type = plan.integrator](const Scene& s, const Work& w) {
            return make_integrator(s, type, w);
        },
        work);
}

RenderResult render(const Scene& scene, const RenderPlan& plan, const FrameSettings& frame,
                    const RenderOptions& options) {
    return prepare_and_render(
        [&](const Work& work) {
            return [&frame, technique = std::shared_ptr<Technique>(prepare(scene, plan, work))](
                       const RenderOptions& rest) { return technique->render(frame, rest); };
        },
        frame, options);
}

}  // namespace nacre
