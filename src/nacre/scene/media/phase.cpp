// Phase functions of scene files.
#include "nacre/optics/phase.h"

#include "nacre/scene/build.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

/// Mitsuba's default asymmetry of `hg`; nacre's other one-parameter lobes share it.
constexpr double default_g = 0.8;

/// A parameter within the open interval (-1, 1).
float get_asymmetry(const SceneNode& node, std::string_view name) {
    const double g = node.get_float(name, default_g);
    if (!(g > -1.0 && g < 1.0))
        node.fail_at(name, fmt::format("'{}' must lie between -1 and 1, exclusive, but has the "
                                       "value {}",
                                       name, g));
    return static_cast<float>(g);
}

PhaseFunction make_schlick(const SceneNode& node) {
    if (!node.has("k")) return PhaseFunction::schlick(schlick_k(get_asymmetry(node, "g")));
    if (node.has("g")) node.fail_at("g", "give either 'k' or 'g', not both");
    return PhaseFunction::schlick(get_asymmetry(node, "k"));
}

PhaseFunction make_two_term(const SceneNode& node) {
    return PhaseFunction::two_term_hg(
        static_cast<float>(node.get_float_in("weight", 0.5, 0.0, 1.0)), get_asymmetry(node, "g1"),
        get_asymmetry(node, "g2"));
}

using Factory = PhaseFunction (*)(const SceneNode&);
constexpr std::pair<std::string_view, Factory> factories[] = {
    {"isotropic", [](const SceneNode&) { return PhaseFunction::isotropic(); }},
    {"rayleigh", [](const SceneNode&) { return PhaseFunction::rayleigh(); }},
    {"hg",
     [](const SceneNode& n) { return PhaseFunction::henyey_greenstein(get_asymmetry(n, "g")); }},
    {"mie_hazy", [](const SceneNode&) { return PhaseFunction::mie_hazy(); }},
    {"mie_murky", [](const SceneNode&) { return PhaseFunction::mie_murky(); }},
    {"mie_murky_33", [](const SceneNode&) { return PhaseFunction::mie_murky_33(); }},
    {"schlick", make_schlick},
    {"cornette_shanks",
     [](const SceneNode& n) { return PhaseFunction::cornette_shanks(get_asymmetry(n, "g")); }},
    {"two_term_hg", make_two_term},
};

}  // namespace

PhaseFunction make_phase(const SceneNode& node) {
    std::vector<std::string> known;
    for (const auto& [name, factory] : factories) {
        if (name == node.type) {
            const PhaseFunction phase = factory(node);
            node.check_all_used();
            return phase;
        }
        known.emplace_back(name);
    }
    node.fail(unknown_name("phase function", node.type, known));
}

}  // namespace nacre
