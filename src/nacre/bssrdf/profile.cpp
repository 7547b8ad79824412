#include "nacre/bssrdf/profile.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "nacre/bssrdf/profile_models.h"
#include "nacre/math/error.h"
#include "nacre/optics/names.h"

namespace nacre {

namespace {

constexpr std::array<const ProfileDescription& (*)(), 7> listed{
    dipole_profile,      better_dipole_profile, quantised_diffusion_profile,
    photon_beam_profile, normalised_profile,    gaussian_sum_profile,
    multipole_profile};

std::vector<std::string_view> names_of(const auto& items) {
    std::vector<std::string_view> names;
    for (const auto& i : items) names.push_back(i.name);
    return names;
}

double number_of(const ProfileDescription& profile, const Parameter& option,
                 const SettingValue& value) {
    const auto* number = std::get_if<double>(&value);
    const auto* word = std::get_if<std::string>(&value);
    if (option.kind == ParameterKind::choice) {
        const std::string text = word     ? *word
                                 : number ? fmt::format("{}", *number)
                                          : std::string("a colour");
        const std::vector<std::string_view> words = names_of(option.choices);
        const int i = find_name(text, words);
        if (i < 0)
            throw InputError(
                fmt::format("{}: {}", profile.name, unknown_name(option.name, text, words)));
        return i;
    }
    const double v = number ? *number : NAN;
    const bool inside = std::isfinite(v) && v <= option.high &&
                        (option.above_low ? v > option.low : v >= option.low);
    const bool whole = option.kind != ParameterKind::integer || v == std::floor(v);
    if (!inside || !whole)
        throw InputError(
            fmt::format("{}: {} must be a {}number within {}", profile.name, option.name,
                        option.kind == ParameterKind::integer ? "whole " : "", range_text(option)));
    return v;
}

}  // namespace

std::span<const ProfileDescription* const> profiles() {
    static const std::vector<const ProfileDescription*> all = [] {
        std::vector<const ProfileDescription*> r;
        for (const auto& describe : listed) r.push_back(&describe());
        return r;
    }();
    return all;
}

const ProfileDescription& find_profile(std::string_view name) {
    std::vector<std::string_view> names;
    for (const ProfileDescription* p : profiles()) names.push_back(p->name);
    const int i = find_name(name, names);
    if (i < 0) throw InputError(unknown_name("diffusion profile", name, names));
    return *profiles()[std::size_t(i)];
}

std::unique_ptr<RadialProfile> make_profile(std::string_view name, const ProfileMedium& medium,
                                            const Settings& settings) {
    const ProfileDescription& profile = find_profile(name);
    check(medium);
    const std::vector<std::string_view> names = names_of(profile.options);
    std::vector<double> values;
    for (const Parameter& p : profile.options) values.push_back(p.otherwise);
    std::vector<bool> given(values.size());
    for (const Setting& s : settings) {
        if (names.empty())
            throw InputError(
                fmt::format("{}: it has no option \"{}\", nor any other", profile.name, s.name));
        const int i = find_name(s.name, names);
        if (i < 0)
            throw InputError(
                fmt::format("{}: {}", profile.name, unknown_name("option", s.name, names)));
        const std::size_t at = std::size_t(i);
        if (given[at])
            throw InputError(fmt::format("{}: {} is given twice", profile.name, names[at]));
        given[at] = true;
        values[at] = number_of(profile, profile.options[at], s.value);
    }
    return profile.make(medium, values);
}

}  // namespace nacre
