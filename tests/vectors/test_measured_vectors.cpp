// Reference vectors that are no BRDFs of the list: measured files, matrices, parts of models.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/measured/half_angle.h"
#include "nacre/spectrum/photometry.h"
#include "nacre/spectrum/planck.h"
#include "nacre/vectors/check.h"
#include "nacre/vectors/functions.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using nlohmann::json;

std::map<std::string, double> answers(const char* group, const json& params) {
    return function_of_group(group)->answer({{"params", params}});
}

/// A file with a MERL and a SVD vector whose numbers have closed forms.
json measured_file() {
    // theta_h = 0.3: node floor(90 sqrt(0.3/(pi/2))) = 39; theta_d = 0.5: 28; phi_d = 1: 57.
    const DirectionPair w =
        from_half_angle({.theta_h = 0.3, .phi_h = 0.7, .theta_d = 0.5, .phi_d = 1.});
    const auto list = [](const Vec3d& v) { return json{v.x, v.y, v.z}; };
    const int place = 57 + 180 * 28 + 16200 * 39;
    json all{{"models", json::object()}};
    all["merl"] = {{"scale", {1. / 1500., 1.15 / 1500., 1.66 / 1500.}},
                   {"dims", {90, 90, 180}},
                   {"vectors",
                    {{{"id", "merl-1"},
                      {"wi", list(w.wi)},
                      {"wo", list(w.wo)},
                      {"theta_h", 0.3},
                      {"phi_h", 0.7},
                      {"theta_d", 0.5},
                      {"phi_d", 1.},
                      {"i_theta_h", 39},
                      {"i_theta_d", 28},
                      {"i_phi_d", 57},
                      {"index", place},
                      {"index_green", place + 1458000},
                      {"index_blue", place + 2916000}}}}};
    // A constant matrix of 16 x 16: one singular value, 16 kd/pi.
    all["svd"]["vectors"] = {{{"id", "svd-1"},
                              {"brdf", "lambert"},
                              {"params", {{"kd", 0.6}}},
                              {"R", 4},
                              {"sigma_1_4", {16. * 0.6 / pi}},
                              {"rel_frobenius_error_J1_J2_J4", json::array()}}};
    return all;
}

VectorReport report_of(const json& all) { return check_vectors(all, "v.json"); }

