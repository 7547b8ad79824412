#include "apps/cli/subsurface_page.h"

#include "apps/cli/model_page.h"
#include "nacre/catalogue/describe.h"
#include "nacre/text/split_words.h"

namespace nacre::cli {

using nlohmann::ordered_json;

std::string profile_page(const ProfileDescription& p) {
    std::string page = fmt::format("{}: {}\n\n", p.name, p.title);
    page += wrapped("  by         ", fmt::format("{}, {}", p.authors, p.year));
    page += wrapped("  paper      ", p.paper);
    page +=
        fmt::format("\n  formula (mm^-2, of the light that has entered)\n{}", indented(p.formula));
    page += "\n";
    page += wrapped("  scattered once  ", p.single_scattering);
    page += wrapped("  inversion       ",
                    p.invertible ? "its total follows from the reduced albedo, so that "
                                   "an albedo can be asked for"
                                 : "none: its total does not follow the medium");
    if (!p.options.empty()) page += fmt::format("\n  options (nacre profile {} --set)\n", p.name);
    for (const Parameter& option : p.options) page += parameter_text(option);
    if (!p.errata.empty()) page += "\n  errata of the literature\n";
    for (std::string_view e : p.errata) page += wrapped("    - ", e);
    return page;
}

ordered_json profile_json(const ProfileDescription& p) {
    ordered_json r =
        heading_json({p.name, "profile", p.title, p.authors, p.year, p.paper, p.options});
    r["formula"] = p.formula;
    r["single_scattering"] = p.single_scattering;
    r["invertible"] = p.invertible;
    r["errata"] = p.errata;
    return r;
}

std::string technique_page(const TechniqueDescription& t) {
    std::string page = fmt::format("{}: {}\n\n", t.name, t.title);
    page += wrapped("  by          ", fmt::format("{}, {}", t.authors, t.year));
    page += wrapped("  paper       ", t.paper);
    page += wrapped("  how         ", t.how);
    page += wrapped("  precomputes ", t.precomputes.empty() ? "nothing" : t.precomputes);
    page += wrapped("  may change  ", t.keeps.text());
    if (t.parameters.empty()) return page;  // a complete simulation has its integrator's options
    page += fmt::format("\n  options (nacre render --technique {} --set)\n", t.name);
    for (const Parameter& p : t.parameters) page += parameter_text(p);
    return page;
}

ordered_json technique_json(const TechniqueDescription& t) {
    ordered_json r =
        heading_json({t.name, "technique", t.title, t.authors, t.year, t.paper, t.parameters});
    r["how"] = t.how;
    r["precomputes"] = t.precomputes;
    r["may_change"] = t.keeps.text();
    return r;
}

}  // namespace nacre::cli
