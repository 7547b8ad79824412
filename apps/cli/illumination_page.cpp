#include "apps/cli/illumination_page.h"

#include <fmt/format.h>

namespace nacre::cli {

using illumination::Parameter;

namespace {

std::string_view part_name(illumination::Part part) {
    constexpr std::string_view names[] = {"ambient", "diffuse", "specular", "transparency"};
    return names[static_cast<int>(part)];
}

std::string default_of(const Parameter& p) {
    return p.kind == Parameter::Kind::choice
               ? std::string(p.choices[static_cast<std::size_t>(p.otherwise)])
               : fmt::format("{:g}", p.otherwise);
}

}  // namespace

std::string illumination_page(const illumination::Description& m) {
    std::string page = fmt::format("{} {}: {}\n{}, {}. {}.\n\n    {}\n\npart: {}; properties: {}\n",
                                   m.number, m.name, m.title, m.authors, m.year, m.source,
                                   m.formula, part_name(m.part), m.properties);
    if (!m.errata.empty()) page += fmt::format("errata: {}\n", m.errata);
    page += "\nparameters\n";
    for (const Parameter& p : m.parameters)
        page += fmt::format("  {:<13} {}{}; {}; default {}\n", p.name, p.meaning,
                            p.unit.empty() ? "" : fmt::format(", {}", p.unit),
                            illumination::range_text(p), default_of(p));
    if (m.uses_viewer_distance) page += "The distance to the viewer counts.\n";
    return page;
}

nlohmann::ordered_json illumination_json(const illumination::Description& m) {
    nlohmann::ordered_json r{
        {"number", m.number},         {"name", m.name},       {"kind", "illumination"},
        {"title", m.title},           {"authors", m.authors}, {"year", m.year},
        {"source", m.source},         {"formula", m.formula}, {"part", part_name(m.part)},
        {"properties", m.properties}, {"errata", m.errata}};
    for (const Parameter& p : m.parameters)
        r["parameters"].push_back({{"name", p.name},
                                   {"meaning", p.meaning},
                                   {"unit", p.unit},
                                   {"range", illumination::range_text(p)},
                                   {"default", default_of(p)}});
    return r;
}

}  // namespace nacre::cli
