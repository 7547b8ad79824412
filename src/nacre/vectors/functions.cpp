#include "nacre/vectors/functions.h"

#include "nacre/illumination/geometric_attenuation.h"
#include "nacre/illumination/m21_linear_transparency.h"
#include "nacre/illumination/m23_hall_transparency.h"
#include "nacre/illumination/models.h"
#include "nacre/math/error.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/eon.h"
#include "nacre/reflectance/facets.h"
#include "nacre/reflectance/he_torrance.h"
#include "nacre/reflectance/schlick.h"
#include "nacre/reflectance/schlick_ct.h"
#include "nacre/spectrum/photometry.h"
#include "nacre/spectrum/planck.h"
#include "nacre/vectors/file.h"

namespace nacre {
namespace {

using nlohmann::json;
using Answers = std::map<std::string, double>;

constexpr double degree = std::numbers::pi / 180.;

double parameter(const json& v, const char* name) { return v.at("params").at(name).get<double>(); }
Vec3d direction(double theta, double phi = 0.) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Answers dielectric(const json& v) {
    const auto r = fresnel_dielectric_polarised(parameter(v, "c"), parameter(v, "n"));
    return {{"Rs", r.s}, {"Rp", r.p}, {"R", r.mean()}};
}
Answers conductor(const json& v) {
    const auto r =
        fresnel_conductor_polarised(parameter(v, "c"), parameter(v, "n"), parameter(v, "k"));
    const double h = parameter(v, "h");
    return {{"Rs", r.s}, {"Rp", r.p}, {"F", h * r.p + (1. - h) * r.s}, {"F_unpolarised", r.mean()}};
}
Answers schlick_fresnel(const json& v) {
    const double c = parameter(v, "c"), f0 = parameter(v, "f0");
    FacetFresnel<double, double> fourth{};
    fourth.form = FresnelForm::power4;
    return {{"F", fresnel_schlick(c, f0)},
            {"n_from_f0", index_of_normal_reflectance(f0)},
            {"seed002_pow4", fourth.at(c)}};
}
Answers distributions(const json& v) {
    const double t = std::tan(parameter(v, "theta_deg") * degree), m = parameter(v, "m");
    const double constant = facet_detail::gauss_constant(m);
    const auto density = [&](FacetDistribution kind, double width) {
        return facet_detail::facet_density(kind, t * t, width, constant);
    };
    const double beckmann = density(FacetDistribution::beckmann, m);
    SchlickCt<double> rational{};
    rational.m = m;
    return {{"beckmann", beckmann},
            {"hall_beckmann", 0.25 * beckmann},
            {"trowbridge_reitz", density(FacetDistribution::trowbridge_reitz, m)},
            {"gauss", density(FacetDistribution::gauss, m)},
            {"gauss_C", constant},
            {"schlick_D", rational.density(direction(parameter(v, "theta_deg") * degree))},
            {"phong_c", density(FacetDistribution::phong, parameter(v, "c"))}};
}
Answers half_height(const json& v) {
    const double beta = parameter(v, "beta_deg") * degree;
    const double gauss = width_of_half_height(FacetDistribution::gauss, beta);
    return {{"Ns", width_of_half_height(FacetDistribution::phong, beta)},
            {"C1", 1. / (std::numbers::sqrt2 * gauss)},
            {"C2", width_of_half_height(FacetDistribution::trowbridge_reitz, beta)},
            {"m", width_of_half_height(FacetDistribution::beckmann, beta)},
            {"m_seed_alternative", width_unclipped(beta)}};
}
/// He and Torrance's model of unpolarised light; sigma0, tau and lambda in micrometres.
HeTorrance<double> he_torrance(HeShadowing shadowing, double sigma0, double tau, double lambda,
                               double n = 1.5, double k = 0.) {
    return {shadowing, 0., n, k, 0.5, sigma0, tau, 1e3 * lambda};
}
Answers he_torrance_parts(const json& v) {
    const auto model = he_torrance(HeShadowing::smith, parameter(v, "sigma0"), parameter(v, "tau"),
                                   parameter(v, "lambda"), parameter(v, "n"), parameter(v, "k"));
    const Vec3d wi = direction(parameter(v, "theta_i_deg") * degree);
    const Vec3d wo =
        direction(parameter(v, "theta_o_deg") * degree, parameter(v, "dphi_deg") * degree);
    const Vec3d sum = wi + wo;
    const double ratio = dot(sum, sum) / sum.z;
    return {
        {"F", model.fresnel(wi, wo)},         {"S", model.facets_seen(wi) * model.facets_seen(wo)},
        {"g", model.phase2(wi, wo)},          {"G", ratio * ratio},
        {"D", model.roughness(wi, wo)},       {"sigma", model.effective_deviation(wi, wo)},
        {"rho_specular_wi", model.mirror(wi)}};
}
/// By the trapezoid rule of 10 nm over 380 to 780 nm, as the vectors.
double planck_luminance(double kelvin, double km, float (*efficiency)(float)) {
    double sum = 0.;
    for (int nm = 380; nm <= 780; nm += 10)
        sum += (nm == 380 || nm == 780 ? 5. : 10.) * double(efficiency(float(nm))) *
               planck_radiance(nm, kelvin);
    return km * sum;
}
Answers black_body(const json& v) {
    const double kelvin = parameter(v, "T");
    return {{"L_photopic", planck_luminance(kelvin, km_photopic, photopic_efficiency)},
            {"L_scotopic", planck_luminance(kelvin, km_scotopic, scotopic_efficiency)}};
}
Answers masking(const json& v) {
    const Vec3d wi = direction(parameter(v, "theta_i_deg") * degree);
    const Vec3d wo =
        direction(parameter(v, "theta_o_deg") * degree, parameter(v, "dphi_deg") * degree);
    const double m = parameter(v, "m"), k = std::sqrt(2. * inv_pi) * m;
    const double ti = m * facet_detail::bounded_tangent(wi);
    const double to = m * facet_detail::bounded_tangent(wo);
    const double bi = facet_detail::lambda_beckmann(ti), bo = facet_detail::lambda_beckmann(to);
    const double gi = facet_detail::lambda_trowbridge_reitz(ti);
    const double go = facet_detail::lambda_trowbridge_reitz(to);
    // The m of Schlick's equation 65 is the deviation of slopes along one axis, m = sqrt(2) sigma0 /
    // tau here; it lacks the exponential, as what He et al. print does.
    const auto printed = he_torrance(HeShadowing::printed, m, std::numbers::sqrt2, 0.5);
    const auto smith = he_torrance(HeShadowing::smith, m, std::numbers::sqrt2, 0.5);
    return {{"schlick_eq65", printed.facets_seen(wi) * printed.facets_seen(wo)},
            {"smith_S_eq65_with_exp", smith.facets_seen(wi) * smith.facets_seen(wo)},
            {"vcavity", facet_detail::v_cavity(wi, wo)},
            {"sancer", 1. / (1. + bi + bo)},
            {"smith_beckmann_sep", 1. / ((1. + bi) * (1. + bo))},
            {"smith_ggx_corr", 1. / (1. + gi + go)},
            {"smith_ggx_sep", 1. / ((1. + gi) * (1. + go))},
            {"schlick", schlick_masking(wi.z, k) * schlick_masking(wo.z, k)},
            {"he_S", illumination::self_shadowing_smith(wi, m) *
                         illumination::self_shadowing_smith(wo, m)}};
}
Answers schlick_factors(const json& v) {
    const double t = parameter(v, "t"), w = parameter(v, "w"), r = parameter(v, "r");
    return {{"Z", schlick_zenith((1. - t * t) / (t * t), r)},
            {"A", schlick_azimuth(w * w, 1. - w * w, parameter(v, "p"))},
            {"G1_k", schlick_masking(parameter(v, "v"), r)}};
}
Answers plate(const json& v) {
    const double n = parameter(v, "n");
    const double whole = illumination::HallTransparency<double>{n}.transmittance(Vec3d{0., 0., 1.});
    return {{"plate", whole},
            {"closed_2n", whole},
            {"interface", illumination::interface_transmittance(n)}};
}
Answers fujii_albedo(const json& v) {
    const double mu = parameter(v, "mu");
    const Eon<double> model{EonVariant::fujii, 1., parameter(v, "r")};
    return {{"E", model.albedo(Vec3d{std::sqrt(1. - mu * mu), 0., mu})}};
}

/// An illumination model with the parameters and the situation of a vector, whose names differ from
/// ours where the papers' letters do.
Answers illuminate(const illumination::Description& model, const json& v) {
    using namespace illumination;
    auto values = illumination::Values<double>::defaults(model);
    Lighting<double> at{.wi = direction_of(v.at("wi")), .wo = direction_of(v.at("wo"))};
    double own = 0., behind = 0.;
    const std::map<std::string, double*> situation = {{"I_L", &at.light},
                                                      {"I", &at.ambient},
                                                      {"dL", &at.light_distance},
                                                      {"dV", &at.viewer_distance},
                                                      {"dOmega", &at.solid_angle},
                                                      {"lambda", &at.wavelength},
                                                      {"Ir", &own},
                                                      {"It", &behind}};
    const std::map<std::string, std::string> ours = {{"beta_deg", "beta"},
                                                     {"gamma_deg", "gamma"},
                                                     {"Datt", "distribution"},
                                                     {"Gatt", "geometry"}};
    const std::map<std::string, std::string> words = {
        {"P", "phong"}, {"TR", "trowbridge_reitz"}, {"TS", "torrance_sparrow"}, {"S", "sancer"}};
    for (const auto& [name, value] : v.at("params").items()) {
        if (const auto place = situation.find(name); place != situation.end()) {
            // The vectors' wavelengths are in the micrometres of their heights.
            *place->second = value.get<double>() * (name == "lambda" ? 1000. : 1.);
            continue;
        }
        const std::string wanted = model.number == 5 && name == "k" ? "kd"
                                   : ours.contains(name)            ? ours.at(name)
                                                                    : name;
        const auto found = std::find_if(model.parameters.begin(), model.parameters.end(),
                                        [&](const Parameter& p) { return p.name == wanted; });
        if (found == model.parameters.end())
            throw InputError(fmt::format("{} has no parameter '{}'", model.name, name));
        values.set(model, std::size_t(found - model.parameters.begin()),
                   value.is_string()
                       ? find_choice(model.name, *found, words.at(value.get<std::string>()))
                       : value.get<double>());
    }
    if (model.part != Part::transparency) return {{"value", intensity(model, values, at)}};
    const double kt = transmittance(model, values, at.wo);
    return {{"value", model.number == 21 ? blend(kt, own, behind) : kt}};
}

}  // namespace

std::optional<AnsweredGroup> function_of_group(const std::string& name) {
    static const std::map<std::string, AnsweredGroup> functions = {
        {"fresnel_dielectric", {"Fresnel", dielectric}},
        {"fresnel_conductor", {"Fresnel", conductor}},
        {"fresnel_schlick", {"Fresnel (Schlick)", schlick_fresnel}},
        {"ndf", {"facets", distributions}},
        {"beta_conversion", {"facets", half_height}},
        {"masking", {"masking", masking}},
        {"schlick_factors", {"schlick", schlick_factors}},
        {"hall_plate", {"transparency", plate}},
        {"he_internals", {"he_torrance", he_torrance_parts}},
        {"photometry_planck", {"photometry", black_body}},
        {"fon_albedo", {"eon", fujii_albedo}}};
    if (const auto known = functions.find(name); known != functions.end()) return known->second;
    for (const illumination::Description* model : illumination::models())
        if (name == fmt::format("m{:02}", model->number))
            return AnsweredGroup{std::string(model->name),
                                 [model](const json& v) { return illuminate(*model, v); }};
    return std::nullopt;
}

}  // namespace nacre
