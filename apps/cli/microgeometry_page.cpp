#include "apps/cli/microgeometry_page.h"

#include "nacre/catalogue/describe.h"

namespace nacre::cli {

std::string microgeometry_page(const MicrogeometryDescription& g) {
    std::string page = fmt::format("{}: {}\n\n", g.name, g.title);
    page += wrapped("  surface     ", g.meaning);
    for (std::string_view r : g.references) page += wrapped("  after       ", r);
    if (g.make_of_file) page += wrapped("  file        ", "file=NAME, needed: the picture");
    if (g.parameters.empty()) return page;
    page += fmt::format("\n  parameters (nacre measure \"{} name=value ...\")\n", g.name);
    for (const Parameter& p : g.parameters) page += parameter_text(p);
    return page;
}

nlohmann::ordered_json microgeometry_json(const MicrogeometryDescription& g) {
    nlohmann::ordered_json r = heading_json(
        {.name = g.name, .kind = "microgeometry", .title = g.title, .parameters = g.parameters});
    r["meaning"] = g.meaning;
    r["needs_file"] = g.make_of_file != nullptr;
    r["references"] = g.references;
    return r;
}

std::string instrument_page(const InstrumentDescription& i) {
    std::string page = fmt::format("{}: {}\n\n", i.name, i.title);
    page += wrapped("  instrument  ", i.meaning);
    for (std::string_view r : i.references) page += wrapped("  after       ", r);
    page += fmt::format("\n  parameters (nacre measure ... --instrument \"{} name=value ...\")\n",
                        i.name);
    for (const Parameter& p : i.parameters) page += parameter_text(p);
    return page;
}

nlohmann::ordered_json instrument_json(const InstrumentDescription& i) {
    nlohmann::ordered_json r = heading_json(
        {.name = i.name, .kind = "instrument", .title = i.title, .parameters = i.parameters});
    r["meaning"] = i.meaning;
    r["references"] = i.references;
    return r;
}

}  // namespace nacre::cli
