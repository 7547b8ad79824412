// Scattering vectors of phase functions, Fresnel reflection, tissue and measured media.
#include <fmt/format.h>

#include "nacre/math/error.h"
#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/optics/media.h"
#include "nacre/optics/phase.h"
#include "nacre/optics/tissue.h"
#include "nacre/vectors/scattering.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

/// Value and integrals of one phase function.
template <class Phase>
void compare_function(const Phase& p, const std::string& where, const json& row,
                      Comparison& result) {
    for (std::size_t i = 0; i < row.at("value").size(); ++i)
        result.add(fmt::format("{} {}", where, i), p.eval(row.at("cos_theta")[i].get<double>()),
                   row["value"][i]);
    // Enough nodes for the peak of Henyey and Greenstein at g = 0.9: 0.9^(2 n) < 1e-16.
    static const GaussLegendre rule(200);
    const auto share = [&](double from, double to) {
        return 2. * pi * rule.integrate(from, to, [&](double c) { return p.eval(c); });
    };
    result.add(where + " mean_cosine", p.mean_cosine(), row.at("mean_cosine"));
    if (row.contains("norm_over_sphere"))
        result.add(where + " norm_over_sphere", share(-1., 1.), row["norm_over_sphere"]);
    if (row.contains("backward_fraction"))
        result.add(where + " backward_fraction", share(-1., 0.), row["backward_fraction"]);
}

void compare_named(const json& row, Comparison& result) {
    const std::string name = row.at("name");
    const double parameter = row.at("param");
    const std::string where = fmt::format("{} {:g}", name, parameter);
    const auto compare = [&](const auto& p) { compare_function(p, where, row, result); };
    if (name == "rayleigh") return compare(RayleighPhase<double>{});
    if (name == "mie_hazy") return compare(MiePhase<double>::hazy());
    if (name == "mie_murky") return compare(MiePhase<double>::murky());
    if (name == "mie_murky_33") return compare(MiePhase<double>::murky_33());
    if (name == "hg") return compare(HenyeyGreensteinPhase<double>{parameter});
    if (name == "schlick") return compare(SchlickPhase<double>{parameter});
    if (name == "cornette_shanks") return compare(CornetteShanksPhase<double>{parameter});
    throw InputError(fmt::format("phase vectors: unknown function '{}'", name));
}

}  // namespace

void compare_phase(const json& group, Comparison& result) {
    for (const json& row : group.value("functions", json::array())) compare_named(row, result);
    for (const json& row : group.value("two_term_hg", json::array()))
        compare_function(TwoTermHenyeyGreensteinPhase<double>{row.at("weight_first"), row.at("g1"),
                                                              row.at("g2")},
                         "two_term_hg", row, result);
    for (const json& row : group.value("hg_sampling_cdf_increasing_in_xi", json::array())) {
        const double g = row.at("g");
        for (std::size_t i = 0; i < row.at("xi").size(); ++i)
            result.add(fmt::format("sampling of hg {:g} at xi = {}", g, row["xi"][i].dump()),
                       HenyeyGreensteinPhase<double>{g}.sample_cos(row["xi"][i].get<double>()),
                       row.at("cos_theta")[i]);
    }
}

void compare_fresnel(const json& group, Comparison& result) {
    for (const json& row : group.value("directional", json::array())) {
        const double n = row.at("n");
        for (std::size_t i = 0; i < row.at("theta_deg").size(); ++i) {
            const double angle = row["theta_deg"][i], c = std::cos(angle * pi / 180.);
            const auto where = [&](const char* side) {
                return fmt::format("n = {:g}, {:g} degrees, {}", n, angle, side);
            };
            result.add(where("outside"), fresnel_dielectric(c, n), row.at("R_outside")[i]);
            result.add(where("inside"), fresnel_dielectric(c, 1. / n), row.at("R_inside")[i]);
        }
        result.add(fmt::format("n = {:g} normal_R", n), normal_reflectance(n), row.at("normal_R"));
    }
    for (const json& row : group.value("diffuse", json::array())) {
        const double eta = row.at("eta");
        const auto add = [&](const char* key, double value) {
            if (row.contains(key))
                result.add(fmt::format("eta = {:g} {}", eta, key), value, row[key]);
        };
        add("Fdr_fit", diffuse_reflectance_fit(eta));
        add("two_C1_fit", two_c1_fit(eta));
        add("three_C2_fit", three_c2_fit(eta));
        add("two_C1_exact", 2. * fresnel_moment(1, eta));
        add("three_C2_exact", 3. * fresnel_moment(2, eta));
        add("Fdr_internal_exact", diffuse_reflectance_internal(eta));
        // Always for light that enters the denser side.
        add("Fdr_external_exact", diffuse_reflectance_external(std::max(eta, 1. / eta)));
        // At equal indices ours is 1, which the fit misses.
        if (eta != 1.) add("A_fit", boundary_parameter(eta, BoundaryModel::fit));
        add("A_exact", boundary_parameter(eta, BoundaryModel::exact));
        add("A_robin_two_moment_exact", boundary_parameter(eta, BoundaryModel::two_moment));
    }
}

void compare_skin(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double nm = row.at("wavelength_nm"), melanin = row.at("f_mel");
        const double blood = row.at("f_blood"), oxygen = row.at("sat");
        const auto add = [&](const char* key, double value) {
            result.add(fmt::format("{:g} nm, melanin {:g} {}", nm, melanin, key), value,
                       row.at(key));
        };
        constexpr double cm = 10.;  // mm^-1 to cm^-1
        add("baseline_cm", cm * baseline_absorption(nm));
        add("melanosome_cm", cm * melanin_absorption(nm));
        add("epidermis_mua_mm", epidermis_absorption(nm, melanin));
        add("blood_mua_cm", cm * blood_absorption(nm, oxygen));
        add("dermis_mua_mm", dermis_absorption(nm, blood, oxygen));
        add("mus_prime_mm", dermis_reduced_scattering(nm));
        add("g_jacques", skin_anisotropy(nm));
    }
}

void compare_materials(const json& group, Comparison& result) {
    for (const auto& [name, row] : group.items()) {
        const MeasuredMedium& m = measured_media().find(name);
        // The table is of floats, and the vectors' decimals are what they were read from.
        const auto add = [&](const std::string& key, float value, const json& expected) {
            result.add(name + " " + key, value, expected.get<float>());
        };
        add("eta", m.eta, row.at("eta"));
        for (std::size_t i = 0; i < 3; ++i) {
            add("sigma_s_prime", m.sigma_s_prime[i], row.at("sigma_s_prime")[i]);
            add("sigma_a", m.sigma_a[i], row.at("sigma_a")[i]);
            add("diffuse_reflectance", m.diffuse_reflectance.value_or(Vec3f{})[i],
                row.at("diffuse_reflectance")[i]);
        }
    }
}

}  // namespace nacre
