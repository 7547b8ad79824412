#include "nacre/scene/materials/index.h"

#include <sstream>

namespace nacre {
namespace {

const SceneValue* find_value(const SceneNode& node, std::string_view name) {
    const auto at = std::find_if(node.values.begin(), node.values.end(),
                                 [&](const SceneValue& v) { return v.name == name; });
    return at == node.values.end() ? nullptr : &*at;
}

/// The numbers after the first word of a formula; throws unless there are between least and most.
std::vector<float> coefficients(std::istringstream& words, std::size_t least, std::size_t most,
                                std::string_view usage) {
    std::vector<float> values;
    float value;
    while (words >> value) values.push_back(value);
    if (!words.eof() || values.size() < least || values.size() > most)
        throw InputError(fmt::format("a dispersion formula is written '{}'", usage));
    return values;
}

DielectricIndex index_of_text(const std::string& text) {
    std::istringstream words(text);
    std::string kind;
    words >> kind;
    if (kind == "cauchy") {
        const auto k = coefficients(words, 2, 3, "cauchy a b [c]");
        return DielectricIndex::cauchy(k[0], k[1], k.size() > 2 ? k[2] : 0.f);
    }
    if (kind == "sellmeier") {
        const auto k = coefficients(words, 6, 6, "sellmeier b1 b2 b3 c1 c2 c3");
        return DielectricIndex::sellmeier({k[0], k[1], k[2]}, {k[3], k[4], k[5]});
    }
    if (kind == "dispersive") {
        std::string name;
        std::getline(words >> std::ws, name);
        return dispersive_dielectric(name);
    }
    return DielectricIndex(dielectric_index(text));
}

}  // namespace

DielectricIndex get_index(const SceneNode& node, std::string_view name,
                          std::string_view otherwise) {
    if (!node.has(name)) return DielectricIndex(dielectric_index(otherwise));
    const SceneValue* value = find_value(node, name);
    try {
        if (value && std::holds_alternative<std::string>(value->value))
            return index_of_text(node.get_string(name));
        if (value && std::holds_alternative<ColorValue>(value->value)) {
            const ColorValue& color = *node.get_color(name);
            if (color.kind == ColorValue::Kind::tabulated)
                return DielectricIndex::tabulated(color.nm, color.values);
            if (color.kind == ColorValue::Kind::constant) return DielectricIndex(color.value);
            throw InputError("an index of refraction is a number, a name or a tabulated spectrum");
        }
        return DielectricIndex(static_cast<float>(node.get_float(name)));
    } catch (const InputError& error) {
        // What already says where it stands comes from the node itself.
        const std::string what = error.what();
        if (!value || what.starts_with(value->location.str())) throw;
        node.fail_at(name, fmt::format("'{}' of {}: {}", name, node.describe(), what));
    }
}

RelativeIndex::RelativeIndex(const SceneNode& node, std::string_view inside,
                             std::string_view outside)
    : inside_(get_index(node, "int_ior", inside)),
      outside_(get_index(node, "ext_ior", outside)),
      nominal_(inside_.at(sodium_d) / outside_.at(sodium_d)),
      dispersive_(inside_.is_dispersive() || outside_.is_dispersive()) {}

float get_relative_index(const SceneNode& node, std::string_view inside) {
    const RelativeIndex index(node, inside);
    if (index.is_dispersive())
        node.fail(
            fmt::format("{} takes one index of refraction for all wavelengths; only smooth "
                        "dielectrics disperse light",
                        node.describe()));
    return index.nominal();
}

}  // namespace nacre
