// He-Torrance: its parts against reference values, its limits, polarisation, and the sum.
#include "nacre/reflectance/he_torrance.h"

#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/facets.h"
#include "tests/reflectance/family_data.h"

namespace nacre {
namespace {

using test::at_degrees;
using test::ScalarVector;

/// Lengths and wavelength in micrometres.
HeTorrance<double> surface(double sigma0, double tau, double lambda, double n, double k) {
    HeTorrance<double> m{};
    m.sigma0 = sigma0;
    m.tau = tau;
    m.lambda = 1e3 * lambda;
    m.n = n;
    m.k = k;
    m.parallel = 0.5;
    return m;
}
HeTorrance<double> surface_of(const nlohmann::json& p) {
    return surface(p["sigma0"], p["tau"], p["lambda"], p["n"], p["k"]);
}

/// The sum as it is written, term by term.
double plain_sum(double g, double q) {
    double sum = 0.;
    for (int j = 1; j < g + 20. * std::sqrt(g) + 200.; ++j)
        sum += std::exp(j * std::log(g) - g - std::lgamma(j + 1.) - q / j) / j;
    return sum;
}

}  // namespace

TEST(HeTorrance, PartsAgreeWithTheReference) {
    test::for_each_scalar("he_internals", [](const ScalarVector& v) {
        const HeTorrance<double> m = surface_of(v.json["params"]);
        const Vec3d wi = v.wi(), wo = v.wo(), h = wi + wo;
        v.expect(m.fresnel(wi, wo), "F");
        v.expect(m.facets_seen(wi) * m.facets_seen(wo), "S");
        v.expect(m.phase2(wi, wo), "g");
        v.expect(std::pow(dot(h, h) / h.z, 2.), "G");
        v.expect(m.roughness(wi, wo), "D");
        v.expect(m.effective_deviation(wi, wo), "sigma");
        v.expect(m.mirror(wi), "rho_specular_wi");
    });
    // Smith's shadowing, m = 2 sigma0/tau.
    test::for_each_scalar("masking", [](const ScalarVector& v) {
        const HeTorrance<double> m = surface(v("m"), 2., 0.5, 1.5, 0.);
        v.expect(m.facets_seen(v.wi()) * m.facets_seen(v.wo()), "he_S");
    });
}

TEST(HeTorrance, TheMirrorShareAgreesWithTheReference) {
    for (const auto& row : test::family_data()["mirror"]) {
        const HeTorrance<double> m = surface_of(row["params"]);
        for (const auto& [degrees, share] : row["share"].items())
            EXPECT_NEAR(m.mirror(at_degrees(std::stod(degrees))), share.get<double>(),
                        2e-9 + 1e-8 * share.get<double>())
                << row["params"] << degrees;
    }
}

TEST(HeTorrance, TheFormInPrintIsAvailable) {
    int count = 0;
    for (const auto& v : test::family_data()["as_printed"]["he_torrance"]) {
        HeTorrance<double> m = surface_of(v["params"]);
        m.shadowing = HeShadowing::printed;
        const double expected = v["value"];
        EXPECT_NEAR(
            m.eval({v["wi"][0], v["wi"][1], v["wi"][2]}, {v["wo"][0], v["wo"][1], v["wo"][2]}),
            expected, 1e-9 * expected)
            << v["id"];
        ++count;
    }
    EXPECT_GE(count, 10);
}

TEST(HeTorrance, TheSumIsThatOfItsTerms) {
    for (double g : {1e-3, 0.3, 2., 7., 20., 30., 60., 150., 400., 2000.})
        for (double x : {0., 0.5, 3., 12.}) {
            const double q = x * std::max(1., g), expected = plain_sum(g, q);
            EXPECT_NEAR(poisson_sum(g, q), expected, 1e-9 * expected) << g << " " << x;
            EXPECT_NEAR(poisson_sum(float(g), float(q)), expected, 2e-5 * expected)
                << g << " " << x;
            // The way of dual numbers, and its slopes against differences.
            const PoissonSum sum = poisson_sum_with_slopes(g, q);
            EXPECT_NEAR(sum.value, expected, 1e-9 * expected) << g << " " << x;
            const double e = 1e-4 * g, d = 1e-4 * std::max(q, 1.);
            EXPECT_NEAR(sum.by_g, (plain_sum(g + e, q) - plain_sum(g - e, q)) / (2. * e),
                        1e-6 * std::abs(sum.by_g) + 1e-7 * expected)
                << g << " " << x;
            EXPECT_NEAR(sum.by_q, (plain_sum(g, q + d) - plain_sum(g, q - d)) / (2. * d),
                        1e-6 * std::abs(sum.by_q))
                << g << " " << x;
        }
    // Lanes of different g share the terms.
    const Spectral lanes = poisson_sum(Spectral(0.1f, 4.f, 80.f, 900.f), Spectral(1.f));
    const float g[] = {0.1f, 4.f, 80.f, 900.f};
    for (int i = 0; i < 4; ++i) {
        const double expected = plain_sum(double(g[i]), 1.);
        EXPECT_NEAR(lanes[i], expected, 2e-5 * expected);
    }
}

TEST(HeTorrance, RoughSurfacesAreBeckmannsFacets) {
    // The reference's limit: sigma0 = 5, tau = 25 at 0.55 um, slope 0.4.
    const HeTorrance<double> m = surface(5., 25., 0.55, 1.5, 0.);
    const Vec3d wi = at_degrees(40.), wo = at_degrees(30., 2.6 * 180. / std::numbers::pi);
    const Vec3d h = wi + wo;
    const double beckmann = facet_detail::facet_density(FacetDistribution::beckmann,
                                                        facet_detail::tangent2(h), 0.4, 0.);
    const double g = std::pow(dot(h, h) / h.z, 2.);
    EXPECT_NEAR(g * m.roughness(wi, wo) / std::numbers::pi / (0.25 * beckmann), 1.00005838557,
                1e-9);
}

TEST(HeTorrance, SmoothSurfacesAreMirrors) {
    const HeTorrance<double> m = surface(0.001, 1., 0.55, 0.2, 3.4);
    const Vec3d w = at_degrees(20.);
    EXPECT_NEAR(m.mirror(w), fresnel_conductor(w.z, 0.2, 3.4), 2e-3);
    EXPECT_LT(m.eval(w, at_degrees(40., 130.)), 1e-3);
}

TEST(HeTorrance, MirrorAndDiffuseReflectWhatTheFacetsDo) {
    // Perfect facets (n + ik with k large) lose nothing at normal incidence, to the 2e-4 of the
    // reference: 0.7290 + 0.2712 and 1.0001.
    for (const auto& [sigma0, tau] : {std::pair{0.05, 1.}, {0.2, 2.}}) {
        const AnyModel model =
            make_model("he_torrance", {{"sigma0", sigma0}, {"tau", tau}, {"n", 1e-6}, {"k", 20.}});
        const Vec3d w{0., 0., 1.};
        EXPECT_NEAR(directional_albedo(model, w).value + model.mirror(w), 1., 3e-4);
    }
}

TEST(HeTorrance, LongerWavesSeeASmootherSurface) {
    const AnyModel model = make_model("he_torrance", parse_settings("sigma0=0.1 tau=2"));
    const Vec3d w = at_degrees(30.);
    EXPECT_GT(model.mirror(w, 700.), 5. * model.mirror(w, 450.));
    // Only ratios of lengths to the wavelength matter.
    const AnyModel twice = make_model("he_torrance", parse_settings("sigma0=0.2 tau=4"));
    const Vec3d wo = at_degrees(50., 140.);
    EXPECT_NEAR(twice.eval(w, wo, 1000.), model.eval(w, wo, 500.), 1e-12);
    // Each lane has its own wavelength.
    const Spectral four =
        model.eval(Vec3f(w), Vec3f(wo), Wavelengths::at({400.f, 500.f, 600.f, 700.f}));
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(four[i], model.eval(w, wo, 400. + 100. * i), 1e-4 * four[i]) << i;
}

TEST(HeTorrance, PolarisedLightKeepsItsPlaneWhereThatIsTheFacets) {
    HeTorrance<double> m = surface(0.2, 2., 0.55, 1.5, 0.3);
    const Vec3d wi = at_degrees(60.), in_plane = at_degrees(40., 180.);
    const Vec3d h = normalize(wi + in_plane);
    const auto r = fresnel_conductor_polarised(dot(wi, h), 1.5, 0.3);
    for (double share : {0., 0.3, 1.}) {
        m.parallel = share;
        EXPECT_NEAR(m.fresnel(wi, in_plane), share * r.p + (1. - share) * r.s, 1e-12);
    }
    // Out of the plane of incidence s and p mix; both together are natural light everywhere.
    const Vec3d aside = at_degrees(40., 100.);
    m.parallel = 0.;
    const double s = m.fresnel(wi, aside);
    m.parallel = 1.;
    const double p = m.fresnel(wi, aside);
    m.parallel = 0.5;
    EXPECT_NEAR(0.5 * (s + p), m.fresnel(wi, aside), 1e-12);
    EXPECT_NEAR(m.fresnel(wi, aside), fresnel_conductor(dot(wi, normalize(wi + aside)), 1.5, 0.3),
                1e-12);
    // The facet's own axes, from vectors: s of the light on s of the facet.
    const Vec3d facet_s = normalize(cross(wi, aside)), light_s{0., 1., 0.};
    const double kept = std::pow(dot(facet_s, light_s), 2.);
    const auto f = fresnel_conductor_polarised(dot(wi, normalize(wi + aside)), 1.5, 0.3);
    EXPECT_NEAR(s, kept * f.s + (1. - kept) * f.p, 1e-12);
}

}  // namespace nacre
