// Scattering vectors of the diffusion profiles.
#include <fmt/format.h>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/chiang2016.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/bssrdf/dipole_triangle.h"
#include "nacre/bssrdf/directional_dipole.h"
#include "nacre/bssrdf/normalised_diffusion.h"
#include "nacre/bssrdf/photon_beam_diffusion.h"
#include "nacre/vectors/file.h"
#include "nacre/vectors/scattering.h"

namespace nacre {
namespace {

using nlohmann::json;

/// Compares f(x) with the list `key` of a row, over the list `over`.
template <class F>
void compare_list(const std::string& where, const json& row, const char* over, const char* key,
                  Comparison& result, F&& f) {
    for (std::size_t i = 0; i < row.at(over).size(); ++i) {
        const double x = row[over][i];
        result.add(fmt::format("{} {} at {} = {:g}", where, key, over, x), f(x), row.at(key)[i]);
    }
}

std::string name_of(const json& row) {
    return fmt::format("sigma_s' {:g} sigma_a {:g} eta {:g}", row.at("sigma_s_prime").get<double>(),
                       row.at("sigma_a").get<double>(), row.at("eta").get<double>());
}

}  // namespace

void compare_dipole(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double eta = row.at("eta");
        const Dipole<double> dipole(row.at("sigma_s_prime"), row.at("sigma_a"), eta);
        const std::string where =
            fmt::format("{} {}", row.value("material", name_of(row)), row.value("channel", ""));
        const auto add = [&](const char* key, double value) {
            result.add(where + " " + key, value, row.at(key));
        };
        add("alpha_prime", dipole.albedo);
        add("sigma_tr", dipole.sigma_tr);
        add("A", boundary_parameter(eta, BoundaryModel::fit));
        add("zr", dipole.z_r);
        add("zv", dipole.z_v);
        add("Rd_total", dipole.total());
        compare_list(where, row, "r", "Rd", result, [&](double r) { return dipole.eval(r * r); });
        compare_list(where, row, "r", "Rd_cumulative", result,
                     [&](double r) { return dipole.cumulative(r * r); });
        compare_list(where, row, "r_of_xi", "xi", result,
                     [&](double r) { return dipole.cumulative(r * r) / dipole.total(); });
    }
}

void compare_better_dipole(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double eta = row.at("eta");
        const MomentModel moments =
            row.at("moments") == "fit" ? MomentModel::fit : MomentModel::exact;
        const BoundaryMoments boundary(eta, moments);
        const BetterDipole<double> dipole(row.at("sigma_s_prime"), row.at("sigma_a"), eta, moments);
        const std::string where = name_of(row) + " " + row["moments"].get<std::string>();
        const auto add = [&](const char* key, double value) {
            result.add(where + " " + key, value, row.at(key));
        };
        add("D", dipole.diffusion);
        add("sigma_tr", dipole.sigma_tr);
        add("A", boundary.a);
        add("Cphi", dipole.c_phi);
        add("CE", dipole.c_e);
        add("zr", dipole.z_r);
        add("zv", dipole.z_v);
        add("R_total", dipole.total());
        compare_list(where, row, "r", "R", result, [&](double r) { return dipole.eval(r * r); });
    }
}

void compare_photon_beam(const json& group, Comparison& result) {
    for (const json& row : group) {
        const ProfileMedium m{row.at("sigma_s"), row.at("sigma_a"), row.at("g"), row.at("eta")};
        check(m);
        const PhotonBeamDiffusion with(m), without(m, false);
        const BeamSingleScattering single(m);
        const std::string where = fmt::format("sigma_s {:g} g {:g}", m.sigma_s, m.g);
        const auto compare = [&](const char* key, const auto& profile) {
            compare_list(where, row, "r", key, result, [&](double r) { return profile.eval(r); });
        };
        compare("ms_kappa", with);
        compare("ms_nokappa", without);
        compare("single", single);
    }
}

void compare_directional_dipole(const json& group, Comparison& result) {
    int number = 0;
    for (const json& row : group) {
        const DirectionalDipole<double> dipole(row.at("ss"), row.at("sa"), row.at("g"), row.at("n"),
                                               {.clamp = false});
        const auto vector = [&](const char* key) { return direction_of(row.at(key)); };
        const double value = dipole.eval({vector("xi"), vector("ni"), vector("wi")},
                                         {vector("xo"), vector("no"), vector("no")});
        result.add(fmt::format("row {}", number++), value, row.at("S_d"));
    }
}

void compare_normalised_diffusion(const json& group, Comparison& result) {
    using Fit = NormalisedDiffusionFit;
    for (const json& row : group) {
        const double a = row.at("A");
        const NormalisedDiffusion<double> model(a, row.at("mfp").get<double>());
        const std::string where = fmt::format("A = {:g}", a);
        const auto add = [&](const char* key, double value) {
            result.add(where + " " + key, value, row.at(key));
        };
        add("s_searchlight", normalised_diffusion_scale(a, Fit::searchlight));
        add("s_diffuse", normalised_diffusion_scale(a, Fit::diffuse));
        add("s_dmfp", normalised_diffusion_scale(a, Fit::diffuse_free_path));
        add("d_searchlight", model.d);
        compare_list(where, row, "r", "R_searchlight", result,
                     [&](double r) { return model.eval(r); });
        compare_list(where, row, "r", "cdf", result,
                     [&](double r) { return model.cumulative(r) / a; });
        compare_list(where, row, "xi", "r_of_xi", result,
                     [&](double xi) { return model.sample(xi); });
    }
}

void compare_chiang(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double a = row.at("A"), d = row.at("d");
        const auto medium = chiang2016_medium(a, d);
        const auto add = [&](const char* key, double value) {
            result.add(fmt::format("A = {:g}, d = {:g} {}", a, d, key), value, row.at(key));
        };
        add("alpha", chiang2016_single_albedo(a));
        add("s", normalised_diffusion_scale(a, NormalisedDiffusionFit::diffuse));
        add("sigma_t", medium.sigma_t);
        add("sigma_s", medium.sigma_s);
    }
}

void compare_triangle(const json& group, Comparison& result) {
    const GaussLegendre rule(16);
    int number = 0;
    for (const json& row : group) {
        const Dipole<double> dipole(row.at("sigma_s_prime"), row.at("sigma_a"), row.at("eta"));
        std::array<Vec3d, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const json& xy = row.at("triangle_xy").at(i);
            corners[i] = {xy.at(0).get<double>(), xy.at(1).get<double>(),
                          row.at("plane_height").get<double>()};
        }
        result.add(fmt::format("row {}", number++),
                   dipole_triangle_integral(dipole, Vec3d{0., 0., 0.}, corners, rule),
                   row.at("integral"));
    }
}

}  // namespace nacre
