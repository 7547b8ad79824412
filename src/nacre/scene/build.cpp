#include "nacre/scene/build.h"

#include <fmt/format.h>

#include "nacre/scene/xml/find_file.h"

namespace nacre {
namespace {

SpectrumRole spectrum_role(ColorRole role) {
    switch (role) {
        case ColorRole::reflectance:
            return SpectrumRole::reflectance;
        case ColorRole::unbounded:
            return SpectrumRole::unbounded;
        case ColorRole::illuminant:
            break;
    }
    return SpectrumRole::illuminant;
}

[[noreturn]] void fail(const ColorValue& color, const std::string& message) {
    throw InputError(color.location.file ? fmt::format("{}: {}", color.location.str(), message)
                                         : message);
}

SpectrumPtr from_rgb(const Vec3f& rgb, ColorRole role) {
    switch (role) {
        case ColorRole::reflectance:
            return make_rgb_reflectance(rgb);
        case ColorRole::unbounded:
            return make_rgb_unbounded(rgb);
        case ColorRole::illuminant:
            break;
    }
    return make_rgb_illuminant(rgb);
}

std::filesystem::path find_named(const BuildContext& context, const SceneNode& node,
                                 std::string_view name, FindWhat what) {
    const std::string wanted = node.get_string(name);
    std::string where = node.location.str();
    for (const SceneValue& v : node.values)
        if (v.name == name) where = v.location.str();
    return find_file(wanted, context.search_path, where, what);
}

}  // namespace

std::filesystem::path BuildContext::file(const SceneNode& node, std::string_view name) const {
    const std::filesystem::path found = find_named(*this, node, name, FindWhat::file);
    if (files) files->push_back(found);
    return found;
}

std::filesystem::path BuildContext::file_or_folder(const SceneNode& node,
                                                   std::string_view name) const {
    const std::filesystem::path found = find_named(*this, node, name, FindWhat::file_or_folder);
    if (files) std::ranges::copy(files_in(found), std::back_inserter(*files));
    return found;
}

SpectrumPtr make_spectrum(const ColorValue& color, ColorRole role) {
    switch (color.kind) {
        case ColorValue::Kind::rgb:
            for (int i = 0; i < 3; ++i)
                if (color.rgb[i] < 0.f)
                    fail(color, fmt::format("a colour cannot be negative; got {}", color.rgb[i]));
            return from_rgb(color.rgb, role);
        case ColorValue::Kind::constant:
            if (color.value < 0.f)
                fail(color, fmt::format("a spectrum cannot be negative; got {}", color.value));
            if (role == ColorRole::illuminant)
                return make_rgb_illuminant({color.value, color.value, color.value});
            return make_constant(color.value);
        case ColorValue::Kind::tabulated:
            return make_tabulated(color.nm, color.values, spectrum_role(role));
        case ColorValue::Kind::blackbody:
            if (role != ColorRole::illuminant)
                fail(color, "a black body is a light, not a reflectance or a coefficient");
            break;
    }
    return make_blackbody(color.kelvin, color.value);
}

SpectrumPtr get_spectrum(const SceneNode& node, std::string_view name, ColorRole role,
                         SpectrumPtr otherwise) {
    const ColorValue* color = node.get_color(name);
    return color ? make_spectrum(*color, role) : std::move(otherwise);
}

}  // namespace nacre
