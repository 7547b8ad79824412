#include "apps/cli/model_page.h"

#include "nacre/catalogue/describe.h"
#include "nacre/reflectance/registry.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

std::string behaviour_text(const Behaviour& b) {
    std::string text = fmt::format(
        "{}, {}", b.reciprocal ? "reciprocal" : "not reciprocal",
        b.energy == Energy::conserves ? "conserves energy" : "does not conserve energy");
    if (!b.energy_note.empty()) text += fmt::format(" ({})", b.energy_note);
    const std::string claim = claim_text(b);
    if (claim.empty()) return wrapped("      ", text);
    // What is long goes on a line of its own.
    if (claim.size() > 50) return wrapped("      ", claim + ":") + wrapped("          ", text);
    return wrapped(fmt::format("      {}: ", claim), text);
}

}  // namespace

std::string indented(std::string_view lines) {
    std::string result = "      ";
    for (char c : lines) result += c == '\n' ? std::string("\n      ") : std::string(1, c);
    return result + "\n";
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
    page += "\n";
    page += wrapped("  sampling   ", m.sampling);
    if (!m.albedo.empty()) page += wrapped("  albedo     ", m.albedo);
    if (!m.errata.empty()) page += "\n  errata of the literature\n";
    for (std::string_view e : m.errata) page += wrapped("    - ", e);
    page += "\n  references\n";
    for (std::string_view r : m.references) page += wrapped("    - ", r);
    return page;
}

ordered_json model_json(const ModelDescription& m) {
    ordered_json behaviours = ordered_json::array();
    for (const Behaviour& b : m.behaviours)
        behaviours.push_back({{"options", b.options},
                              {"condition", condition_text(b)},
                              {"reciprocal", b.reciprocal},
                              {"conserves_energy", b.energy == Energy::conserves},
                              {"note", b.energy_note}});
    ordered_json r =
        heading_json({m.name, "bsdf", m.title, m.authors, m.year, m.paper, m.parameters});
    r["equations"] = m.equations;
    r["formula"] = m.formula;
    r["behaviours"] = std::move(behaviours);
    r["isotropy"] = m.isotropy;
    r["sampling"] = m.sampling;
    r["albedo"] = m.albedo;
    r["errata"] = m.errata;
    r["references"] = m.references;
    return r;
}

}  // namespace nacre::cli
