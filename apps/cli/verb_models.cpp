// nacre models: what there is to render with, from the library's own lists.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/illumination_page.h"
#include "apps/cli/microgeometry_page.h"
#include "apps/cli/model_docs.h"
#include "apps/cli/model_page.h"
#include "apps/cli/subsurface_page.h"
#include "apps/cli/verb.h"
#include "nacre/catalogue/describe.h"
#include "nacre/layers/skin.h"
#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/optics/phase.h"
#include "nacre/peers/peer.h"
#include "nacre/reflectance/registry.h"
#include "nacre/render/integrator.h"
#include "nacre/scene/build.h"
#include "nacre/techniques/techniques.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const Vec3f& v) {
    // Through the shortest decimal, so that 0.002 does not become 0.0020000000949949026.
    const auto number = [](float x) { return std::stod(fmt::format("{}", x)); };
    return {number(v.x), number(v.y), number(v.z)};
}

ordered_json to_json(const MeasuredMedium& m) {
    ordered_json r =
        heading_json({.name = m.name, .kind = "medium", .title = m.name, .paper = m.source});
    r["sigma_s_prime_per_mm"] = to_json(m.sigma_s_prime);
    r["sigma_a_per_mm"] = to_json(m.sigma_a);
    r["eta"] = std::stod(fmt::format("{}", m.eta));
    if (m.diffuse_reflectance) r["diffuse_reflectance"] = to_json(*m.diffuse_reflectance);
    return r;
}

constexpr std::string_view skin_source =
    "S. L. Jacques 1998, Skin Optics, OMLC News; layers after A. Krishnaswamy, G. Baranoski 2004";

/// Skin as one medium, at a few wavelengths.
ordered_json skin_json() {
    ordered_json r = heading_json(
        {.name = "skin", .kind = "spectral_medium", .title = "Human skin", .paper = skin_source});
    for (double nm = 400.; nm <= 700.; nm += 50.) {
        const Layer m = skin_coefficients(SkinParameters{}, nm);
        r["spectrum"].push_back({{"nm", nm},
                                 {"sigma_s_prime_per_mm", m.sigma_s * (1. - m.g)},
                                 {"sigma_a_per_mm", m.sigma_a},
                                 {"g", m.g},
                                 {"eta", m.eta}});
    }
    return r;
}

std::string skin_page() {
    std::string page = fmt::format(
        "skin: layers of human skin, and one medium that stands for them (<medium "
        "type=\"skin\">)\n  source: {}\n  as layers: nacre slab --skin\n\n  {:>6} {:>26} {:>18} "
        "{:>8}\n",
        skin_source, "nm", "reduced scattering, mm^-1", "absorption, mm^-1", "g");
    for (double nm = 400.; nm <= 700.; nm += 50.) {
        const Layer m = skin_coefficients(SkinParameters{}, nm);
        page += fmt::format("  {:>6} {:>26.4g} {:>18.4g} {:>8.3g}\n", nm, m.sigma_s * (1. - m.g),
                            m.sigma_a, m.g);
    }
    return page;
}

ordered_json peer_json(const PeerDescription& p) {
    ordered_json r = heading_json({.name = p.name, .kind = "peer", .title = p.title});
    r["how_to_install"] = p.how_to_install;
    return r;
}

std::string peer_page(const PeerDescription& p) {
    return fmt::format("{}: {}\n  used by: nacre compare --peer {}\n  install: {}\n", p.name,
                       p.title, p.name, p.how_to_install);
}

/// Everything that has only a name, by kind.
std::vector<std::pair<std::string, std::vector<std::string>>> named_models() {
    const auto names = [](std::span<const std::string_view> views) {
        return std::vector<std::string>(views.begin(), views.end());
    };
    return {{"bsdf", material_types()},
            {"phase", names(PhaseFunction::names())},
            {"integrator", names(integrator_types())}};
}

constexpr std::pair<const char*, const char*> headings[] = {
    {"bsdf", "materials (<bsdf type=...>)"},
    {"phase", "phase functions (<phase type=...>)"},
    {"integrator", "integrators (<integrator type=...>)"},
};

