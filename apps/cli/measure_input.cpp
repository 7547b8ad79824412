#include "apps/cli/measure_input.h"

#include <CLI/CLI.hpp>

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
    for (const ShapeBinding& s : scene->shapes)
        if (s.separates_media)
            throw InputError(
                fmt::format("{}: '{}' has a medium behind it; only light that surfaces reflect and "
                            "refract is measured",
                            input.surface, s.name));
    const std::array<double, 4> tile = tile_of(input.tile);
    // Aliased: the rays live as long as their scene.
    const std::shared_ptr<const RayScene> rays(scene, &scene->rays);
    r.patch = make_patch(
        rays,
        [scene](const SurfacePoint& at, const Wavelengths& w, BsdfScratch& scratch) -> const Bsdf& {
            return scene->shapes[at.shape].material->at(at, w, scratch);
        },
        tile[0], tile[1], tile[2], tile[3]);
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
    r.patch = make_patch(make_microgeometry(input.surface), surface_bsdf(material, r.wavelengths));
    r.facts["surface"] = input.surface;
    r.facts["material"] = material;
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
                   "of a generated surface: a model with parameters, or mirror (\"lambert "
                   "reflectance=0.5\")");
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
