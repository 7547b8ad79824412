#pragma once
// Files of reference vectors, {"models": {group: {"vectors": [{"id", "params", "wi", "wo",
// "value"}]}}}, put before the models.
#include <nlohmann/json.hpp>

#include "nacre/reflectance/registry.h"

namespace nacre::cli {

/// Parameters of a vector as settings: numbers and words as they are, nested lists and objects with
/// the names and positions joined by underscores ("lobes_0_C_2").
inline Settings settings_of(const nlohmann::json& parameters) {
    Settings settings;
    const auto visit = [&](const auto& self, const std::string& name,
                           const nlohmann::json& v) -> void {
        if (v.is_string())
            settings.push_back({name, v.get<std::string>()});
        else if (v.is_number())
            settings.push_back({name, v.get<double>()});
        else if (v.is_boolean())
            settings.push_back({name, v.get<bool>() ? 1. : 0.});
        else
            for (const auto& [key, inner] : v.items())
                self(self, name.empty() ? key : name + "_" + key, inner);
    };
    visit(visit, "", parameters);
    return settings;
}

/// Who answers a group.
struct GroupModel {
    const Evaluator* evaluator = nullptr;
    const ReferenceGroup* group = nullptr;
};

/// The model that answers the group of that name; empty if none does.
inline GroupModel model_of_group(std::string_view name) {
    for (const ModelDescription* m : models())
        for (const ReferenceGroup& g : m->groups)
            if (g.name == name) return {&find_evaluator(m->name), &g};
    return {};
}

/// The model with the parameters of one vector, and those that the group adds.
inline AnyModel model_of_vector(const GroupModel& who, const nlohmann::json& parameters) {
    Settings settings = parse_settings(who.group->settings);
    const auto meant = [&](const std::string& name) {
        return find_parameters(who.evaluator->description(), name);
    };
    std::vector<int> fixed;
    for (const Setting& s : settings)
        for (int i : meant(s.name)) fixed.push_back(i);
    const auto& ignored = who.group->ignored;
    for (Setting& s : settings_of(parameters)) {
        if (std::find(ignored.begin(), ignored.end(), s.name) != ignored.end()) continue;
        if (std::find(fixed.begin(), fixed.end(), meant(s.name).front()) == fixed.end())
            settings.push_back(std::move(s));
    }
    if (who.group->adapt) who.group->adapt(settings);
    // A vector that does not name them means no diffuse part and the whole highlight.
    const auto& parameters_of_model = who.evaluator->description().parameters;
    for (std::size_t i = 0; i < parameters_of_model.size(); ++i) {
        const std::string name(parameters_of_model[i].name);
        const auto sets_it = [&](const Setting& s) {
            const std::vector<int> set = meant(s.name);
            return std::find(set.begin(), set.end(), int(i)) != set.end();
        };
        if ((name == "kd" || name == "ks") &&
            std::none_of(settings.begin(), settings.end(), sets_it))
            settings.push_back({name, name == "kd" ? 0. : 1.});
    }
    return AnyModel(*who.evaluator, settings, Bounds::ranges_only);
}

inline Vec3d direction_of(const nlohmann::json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

/// What a model says to a vector: its value, or the density of drawing wo for a given wi.
inline double answer(const GroupModel& who, const AnyModel& model, const Vec3d& wi,
                     const Vec3d& wo) {
    return who.group->pdf ? model.pdf(wo, wi) : model.eval(wi, wo);
}

/// |value - expected| over |expected|; values that must be zero have no tolerance.
inline double relative_deviation(double value, double expected) {
    if (value == expected) return 0.;
    return expected == 0. ? std::abs(value) * 1e12
                          : std::abs(value - expected) / std::abs(expected);
}

}  // namespace nacre::cli
