#include "nacre/catalogue/settings.h"

#include <fmt/format.h>

#include <stdexcept>

#include "nacre/math/error.h"
#include "nacre/spectrum/spectrum.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

double number_in(std::string_view word, std::string_view whole) {
    if (const auto number = parse_number(word)) return *number;
    throw InputError(fmt::format("'{}' in '{}' is not a number", word, whole));
}

/// Whether a word is meant for a number: "1x" is a wrong one, "inverse" is none.
bool begins_a_number(std::string_view word) {
    const std::size_t at = word.find_first_not_of("+-.");
    return at <= 2 && word[at] >= '0' && word[at] <= '9';
}

std::string text_of(const SettingValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    if (const auto* rgb = std::get_if<Vec3f>(&value))
        return fmt::format("{},{},{}", rgb->x, rgb->y, rgb->z);
    return "(spectrum)";
}

}  // namespace

Setting parse_setting(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0 || equals + 1 == text.size())
        throw InputError(fmt::format(
            "'{}' does not set a parameter; write name=value, such as alpha=0.2", text));
    Setting setting{std::string(text.substr(0, equals)), 0.};
    const std::string_view value = text.substr(equals + 1);
    const std::size_t comma = value.find(',');
    if (comma != value.npos) {
        const std::size_t second = value.find(',', comma + 1);
        if (second == value.npos || value.find(',', second + 1) != value.npos)
            throw InputError(
                fmt::format("'{}' must have one number or three (red,green,blue)", text));
        setting.value = Vec3f{float(number_in(value.substr(0, comma), text)),
                              float(number_in(value.substr(comma + 1, second - comma - 1), text)),
                              float(number_in(value.substr(second + 1), text))};
    } else if (const auto number = parse_number(value)) {
        setting.value = *number;
    } else if (begins_a_number(value)) {
        setting.value = number_in(value, text);  // says what is wrong
    } else {
        setting.value = std::string(value);
    }
    return setting;
}

Settings parse_settings(std::string_view text) {
    Settings settings;
    for (const std::string_view word : split_words(text, " "))
        settings.push_back(parse_setting(word));
    return settings;
}

std::string settings_text(const Settings& settings) {
    std::string text;
    for (const Setting& s : settings)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", s.name, text_of(s.value));
    return text;
}

ParameterValues::ParameterValues(std::string_view owner, std::span<const Parameter> parameters,
                                 const Settings& settings)
    : owner_(owner), parameters_(parameters) {
    for (const Parameter& p : parameters) values_.push_back({p.otherwise, nullptr, {}});
    for (const Setting& s : settings)
        for (const int i : find_parameters(owner, parameters, s.name)) set(std::size_t(i), s);
}

void ParameterValues::set(std::size_t i, const Setting& setting) {
    const Parameter& p = parameters_[i];
    Value& value = values_[i];
    if (!value.given.empty())
        throw InputError(fmt::format("{}: {} is given twice, as '{}' and '{}'", owner_, p.name,
                                     value.given, setting.name));
    value.given = setting.name;
    const auto* rgb = std::get_if<Vec3f>(&setting.value);
    const auto* spectrum = std::get_if<SpectrumPtr>(&setting.value);
    if (p.kind == ParameterKind::choice || !(rgb || spectrum)) {
        value.number = number_of(p, setting.value);
        return;
    }
    if (p.kind != ParameterKind::spectrum)
        throw InputError(
            fmt::format("{}: {} is one number, not a colour or spectrum", owner_, p.name));
    if (rgb) {
        for (int c = 0; c < 3; ++c) check_range(owner_, p, (*rgb)[c]);
        value.spectrum = p.high <= 1. ? make_rgb_reflectance(*rgb) : make_rgb_unbounded(*rgb);
    } else {
        check_range(owner_, p, (*spectrum)->max());
        value.spectrum = *spectrum;
    }
}

double ParameterValues::number_of(const Parameter& p, const SettingValue& value) const {
    const auto* word = std::get_if<std::string>(&value);
    const auto* number = std::get_if<double>(&value);
    if (p.kind == ParameterKind::choice)
        return find_choice(owner_, p,
                           word     ? *word
                           : number ? fmt::format("{}", *number)
                                    : std::string("a colour"));
    const auto given = word ? parse_number(*word) : std::optional(*number);
    if (!given)
        throw InputError(fmt::format("{}: {} = '{}' must be a {}number within {}", owner_, p.name,
                                     *word, p.kind == ParameterKind::integer ? "whole " : "",
                                     range_text(p)));
    check_range(owner_, p, *given);
    return *given;
}

std::size_t ParameterValues::index(std::string_view name) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i)
        if (parameters_[i].name == name) return i;
    throw std::logic_error(fmt::format("{}: '{}' is none of its parameters", owner_, name));
}

int ParameterValues::position(std::string_view name) const {
    const std::size_t i = index(name);
    if (parameters_[i].kind != ParameterKind::choice)
        throw std::logic_error(fmt::format("{}: '{}' is not a choice", owner_, name));
    return int(values_[i].number);
}

double ParameterValues::number(std::string_view name) const {
    const std::size_t i = index(name);
    if (parameters_[i].kind == ParameterKind::choice || values_[i].spectrum)
        throw std::logic_error(fmt::format("{}: '{}' is not one number", owner_, name));
    return values_[i].number;
}

int ParameterValues::whole(std::string_view name) const {
    const std::size_t i = index(name);
    if (parameters_[i].kind != ParameterKind::integer)
        throw std::logic_error(fmt::format("{}: '{}' is not a whole number", owner_, name));
    return int(values_[i].number);
}

std::string_view ParameterValues::word(std::string_view name) const {
    const int at = position(name);
    return parameters_[index(name)].choices[std::size_t(at)].name;
}

bool ParameterValues::given(std::string_view name) const {
    return !values_[index(name)].given.empty();
}

}  // namespace nacre
