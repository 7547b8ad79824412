// From what a scene and a choice say to a technique with checked options for each shape.
#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/scene/subsurface.h"
#include "nacre/techniques/techniques.h"

namespace nacre {
namespace {

using Option = SubsurfaceSettings::Option;

std::string place_of(const std::string& where) { return where.empty() ? "" : where + ": "; }

/// Calls `f` so that what it refuses names the place in the scene file.
template <class F>
auto at_place(const std::string& where, F&& f) {
    try {
        return f();
    } catch (const InputError& error) {
        throw InputError(place_of(where) + error.what());
    }
}

bool knows(const TechniqueDescription& technique, const std::string& name) {
    return std::ranges::any_of(technique.parameters, [&](const Parameter& p) {
        return p.name == name || std::ranges::find(p.aliases, name) != p.aliases.end();
    });
}

/// Everything that a <subsurface> may hold.
std::vector<std::string_view> known_names() {
    std::vector<std::string_view> names(subsurface_parameters().begin(),
                                        subsurface_parameters().end());
    for (const TechniqueDescription* t : techniques())
        for (const Parameter& p : t->parameters)
            if (std::ranges::find(names, p.name) == names.end()) names.push_back(p.name);
    return names;
}

/// Throws unless the technique, or else any other, would take the option.
void check(const TechniqueDescription& technique, const Option& option,
           const std::string& profile) {
    std::vector<const TechniqueDescription*> asked{&technique};
    asked.insert(asked.end(), techniques().begin(), techniques().end());
    for (const TechniqueDescription* t : asked) {
        if (!knows(*t, option.name)) continue;
        at_place(option.where, [&] {
            return ParameterValues(t->name, t->parameters, {{option.name, option.value}});
        });
        return;
    }
    throw InputError(fmt::format("{}<subsurface type=\"{}\"> has no parameter '{}'{}",
                                 place_of(option.where), profile, option.name,
                                 suggestion(option.name, known_names())));
}

ShapeTechnique shape_technique(const TechniqueDescription& technique,
                               const SubsurfaceSettings& scene, const TechniqueChoice& choice) {
    ShapeTechnique shape{.technique = &technique, .options = {}, .place = place_of(scene.where)};
    Settings settings;
    for (const auto& [name, value] : choice.options) settings.push_back({name, value});
    for (const Option& option : scene.options) {
        check(technique, option, scene.profile);
        if (!knows(technique, option.name)) continue;
        const int i = find_parameters(technique.name, technique.parameters, option.name).front();
        if (choice.option(technique.parameters[std::size_t(i)].name).empty())
            settings.push_back({option.name, option.value});
    }
    const bool has_profile = knows(technique, "profile");
    if (has_profile && choice.option("profile").empty())
        settings.push_back({"profile", scene.profile});
    shape.options = at_place(scene.where, [&] {
        return ParameterValues(technique.name, technique.parameters, settings);
    });
    shape.profile = scene.profile;
    if (has_profile) shape.profile = std::string(shape.options.word("profile"));
    return shape;
}

}  // namespace

RenderPlan plan_of(const Scene& scene) {
    RenderPlan plan{scene.integrator.type, {}, scene.sampler.seed};
    std::size_t translucent = 0, simulated = 0;
    for (const ShapeBinding& shape : scene.shapes) {
        ShapeTechnique& s = plan.shapes.emplace_back();
        if (!shape.subsurface) continue;
        const SubsurfaceSettings& settings = *shape.subsurface;
        const TechniqueDescription& technique =
            *at_place(settings.where, [&] { return &techniques().find(settings.technique); });
        s = shape_technique(technique, settings, {});
        ++translucent;
        simulated += technique.simulates;
    }
    if (scene.integrator.type != "path" || translucent == simulated) {
        if (scene.integrator.type == "path" && translucent > 0) plan.integrator = "volpath";
        plan.shapes.assign(scene.shapes.size(), {});
    }
    return plan;
}

RenderPlan plan_of(const Scene& scene, const TechniqueChoice& wanted) {
    const TechniqueChoice choice = checked(wanted);
    const TechniqueDescription& technique = techniques().find(choice.technique);
    RenderPlan plan{technique.below ? "path" : choice.technique, {}, scene.sampler.seed};
    bool any = false;
    for (const ShapeBinding& shape : scene.shapes) {
        ShapeTechnique& s = plan.shapes.emplace_back();
        const bool takes =
            technique.takes_volumes ? holds_translucent_medium(shape) : is_translucent(shape);
        if (technique.simulates || !takes) continue;
        any = true;
        s = shape_technique(technique, shape.subsurface ? *shape.subsurface : SubsurfaceSettings{},
                            choice);
    }
    if (!any && !technique.simulates)
        throw InputError(fmt::format(
            "technique '{}' has nothing to do: no shape has a {}medium inside behind a "
            "dielectric boundary, smooth or equally rough everywhere, without dispersion or tint",
            technique.name, technique.takes_volumes ? "" : "homogeneous "));
    return plan;
}

}  // namespace nacre
