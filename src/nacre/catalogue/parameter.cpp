#include "nacre/catalogue/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

template <class Named>
std::vector<std::string_view> names_of(const Named& all) {
    std::vector<std::string_view> names;
    for (const auto& one : all) names.push_back(one.name);
    return names;
}

bool same(std::string_view a, std::string_view b, bool exactly) {
    return exactly ? a == b : plain_name(a) == plain_name(b);
}

template <class Named>
bool has_alias(const Named& one, std::string_view name, bool exactly) {
    return std::any_of(one.aliases.begin(), one.aliases.end(),
                       [&](std::string_view alias) { return same(alias, name, exactly); });
}

}  // namespace

std::string range_text(const Parameter& p) {
    return fmt::format("{}{}, {}{}", p.above_low || p.low == -infinite ? '(' : '[', p.low, p.high,
                       p.below_high || p.high == infinite ? ')' : ']');
}

std::string default_text(const Parameter& p) {
    return p.kind == ParameterKind::choice ? std::string(p.choices[std::size_t(p.otherwise)].name)
                                           : fmt::format("{}", p.otherwise);
}

void check_range(std::string_view owner, const Parameter& p, double value) {
    const bool inside = std::isfinite(value) && (p.above_low ? value > p.low : value >= p.low) &&
                        (p.below_high ? value < p.high : value <= p.high);
    if (!inside)
        throw InputError(fmt::format("{}: {} = {} is out of range: must lie within {}", owner,
                                     p.name, value, range_text(p)));
    if (p.kind == ParameterKind::integer && value != std::floor(value))
        throw InputError(fmt::format("{}: {} = {} must be a whole number", owner, p.name, value));
}

int find_choice(std::string_view owner, const Parameter& p, std::string_view word) {
    for (const bool exactly : {true, false})
        for (std::size_t i = 0; i < p.choices.size(); ++i)
            if (same(p.choices[i].name, word, exactly) || has_alias(p.choices[i], word, exactly))
                return int(i);
    throw InputError(fmt::format("{}: {}", owner, unknown_name(p.name, word, names_of(p.choices))));
}

std::vector<int> find_parameters(std::string_view owner, std::span<const Parameter> parameters,
                                 std::string_view name) {
    if (parameters.empty())
        throw InputError(fmt::format("{}: it has no parameter '{}', nor any other", owner, name));
    for (const bool exactly : {true, false}) {
        std::vector<int> found;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (same(parameters[i].name, name, exactly)) return {int(i)};
            if (has_alias(parameters[i], name, exactly)) found.push_back(int(i));
        }
        if (!found.empty()) return found;
    }
    throw InputError(
        fmt::format("{}: {}", owner, unknown_name("parameter", name, names_of(parameters))));
}

}  // namespace nacre
