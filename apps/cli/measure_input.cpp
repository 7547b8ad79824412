#include "apps/cli/measure_input.h"

#include <CLI/CLI.hpp>

#include "apps/cli/measure_material.h"
#include "apps/cli/number_option.h"
#include "apps/cli/streams.h"
#include "nacre/goniometer/patch_material.h"
#include "nacre/math/error.h"
#include "nacre/scene/content_key.h"
#include "nacre/scene/load.h"

namespace nacre::cli {
namespace {

std::array<double, 4> tile_of(const std::vector<std::string>& texts) {
    std::array<double, 4> tile{};
    if (texts.empty()) return tile;
    const auto wrong = [&] {
        return InputError(
            fmt::format("--tile: '{}' is not x,y,width,height, with a width and a height above 0",
                        fmt::join(texts, ",")));
    };
    if (texts.size() != 4) throw wrong();
    for (std::size_t i = 0; i < 4; ++i) {
        const auto x = number_in(texts[i]);
        if (!x || (i > 1 && !(*x > 0.))) throw wrong();
        tile[i] = *x;
    }
    return tile;
}

void add_media(const Scene& scene, const std::string& file, MeasuredPatch& r) {
    std::map<const Medium*, int> position;
    const auto at = [&](const Medium* medium, const ShapeBinding& shape) {
        if (!medium) return -1;
        const auto [place, is_new] = position.try_emplace(medium, int(r.patch.media.size()));
        if (!is_new) return place->second;
        if (!medium->homogeneous())
            throw InputError(
                fmt::format("{}: the medium of '{}' varies in space; light is followed through "
                            "homogeneous media only",
                            file, shape.name));
        const MediumCoefficients c = medium->coefficients({}, r.wavelengths);
        r.patch.media.push_back({shape.name, c.sigma_t, c.sigma_s, medium->phase});
        return place->second;
    };
    for (const ShapeBinding& s : scene.shapes)
        r.patch.sides.push_back({s.separates_media, at(s.interior, s), at(s.exterior, s)});
    if (r.patch.media.empty()) r.patch.sides.clear();
}

void load_scene_patch(const MeasureInput& input, MeasuredPatch& r) {
    if (!input.material.empty())
        throw InputError("--material is for generated surfaces: a scene says what it is made of");
    LoadOptions options;
    for (const std::string& d : input.defines) {
        const std::size_t at = d.find('=');
        if (at == d.npos || at == 0)
            throw InputError(fmt::format("-D: '{}' is not of the form name=value", d));
        options.defines[d.substr(0, at)] = d.substr(at + 1);
    }
    auto scene = std::make_shared<Scene>(load_scene(input.surface, options));
    if (scene->mode == ColorMode::spectral && !input.nm)
        throw InputError(fmt::format(
            "{}: its materials depend on the wavelength: say which, --lambda nm", input.surface));
    const std::array<double, 4> tile = tile_of(input.tile);
    // Aliased: the rays live as long as their scene.
    const std::shared_ptr<const RayScene> rays(scene, &scene->rays);
    r.patch = make_patch(
        rays,
        [scene](const SurfacePoint& at, const Wavelengths& w, BsdfScratch& scratch) -> const Bsdf& {
            return scene->shapes[at.shape].material->at(at, w, scratch);
        },
        tile[0], tile[1], tile[2], tile[3]);
    add_media(*scene, input.surface, r);
    r.facts["surface"] = "scene " + content_key(*scene);
    r.facts["tile"] = fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", r.patch.x, r.patch.y,
                                  r.patch.width, r.patch.height);
}

void generate_patch(const MeasureInput& input, MeasuredPatch& r) {
    if (!input.tile.empty() || !input.defines.empty())
        throw InputError(
            fmt::format("{} is for scenes: generated surfaces have a period of their "
                        "own",
                        input.tile.empty() ? "-D" : "--tile"));
    const std::string material =
        input.material.empty() ? "lambert reflectance=0.5" : input.material;
    r.facts["surface"] = input.surface;
    add_file_facts(input.surface, r.facts);
    Microgeometry geometry = make_microgeometry(input.surface);
    r.patch = make_patch(std::move(geometry), generated_material(material, r.wavelengths, r.facts));
}

}  // namespace

void add_measure_input(CLI::App& app, MeasureInput& input) {
    std::string known;
    for (const MicrogeometryDescription* d : microgeometries())
        known += (known.empty() ? "" : ", ") + std::string(d->name);
    app.add_option("surface", input.surface,
                   "a scene (.xml) whose shapes are one period of a surface with the mean normal "
                   "+z, or one of " +
                       known + ", with parameters: \"v_grooves angle=30\"")
        ->required();
    app.add_option("--material", input.material,
                   "of a generated surface: a model or a material of scenes with parameters "
                   "(\"dielectric int_ior=1.5\"), a file of measured reflectance, or mirror "
                   "(\"lambert reflectance=0.5\")");
    app.add_option("-D,--define", input.defines, "name=value: sets a <default> of the scene");
    app.add_option("--tile", input.tile,
                   "x,y,width,height of a period of the scene (the extent of its shapes)")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_number(app, "--lambda", input.nm, {360, 830},
               "at this wavelength, nm (in the three bands of RGB)");
}

MeasuredPatch load_patch(const MeasureInput& input) {
    MeasuredPatch r;
    r.wavelengths =
        input.nm ? Wavelengths::at(Spectral(float(*input.nm))) : Wavelengths::rgb_bands();
    r.lanes = input.nm ? std::vector<std::string>{fmt::format("{:.6g}nm", *input.nm)}
                       : std::vector<std::string>{"r", "g", "b"};
    const std::filesystem::path path = input.surface;
    if (path.extension() == ".xml")
        load_scene_patch(input, r);
    else
        generate_patch(input, r);
    r.facts["wavelengths"] = fmt::format("{}", fmt::join(r.lanes, ", "));
    return r;
}

}  // namespace nacre::cli
