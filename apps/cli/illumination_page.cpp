#include "apps/cli/illumination_page.h"

#include <fmt/format.h>

#include "nacre/catalogue/describe.h"

namespace nacre::cli {

namespace {

std::string_view part_name(illumination::Part part) {
    constexpr std::string_view names[] = {"ambient", "diffuse", "specular", "transparency"};
    return names[static_cast<int>(part)];
}

}  // namespace

std::string illumination_page(const illumination::Description& m) {
    std::string page = fmt::format("{} {}: {}\n{}, {}. {}.\n\n    {}\n\npart: {}; properties: {}\n",
                                   m.number, m.name, m.title, m.authors, m.year, m.source,
                                   m.formula, part_name(m.part), m.properties);
    if (!m.errata.empty()) page += fmt::format("errata: {}\n", m.errata);
    if (!m.parameters.empty()) page += "\n  parameters (<integrator type=\"legacy\">)\n";
    for (const Parameter& p : m.parameters) page += parameter_text(p);
    if (m.uses_viewer_distance) page += "The distance to the viewer counts.\n";
    return page;
}

nlohmann::ordered_json illumination_json(const illumination::Description& m) {
    nlohmann::ordered_json r =
        heading_json({m.name, "illumination", m.title, m.authors, m.year, m.source, m.parameters});
    r["number"] = m.number;
    r["formula"] = m.formula;
    r["part"] = part_name(m.part);
    r["properties"] = m.properties;
    r["errata"] = m.errata;
    return r;
}

}  // namespace nacre::cli
