// nacre eval: values, albedo and pictures of a reflectance model.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/direction.h"
#include "apps/cli/measured_page.h"
#include "apps/cli/number_option.h"
#include "apps/cli/plot.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/measured/cuts.h"
#include "nacre/reflectance/albedo.h"

namespace nacre::cli {
namespace {

constexpr double degree = std::numbers::pi / 180.;

struct EvalArguments {
    std::string model, wi, wo, output;
    std::vector<std::string> set;
    double nm = 550.;
    bool albedo = false, slice = false, lobe = false, curve = false, json = false;
};

/// The angles of incidence of a plot: that of --wi, or a few. A grazing lobe would dwarf the others
/// in a polar plot.
std::vector<double> incidences(const EvalArguments& o) {
    if (o.wi.empty())
        return o.lobe ? std::vector<double>{0., 30., 60.} : std::vector<double>{0., 30., 60., 80.};
    const Vec3d wi = parse_direction(o.wi, "--wi");
    if (!(wi.z > 0.)) throw InputError("--wi must lie above the horizon: z > 0");
    return {std::round(std::acos(wi.z) / degree * 1e6) / 1e6};
}

std::string title_of(const EvalArguments& o) {
    std::string title;
    for (std::string s : o.set) {
        if (const std::size_t at = s.find('='); at != s.npos) s.replace(at, 1, " = ");
        title += (title.empty() ? "" : ", ") + s;
    }
    return fmt::format("{}: {}; {:g} nm", o.model, title.empty() ? "default parameters" : title,
                       o.nm);
}

/// Albedo over the angle of incidence.
Table albedo_table(const AnyModel& model, const EvalArguments& o) {
    Table t{title_of(o), {"theta_i_deg", "albedo"}, {}, PlotKind::curves, "albedo"};
    t.x_label = "angle of incidence / degrees";
    for (int i = 0; i <= 89; ++i) {
        const Vec3d wi = in_plane(i * degree);
        t.rows.push_back(
            {double(i), directional_albedo(model, wi, o.nm, 1e-6).value + model.mirror(wi, o.nm)});
    }
    return t;
}

/// Values in the plane of incidence, light at negative angles, viewer from -90 to 90 degrees.
Table cut_table(const AnyModel& model, const EvalArguments& o, PlotKind kind) {
    Table t{title_of(o),
            {"theta_o_deg"},
            {},
            kind,
            kind == PlotKind::polar
                ? "BRDF / sr⁻¹, as distance from the origin; light from the left"
                : "BRDF / sr⁻¹"};
    t.x_label = "angle of the viewer in the plane of incidence / degrees";
    t.names = {""};
    const std::vector<double> angles = incidences(o);
    for (double a : angles) {
        t.columns.push_back(fmt::format("theta_i={:g}", a));
        t.names.push_back(fmt::format("incidence {:g}°", a));
    }
    for (double out = -89.5; out <= 89.5; out += 0.5) {
        std::vector<double> row{out};
        for (double a : angles)
            row.push_back(model.eval(in_plane(-a * degree), in_plane(out * degree), o.nm));
        t.rows.push_back(std::move(row));
    }
    return t;
}

/// Burley's slice: the value over the angle of the half vector to the normal and that of the light
/// to the half vector.
Table slice_table(const AnyModel& model, const EvalArguments& o) {
    Table t{title_of(o), {"theta_h_deg", "theta_d_deg", "f"}, {}, PlotKind::image, "BRDF / sr⁻¹"};
    t.x_label = "angle of the half vector to the normal / degrees";
    t.names = {"", "angle of the light to the half vector / degrees", ""};
    for (int d = 0; d < 90; ++d)
        for (int h = 0; h < 90; ++h) {
            const DirectionPair w = burley_slice((h + 0.5) * degree, (d + 0.5) * degree);
            t.rows.push_back({h + 0.5, d + 0.5, model.eval(w.wi, w.wo, o.nm)});
        }
    return t;
}

int evaluate(const AnyModel& model, const EvalArguments& o) {
    if (o.wi.empty() || o.wo.empty())
        throw InputError(
            "give --wi and --wo, or one of --albedo, --slice, --lobe, --curve; see 'nacre help "
            "eval'");
    const Vec3d wi = parse_direction(o.wi, "--wi"), wo = parse_direction(o.wo, "--wo");
    const double f = model.eval(wi, wo, o.nm), pdf = model.pdf(wi, wo, o.nm);
    if (o.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"model", o.model},
                                                  {"value", f},
                                                  {"value_cos", f * std::max(wi.z, 0.)},
                                                  {"pdf", pdf}}
                               .dump(2));
    else
        fmt::print(
            "f             {:.12g} sr^-1\nf cos(theta)  {:.12g} sr^-1\npdf           {:.12g} "
            "sr^-1\n",
            f, f * std::max(wi.z, 0.), pdf);
    return success;
}

int run(const EvalArguments& o) {
    if (o.albedo + o.slice + o.lobe + o.curve > 1)
        throw InputError("give one of --albedo, --slice, --lobe, --curve");
    Settings settings;
    for (const std::string& s : o.set) settings.push_back(parse_setting(s));
    refuse_data_as_model(o.model, "eval");
    const AnyModel model = make_model(o.model, settings);
    if (o.albedo && !o.wi.empty()) {
        const Vec3d wi = parse_direction(o.wi, "--wi");
        const Albedo a = directional_albedo(model, wi, o.nm);
        const double mirror = model.mirror(wi, o.nm);
        if (o.json)
            fmt::print("{}\n", nlohmann::ordered_json{{"model", o.model},
                                                      {"albedo", a.value + mirror},
                                                      {"mirror", mirror},
                                                      {"error", a.error}}
                                   .dump(2));
        else
            fmt::print("albedo        {:.9g} (within {:.1g})\n", a.value + mirror, a.error);
        return success;
    }
    if (!(o.albedo || o.slice || o.lobe || o.curve)) {
        if (!o.output.empty())
            throw InputError("-o needs one of --albedo, --slice, --lobe, --curve");
        return evaluate(model, o);
    }
    if (!o.wo.empty()) throw InputError("--wo has no meaning for a plot");
    write_table(o.albedo  ? albedo_table(model, o)
                : o.slice ? slice_table(model, o)
                          : cut_table(model, o, o.lobe ? PlotKind::polar : PlotKind::curves),
                o.output);
    return success;
}

}  // namespace

Action set_up_eval(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<EvalArguments>();
    app.add_option("model", o->model, "a reflectance model; see 'nacre models'")->required();
    app.add_option("--set", o->set, "parameters, name=value; colours as red,green,blue")
        ->allow_extra_args()
        ->expected(1, 64);
    app.add_option("--wi", o->wi, "direction to the light, x,y,z with z the normal");
    app.add_option("--wo", o->wo, "direction to the viewer");
    add_number(app, "--lambda", o->nm, {0, 1e9, true}, "wavelength, nm (550)");
    app.add_flag("--albedo", o->albedo, "share of light that is scattered: from --wi, or over all");
    app.add_flag("--slice", o->slice, "image over theta_h and theta_d (Burley)");
    app.add_flag("--lobe", o->lobe, "polar plot in the plane of incidence");
    app.add_flag("--curve", o->curve, "value over the viewer's angle in the plane of incidence");
    app.add_flag("--json", o->json, "for programs");
    app.add_option("-o,--output", o->output, "table or picture: .csv, .svg, .png (default: print)");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
