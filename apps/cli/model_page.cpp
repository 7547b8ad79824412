#include "apps/cli/model_page.h"

#include "nacre/reflectance/registry.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t width = 100;

std::string behaviour_text(const Behaviour& b) {
    std::string text = fmt::format(
        "{}, {}", b.reciprocal ? "reciprocal" : "not reciprocal",
        b.energy == Energy::conserves ? "conserves energy" : "does not conserve energy");
    if (!b.energy_note.empty()) text += fmt::format(" ({})", b.energy_note);
    const std::string claim = claim_text(b);
    if (claim.empty()) return wrapped("      ", text);
    // What is long goes on a line of its own.
    if (claim.size() > width / 2)
        return wrapped("      ", claim + ":") + wrapped("          ", text);
    return wrapped(fmt::format("      {}: ", claim), text);
}

}  // namespace

std::string wrapped(std::string lead, std::string_view text) {
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

std::string indented(std::string_view lines) {
    std::string result = "      ";
    for (char c : lines) result += c == '\n' ? std::string("\n      ") : std::string(1, c);
    return result + "\n";
}

std::string parameter_text(const Parameter& p) {
    std::string facts = fmt::format("{}, {}", kind_name(p.kind),
                                    p.kind == ParameterKind::choice ? "" : range_text(p));
    if (p.kind == ParameterKind::choice) facts = kind_name(p.kind);
    if (!p.unit.empty()) facts += fmt::format(" {}", p.unit);
    facts += fmt::format(", default {}", default_text(p));
    std::string text = wrapped(fmt::format("      {:<12} ", p.name), p.meaning);
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

std::string default_text(const Parameter& p) {
    return p.kind == ParameterKind::choice ? std::string(p.choices[std::size_t(p.otherwise)].name)
                                           : fmt::format("{}", p.otherwise);
}

std::string model_page(const ModelDescription& m) {
    std::string page = fmt::format("{}: {}\n\n", m.name, m.title);
    page += wrapped("  by         ", fmt::format("{}, {}", m.authors, m.year));
    page += wrapped("  paper      ", m.paper);
    if (!m.equations.empty()) page += wrapped("  equations  ", m.equations);
    page += fmt::format("\n  formula (BRDF, sr^-1)\n{}", indented(m.formula));
    page +=
        fmt::format("\n  parameters (<bsdf type=\"{}\">, nacre eval {} --set)\n", m.name, m.name);
    for (const Parameter& p : m.parameters) page += parameter_text(p);
    for (const SumBound& b : m.bounds)
        page += fmt::format("      {} must not exceed 1\n", fmt::join(b.parameters, " + "));
    page += "\n  behaviour\n";
    for (const Behaviour& b : m.behaviours) page += behaviour_text(b);
    page += wrapped("      ", m.isotropy);
    page += "\n" + wrapped("  sampling   ", m.sampling);
    if (!m.albedo.empty()) page += wrapped("  albedo     ", m.albedo);
    if (!m.errata.empty()) page += "\n  errata of the literature\n";
    for (std::string_view e : m.errata) page += wrapped("    - ", e);
    page += "\n  references\n";
    for (std::string_view r : m.references) page += wrapped("    - ", r);
    return page;
}

ordered_json parameters_json(std::span<const Parameter> all) {
    ordered_json parameters = ordered_json::array();
    for (const Parameter& p : all) {
        ordered_json j{{"name", p.name}, {"meaning", p.meaning}, {"kind", kind_name(p.kind)}};
        if (!p.unit.empty()) j["unit"] = p.unit;
        if (p.kind == ParameterKind::choice) {
            for (const Choice& c : p.choices)
                j["choices"].push_back({{"name", c.name}, {"meaning", c.meaning}});
            j["default"] = default_text(p);
        } else {
            j["low"] = p.low;
            j["low_allowed"] = !p.above_low;
            j["high"] = p.high == infinite ? ordered_json() : ordered_json(p.high);
            j["default"] = p.otherwise;
        }
        j["aliases"] = p.aliases;
        parameters.push_back(std::move(j));
    }
    return parameters;
}

ordered_json model_json(const ModelDescription& m) {
    ordered_json behaviours = ordered_json::array();
    for (const Behaviour& b : m.behaviours)
        behaviours.push_back({{"options", b.options},
                              {"condition", condition_text(b)},
                              {"reciprocal", b.reciprocal},
                              {"conserves_energy", b.energy == Energy::conserves},
                              {"note", b.energy_note}});
    return {{"name", m.name},
            {"kind", "bsdf"},
            {"title", m.title},
            {"authors", m.authors},
            {"year", m.year},
            {"paper", m.paper},
            {"equations", m.equations},
            {"formula", m.formula},
            {"parameters", parameters_json(m.parameters)},
            {"behaviours", std::move(behaviours)},
            {"isotropy", m.isotropy},
            {"sampling", m.sampling},
            {"albedo", m.albedo},
            {"errata", m.errata},
            {"references", m.references}};
}

}  // namespace nacre::cli
