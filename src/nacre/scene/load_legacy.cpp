// <integrator type="legacy">: the illumination models by number or name, with their parameters.
#include <fmt/format.h>

#include "nacre/scene/build.h"
#include "nacre/scene/legacy_settings.h"

namespace nacre {

namespace {

using illumination::Description;

/// Runs `action`; its InputError is reported at the place of the parameter.
template <class F>
decltype(auto) at_parameter(const SceneNode& node, std::string_view name, F&& action) {
    try {
        return action();
    } catch (const InputError& e) {
        node.fail_at(name, e.what());
    }
}

/// Every number that a colour is made of must lie in the parameter's range.
void check_color(const Description& model, const Parameter& p, const ColorValue& color) {
    const auto check = [&](double value) { check_range(model.name, p, value); };
    switch (color.kind) {
        case ColorValue::Kind::rgb:
            for (int i = 0; i < 3; ++i) check(color.rgb[i]);
            break;
        case ColorValue::Kind::tabulated:
            for (float value : color.values) check(value);
            break;
        default:
            check(color.value);
    }
}

LegacyModel read_model(const SceneNode& node, const Description& model) {
    LegacyModel result{.model = &model};
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
        const Parameter& p = model.parameters[i];
        if (p.kind == ParameterKind::choice) {
            const std::string word = node.get_string(p.name, default_text(p));
            result.numbers[i] = static_cast<float>(
                at_parameter(node, p.name, [&] { return find_choice(model.name, p, word); }));
        } else if (p.kind == ParameterKind::scalar) {
            const double value = node.get_float(p.name, p.otherwise);
            at_parameter(node, p.name, [&] { check_range(model.name, p, value); });
            result.numbers[i] = static_cast<float>(value);
        } else if (const ColorValue* color = node.get_color(p.name)) {
            at_parameter(node, p.name, [&] { check_color(model, p, *color); });
            result.spectra[i] =
                make_spectrum(*color, p.high == 1. ? ColorRole::reflectance : ColorRole::unbounded);
        } else {
            result.spectra[i] = make_constant(static_cast<float>(p.otherwise));
        }
    }
    return result;
}

void read_models(const SceneNode& node, LegacySettings& settings) {
    const std::string text = node.get_string("model");
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = rest.find('+');
        std::string_view name = rest.substr(0, end);
        rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
        while (name.starts_with(' ')) name.remove_prefix(1);
        while (name.ends_with(' ')) name.remove_suffix(1);
        const Description& model = at_parameter(node, "model", [&]() -> const Description& {
            return illumination::models().find(name);
        });
        LegacyModel& place = settings.models[static_cast<std::size_t>(model.part)];
        if (place.model)
            node.fail_at("model",
                         fmt::format("models {} and {} are of the same kind; name one of them",
                                     place.model->number, model.number));
        place = read_model(node, model);
        if (model.number == 2) settings.estimate_unblocked = !node.has("f");
    }
    if (text.empty()) node.fail_at("model", "'model' is empty; name one, such as '3+13'");
}

}  // namespace

LegacyModel::Values LegacyModel::values(const Wavelengths& w) const {
    Values v;
    v.numbers = numbers;
    for (std::size_t i = 0; i < spectra.size(); ++i)
        if (spectra[i]) v.spectra[i] = spectra[i]->eval(w);
    return v;
}

bool LegacySettings::is_spectral() const {
    const auto spectral = [](const SpectrumPtr& s) { return s && s->is_spectral(); };
    for (const LegacyModel& m : models)
        if (std::ranges::any_of(m.spectra, spectral)) return true;
    return spectral(ambient) || spectral(absorption);
}

std::shared_ptr<const LegacySettings> read_legacy(const SceneNode& node) {
    auto settings = std::make_shared<LegacySettings>();
    read_models(node, *settings);
    settings->convention = node.get_choice("light_convention", {"physical", "pi"}) == "pi"
                               ? illumination::LightConvention::pi
                               : illumination::LightConvention::physical;
    settings->inverse_square =
        node.get_choice("light_falloff", {"model", "inverse_square"}) == "inverse_square";
    settings->ambient =
        get_spectrum(node, "ambient", ColorRole::illuminant, make_rgb_illuminant({1.f, 1.f, 1.f}));
    settings->surface_color = node.get_bool("surface_color", true);
    settings->shadows = node.get_bool("shadows", false);
    settings->refraction = node.get_bool("refraction", false);
    const LegacyModel* transparency = settings->find(illumination::Part::transparency);
    if (settings->refraction && !(transparency && transparency->model->number == 23))
        node.fail_at("refraction",
                     "'refraction' needs model 23 (hall_transparency), which has an index");
    settings->absorption =
        get_spectrum(node, "absorption", ColorRole::unbounded, make_constant(0.f));
    if (node.has("absorption") && !settings->refraction)
        node.fail_at("absorption", "'absorption' needs 'refraction', which knows what is inside");
    settings->length_unit = static_cast<float>(node.get_float("length_unit", 1.));
    if (!(settings->length_unit > 0.f))
        node.fail_at("length_unit", fmt::format("'length_unit' of {} must be positive; got {}",
                                                node.describe(), settings->length_unit));
    return settings;
}

}  // namespace nacre