std::string message_of_vectors(const json& all) {
    try {
        report_of(all);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST(MeasuredVectors, MerlAndSvdAreAnswered) {
    const VectorReport r = report_of(measured_file());
    ASSERT_EQ(r.groups.size(), 2u);
    EXPECT_EQ(r.groups[0].name, "merl");
    EXPECT_EQ(r.groups[0].count, 6 + 10);
    EXPECT_EQ(r.groups[1].name, "svd");
    EXPECT_EQ(r.groups[1].count, 1);
    EXPECT_TRUE(r.good()) << r.groups[0].worst << r.groups[1].worst;
    for (const std::string& o : r.not_covered) EXPECT_TRUE(o.starts_with("svd.")) << o;
}

TEST(MeasuredVectors, AWrongNumberIsFound) {
    for (const char* place :
         {"/merl/scale/1", "/merl/dims/2", "/merl/vectors/0/phi_h", "/merl/vectors/0/phi_d",
          "/merl/vectors/0/i_theta_h", "/merl/vectors/0/index_green", "/svd/vectors/0/sigma_1_4/0",
          "/svd/vectors/0/params/kd"}) {
        json wrong = measured_file();
        json& number = wrong[json::json_pointer(place)];
        number = number.is_number_integer() ? json(number.get<int>() + 1)
                                            : json(number.get<double>() * (1. + 1e-5));
        EXPECT_FALSE(report_of(wrong).good()) << place;
    }
}

TEST(MeasuredVectors, WrongFiles) {
    json all = measured_file();
    all["merl"].erase("vectors");
    EXPECT_TRUE(message_of_vectors(all).starts_with("group 'merl' of 'v.json': "))
        << message_of_vectors(all);
    all = measured_file();
    all["svd"]["vectors"][0].erase("R");
    EXPECT_TRUE(message_of_vectors(all).starts_with("group 'svd' of 'v.json': "))
        << message_of_vectors(all);
    all = measured_file();
    all["svd"]["vectors"][0]["brdf"] = "wrad";
    EXPECT_EQ(message_of_vectors(all), "svd vectors: there is no model of a group 'wrad'");
    all["svd"]["vectors"][0]["brdf"] = "lambert";
    all["svd"]["vectors"][0]["R"] = 100;
    EXPECT_EQ(message_of_vectors(all),
              "textures of 100 x 100 texels: the side must lie within 2 to 64");
}

// All groups and values of the reference file.
TEST(MeasuredVectors, NothingOfTheReferenceFileIsLeftOut) {
    const std::string path = NACRE_SHARED_DIR "/reference/reflectance_vectors.json";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared reference data";
    std::ifstream file(path);
    const VectorReport r = check_vectors(json::parse(file), path);
    EXPECT_TRUE(r.not_covered.empty()) << r.not_covered.front();
    EXPECT_TRUE(r.good());
    for (const VectorGroup& g : r.groups) EXPECT_TRUE(g.good) << g.name << " at " << g.worst;
    EXPECT_EQ(r.groups.size(), 71u);
}

// Where both directions are the normal: nothing is hidden, v = 2 n, g = (4 pi sigma0/lambda)^2,
// F = ((n - 1)/(n + 1))^2, and v has no part across the normal.
TEST(MeasuredVectors, HeTorranceAlongTheNormal) {
    const double sigma0 = 0.05, tau = 1., lambda = 0.55;
    const auto a = answers("he_internals", {{"sigma0", sigma0},
                                            {"tau", tau},
                                            {"lambda", lambda},
                                            {"n", 1.5},
                                            {"k", 0.},
                                            {"theta_i_deg", 0.},
                                            {"theta_o_deg", 0.},
                                            {"dphi_deg", 120.}});
    const double g = std::pow(4. * pi * sigma0 / lambda, 2.);
    EXPECT_NEAR(a.at("F"), 0.04, 1e-12);
    EXPECT_NEAR(a.at("S"), 1., 1e-12);
    EXPECT_NEAR(a.at("G"), 4., 1e-12);
    EXPECT_NEAR(a.at("g"), g, 1e-12 * g);
    EXPECT_NEAR(a.at("sigma"), sigma0, 1e-12);
    EXPECT_NEAR(a.at("rho_specular_wi"), 0.04 * std::exp(-g), 1e-12);
    double sum = 0., term = std::exp(-g);
    for (int m = 1; m < 40; ++m) sum += (term *= g / m) / m;
    const double d = std::pow(pi * tau / lambda, 2.) / 4. * sum;
    EXPECT_NEAR(a.at("D"), d, 1e-9 * d);
}

// Schlick's equation 65 as printed, and with the exponential that it lacks.
TEST(MeasuredVectors, SchlicksEquation65) {
    for (const auto& [ti, to, m] : {std::array{30., 60., 0.3}, {75., 10., 0.5}, {80., 84., 0.15}}) {
        const auto a = answers(
            "masking", {{"theta_i_deg", ti}, {"theta_o_deg", to}, {"dphi_deg", 50.}, {"m", m}});
        double printed = 1., exact = 1.;
        for (const double degrees : {ti, to}) {
            const double v = std::cos(degrees * pi / 180.);
            const double h = v * v / (2. * m * m * (1. - v * v));
            const double g = std::sqrt(pi * h) * (2. - std::erfc(std::sqrt(h)));
            printed *= g / (g + 1.);
            exact *= g / (g + std::exp(-h));
        }
        EXPECT_NEAR(a.at("schlick_eq65"), printed, 1e-9);
        EXPECT_NEAR(a.at("smith_S_eq65_with_exp"), exact, 1e-9);
    }
}

// Over all wavelengths a black body has Stefan's and Boltzmann's radiance; by the eye's sensitivity
// the luminance that spectra have.
TEST(MeasuredVectors, BlackBodies) {
    for (const double kelvin : {2042., 6500.}) {
        double sum = 0.;
        for (double nm = 20.; nm < 400000.; nm *= 1.001)
            sum += 0.001 * nm * planck_radiance(nm, kelvin);
        const double all = 5.670374419e-8 * std::pow(kelvin, 4.) / pi;
        EXPECT_NEAR(sum, all, 2e-3 * all);
        const auto a = answers("photometry_planck", {{"T", kelvin}});
        const SpectrumPtr body = make_blackbody(float(kelvin));
        EXPECT_NEAR(a.at("L_photopic"), luminance(*body), 2e-3 * luminance(*body));
        EXPECT_NEAR(a.at("L_scotopic"), scotopic_luminance(*body),
                    2e-3 * scotopic_luminance(*body));
    }
    // The candela until 1979: platinum that freezes has 60 cd/cm^2.
    EXPECT_NEAR(answers("photometry_planck", {{"T", 2042.}}).at("L_photopic"), 6e5, 0.01 * 6e5);
}

}  // namespace nacre
