#include "nacre/catalogue/describe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace nacre {

std::string wrapped(std::string lead, std::string_view text) {
    constexpr std::size_t width = 100;
    const std::string indent(lead.size(), ' ');
    std::string result, line = std::move(lead);
    bool fresh = true;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!fresh && line.size() + 1 + word.size() > width) {
            result += line + "\n";
            line = indent;
            fresh = true;
        }
        line += fmt::format("{}{}", fresh ? "" : " ", word);
        fresh = false;
    }
    return result + line + "\n";
}

std::string_view kind_name(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::spectrum:
            return "spectrum";
        case ParameterKind::scalar:
            return "number";
        case ParameterKind::choice:
            return "choice";
        case ParameterKind::integer:
            return "whole number";
        case ParameterKind::wavelength:
            return "wavelength";
    }
    return "";
}

std::string parameter_text(const Parameter& p) {
    std::string facts(kind_name(p.kind));
    if (p.kind != ParameterKind::choice) facts += fmt::format(", {}", range_text(p));
    if (!p.unit.empty()) facts += fmt::format(" {}", p.unit);
    facts += fmt::format(", default {}", default_text(p));
    // A long name has a line of its own, lest its meaning stand out of the column.
    const bool is_long = p.name.size() > 12;
    std::string text = is_long ? fmt::format("      {}\n", p.name) : "";
    text += wrapped(fmt::format("      {:<12} ", is_long ? "" : p.name), p.meaning);
    text += fmt::format("      {:<12} ({})\n", "", facts);
    for (const Choice& c : p.choices)
        text += wrapped(
            fmt::format("      {:<12}   {:<14} ", "", c.name),
            fmt::format("{}{}", c.meaning,
                        c.aliases.empty() ? std::string()
                                          : fmt::format(" (also {})", fmt::join(c.aliases, ", "))));
    if (!p.aliases.empty())
        text += fmt::format("      {:<12} also {}\n", "", fmt::join(p.aliases, ", "));
    return text;
}

nlohmann::ordered_json heading_json(const Heading& h) {
    return {{"name", h.name},
            {"kind", h.kind},
            {"title", h.title},
            {"authors", h.authors},
            {"year", h.year ? nlohmann::ordered_json(h.year) : nlohmann::ordered_json()},
            {"paper", h.paper},
            {"parameters", parameters_json(h.parameters)}};
}

nlohmann::ordered_json parameters_json(std::span<const Parameter> all) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
    for (const Parameter& p : all) {
        nlohmann::ordered_json j{
            {"name", p.name}, {"meaning", p.meaning}, {"kind", kind_name(p.kind)}};
        if (!p.unit.empty()) j["unit"] = p.unit;
        if (p.kind == ParameterKind::choice) {
            for (const Choice& c : p.choices)
                j["choices"].push_back({{"name", c.name}, {"meaning", c.meaning}});
            j["default"] = default_text(p);
        } else {
            // JSON has no infinity.
            const auto end = [](double x) {
                return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json();
            };
            j["low"] = end(p.low);
            j["low_allowed"] = !p.above_low;
            j["high"] = end(p.high);
            if (p.below_high) j["high_allowed"] = false;
            j["default"] = p.otherwise;
        }
        j["aliases"] = p.aliases;
        parameters.push_back(std::move(j));
    }
    return parameters;
}

}  // namespace nacre
