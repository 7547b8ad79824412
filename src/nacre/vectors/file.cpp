#include "nacre/vectors/file.h"

namespace nacre {

Settings settings_of(const nlohmann::json& parameters) {
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

GroupModel model_of_group(std::string_view name) {
    for (const ModelDescription* m : models())
        for (const ReferenceGroup& g : groups_of(m->name))
            if (g.name == name) return {&find_evaluator(m->name), &g};
    return {};
}

AnyModel model_of_vector(const GroupModel& who, const nlohmann::json& parameters) {
    Settings settings = parse_settings(who.group->settings);
    const auto meant = [&](const std::string& name) {
        const ModelDescription& model = who.evaluator->description();
        return find_parameters(model.name, model.parameters, name);
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

Vec3d direction_of(const nlohmann::json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

double answer(const GroupModel& who, const AnyModel& model, const Vec3d& wi, const Vec3d& wo) {
    return who.group->pdf ? model.pdf(wo, wi) : model.eval(wi, wo);
}

double relative_deviation(double value, double expected) {
    if (value == expected) return 0.;
    return expected == 0. ? std::abs(value) * 1e12
                          : std::abs(value - expected) / std::abs(expected);
}

}  // namespace nacre
