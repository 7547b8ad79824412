#include "nacre/scene/medium.h"

#include "nacre/scene/media/types.h"
#include "nacre/text/names.h"

namespace nacre {

MediumCoefficients Medium::coefficients(const Point3f& p, const Wavelengths& w) const {
    const Spectral t = (sigma_t_volume ? sigma_t_volume->eval(p, w) : sigma_t->eval(w)) * scale;
    const Spectral a = albedo_volume ? albedo_volume->eval(p, w) : albedo->eval(w);
    return {t * a, t};
}

Spectral Medium::majorant(const Wavelengths& w) const {
    return (sigma_t_volume ? Spectral(sigma_t_volume->max()) : sigma_t->eval(w)) * scale;
}

bool Medium::is_spectral() const {
    return (sigma_t && sigma_t->is_spectral()) || (albedo && albedo->is_spectral());
}

void set_heterogeneous_coefficients(const SceneNode& node, Medium& medium, BuildContext& context) {
    const auto set = [&](const char* name, ColorRole role, float otherwise, SpectrumPtr& uniform,
                         VolumePtr& volume) {
        uniform = get_uniform_coefficient(node, name, role, otherwise);
        if (!uniform) volume = make_volume(*node.child(name, "volume")->node, role, context);
    };
    set("sigma_t", ColorRole::unbounded, 1.f, medium.sigma_t, medium.sigma_t_volume);
    set("albedo", ColorRole::reflectance, 0.75f, medium.albedo, medium.albedo_volume);
}

namespace {

float get_scale(const SceneNode& node) {
    const double scale = node.get_float("scale", 1.0);
    if (!(scale >= 0.0) || !std::isfinite(scale))
        node.fail_at(
            "scale",
            fmt::format("'scale' must be finite and at least 0, but has the value {}", scale));
    return static_cast<float>(scale);
}

PhaseFunction get_phase(const SceneNode& node) {
    const auto phases = node.children_of("phase");
    if (phases.size() > 1)
        throw InputError(phases[1]->location.str() + ": a medium has only one phase function");
    return phases.empty() ? PhaseFunction::isotropic() : make_phase(*phases[0]->node);
}

using SetCoefficients = void (*)(const SceneNode&, Medium&, BuildContext&);
constexpr std::pair<std::string_view, SetCoefficients> types[] = {
    {"homogeneous", [](const SceneNode& node, Medium& medium,
                       BuildContext&) { set_homogeneous_coefficients(node, medium); }},
    {"heterogeneous", set_heterogeneous_coefficients},
    {"skin", [](const SceneNode& node, Medium& medium,
                BuildContext&) { set_skin_coefficients(node, medium); }},
};

MediumPtr build_medium(const SceneNode& node, SetCoefficients set, BuildContext& context) {
    auto medium = std::make_shared<Medium>();
    medium->id = node.id;
    // Files give coefficients per millimetre; rays count in scene units.
    medium->scale = get_scale(node) * static_cast<float>(context.mm_per_unit);
    medium->phase = get_phase(node);
    set(node, *medium, context);
    // Choices of Mitsuba's integrators that change noise and time, never the picture: nacre's
    // decide for themselves.
    node.get_bool("has_spectral_extinction", true);
    node.get_bool("sample_emitters", true);
    node.check_all_used();
    return medium;
}

}  // namespace

MediumPtr make_medium(const SceneNode& node, BuildContext& context) {
    if (const auto built = context.media.find(&node); built != context.media.end())
        return built->second;
    std::vector<std::string> known;
    for (const auto& [name, set] : types) {
        if (name == node.type) return context.media[&node] = build_medium(node, set, context);
        known.emplace_back(name);
    }
    node.fail(unknown_name("medium type", node.type, known));
}

}  // namespace nacre