/// The name, and of a reflectance model who and when.
std::string line_of(const std::string& name) {
    for (const ModelDescription* m : models())
        if (m->name == name)
            return fmt::format("  {:<18} {} ({}, {})\n", name, m->title, m->authors, m->year);
    return fmt::format("  {}\n", name);
}

int list(bool json) {
    if (json) {
        ordered_json r;
        for (const auto& [kind, names] : named_models()) r[kind] = names;
        for (const illumination::Description* m : illumination::models())
            r["illumination"].push_back(illumination_json(*m));
        for (const ProfileDescription* p : profiles()) r["profile"].push_back(profile_json(*p));
        for (const TechniqueDescription* t : techniques())
            r["technique"].push_back(technique_json(*t));
        for (const MeasuredMedium* m : measured_media()) r["medium"].push_back(to_json(*m));
        r["spectral_medium"].push_back(skin_json());
        for (const PeerDescription* p : peers()) r["peer"].push_back(peer_json(*p));
        for (const MicrogeometryDescription* g : microgeometries())
            r["microgeometry"].push_back(microgeometry_json(*g));
        for (const InstrumentDescription* i : instruments())
            r["instrument"].push_back(instrument_json(*i));
        fmt::print("{}\n", r.dump(2));
        return success;
    }
    for (const auto& [kind, names] : named_models()) {
        const auto heading = std::find_if(std::begin(headings), std::end(headings),
                                          [&](const auto& h) { return kind == h.first; });
        fmt::print("{}\n", heading->second);
        for (const std::string& n : names) fmt::print("{}", line_of(n));
        fmt::print("\n");
    }
    fmt::print("illumination models (<integrator type=\"legacy\">), by number\n");
    for (const illumination::Description* m : illumination::models())
        fmt::print("  {:>2} {:<22} {} ({}, {})\n", m->number, m->name, m->title, m->authors,
                   m->year);
    const auto line = [](const auto& m) {
        fmt::print("  {:<22} {} ({}, {})\n", m.name, m.title, m.authors, m.year);
    };
    fmt::print("\ndiffusion profiles (nacre profile, <subsurface type=...>)\n");
    for (const ProfileDescription* p : profiles()) line(*p);
    fmt::print("\ntechniques for translucent objects (nacre render --technique)\n");
    for (const TechniqueDescription* t : techniques()) line(*t);
    fmt::print("\nmeasured media (--material), mm^-1 in red, green, blue\n");
    fmt::print("  {:<24} {:<26} {:<26} {}\n", "name", "reduced scattering", "absorption", "index");
    const auto triple = [](const Vec3f& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
    for (const MeasuredMedium* m : measured_media())
        fmt::print("  {:<24} {:<26} {:<26} {}\n", m->name, triple(m->sigma_s_prime),
                   triple(m->sigma_a), m->eta);
    fmt::print("  {:<24} by wavelength; see 'nacre models show skin'\n", "skin");
    fmt::print("\nmicrogeometry (nacre measure)\n");
    for (const MicrogeometryDescription* g : microgeometries())
        fmt::print("  {:<22} {}\n", g->name, g->title);
    fmt::print("\ngonioreflectometers (nacre measure --instrument)\n");
    for (const InstrumentDescription* i : instruments())
        fmt::print("  {:<22} {}\n", i->name, i->title);
    fmt::print("\nother renderers (nacre compare --peer)\n");
    for (const PeerDescription* p : peers()) fmt::print("  {:<22} {}\n", p->name, p->title);
    return success;
}

void show_medium(const MeasuredMedium& m) {
    fmt::print("{}: measured medium\n  source: {}\n  index of refraction: {}\n", m.name, m.source,
               m.eta);
    const auto row = [](const char* what, const Vec3f& v) {
        fmt::print("  {:<38} {:<10.4g} {:<10.4g} {:.4g}\n", what, v.x, v.y, v.z);
    };
    const Vec3f t = m.sigma_t_prime();
    row("reduced scattering, mm^-1", m.sigma_s_prime);
    row("absorption, mm^-1", m.sigma_a);
    row("reduced albedo",
        {m.sigma_s_prime.x / t.x, m.sigma_s_prime.y / t.y, m.sigma_s_prime.z / t.z});
    row("transport mean free path, mm", {1 / t.x, 1 / t.y, 1 / t.z});
    if (m.diffuse_reflectance) row("diffuse reflectance, as published", *m.diffuse_reflectance);
}

/// False if it is not one of the reflectance models.
bool show_reflectance_model(const std::string& name, bool json) {
    for (const ModelDescription* m : models()) {
        if (m->name != name) continue;
        if (json)
            fmt::print("{}\n", model_json(*m).dump(2));
        else
            fmt::print("{}", model_page(*m));
        return true;
    }
    return false;
}

/// One thing that has a page: its names are compared, and gathered for the message.
class Finder {
  public:
    explicit Finder(const std::string& name) : name_(plain_name(name)) {}

    bool is(std::string_view known) {
        known_.emplace_back(known);
        return plain_name(known) == name_;
    }
    [[noreturn]] void fail(const std::string& name) const {
        const std::vector<std::string_view> views(known_.begin(), known_.end());
        throw InputError(unknown_name("model", name, views));
    }

  private:
    std::string name_;
    std::vector<std::string> known_;
};

int print_page(bool json, const ordered_json& as_json, const std::string& page) {
    if (json)
        fmt::print("{}\n", as_json.dump(2));
    else
        fmt::print("{}", page);
    return success;
}

int show(const std::string& name, bool json) {
    Finder finder(name);
    // Before the integrators, of which one is a technique as well.
    for (const TechniqueDescription* t : techniques())
        if (finder.is(t->name)) return print_page(json, technique_json(*t), technique_page(*t));
    for (const ProfileDescription* p : profiles())
        if (finder.is(p->name)) return print_page(json, profile_json(*p), profile_page(*p));
    for (const auto& [kind, names] : named_models())
        for (const std::string& n : names) {
            if (!finder.is(n)) continue;
            if (show_reflectance_model(n, json)) return success;
            return print_page(json, heading_json({.name = n, .kind = kind, .title = n}),
                              fmt::format("{}: <{} type=\"{}\">\n", n, kind, n));
        }
    for (const MeasuredMedium* m : measured_media()) {
        if (!finder.is(m->name)) continue;
        if (json)
            fmt::print("{}\n", to_json(*m).dump(2));
        else
            show_medium(*m);
        return success;
    }
    if (finder.is("skin")) return print_page(json, skin_json(), skin_page());
    for (const PeerDescription* p : peers())
        if (finder.is(p->name)) return print_page(json, peer_json(*p), peer_page(*p));
    for (const MicrogeometryDescription* g : microgeometries())
        if (finder.is(g->name))
            return print_page(json, microgeometry_json(*g), microgeometry_page(*g));
    for (const InstrumentDescription* i : instruments())
        if (finder.is(i->name) ||
            finder.is(std::string(i->name) + "_instrument"))  // ward is a model
            return print_page(json, instrument_json(*i), instrument_page(*i));
    // Last, because some share their name with a material: those are asked for by number.
    for (const illumination::Description* m : illumination::models())
        if (finder.is(m->name) || std::to_string(m->number) == name)
            return print_page(json, illumination_json(*m), illumination_page(*m));
    finder.fail(name);
}

struct ModelsArguments {
    bool json = false, text = false;
    std::string name, folder;
};

}  // namespace

Action set_up_models(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<ModelsArguments>();
    app.add_flag("--json", o->json, "for programs");
    CLI::App* sub = app.add_subcommand("show", "one of them in full");
    sub->add_option(
           "name", o->name,
           "a material, medium, diffusion profile, technique, phase function, integrator, peer, "
           "microgeometry, an instrument, or the name or number of an illumination model")
        ->required();
    sub->add_flag("--json", o->json, "for programs");
    CLI::App* docs = app.add_subcommand("docs", "write the pages of all reflectance models");
    docs->add_option("folder", o->folder, "where to; docs/models of the repository")->required();
    docs->add_flag("--text", o->text, "the pages without their pictures");
    return [o, sub, docs, invocation] {
        if (docs->parsed())
            return write_model_docs(o->folder, o->text ? DocsPart::text : DocsPart::all,
                                    invocation);
        return sub->parsed() ? show(o->name, o->json) : list(o->json);
    };
}

}  // namespace nacre::cli
