// Facets: distributions, masking, Fresnel factors, half-height angles, and the conventions of the
// literature, against reference values and identities.
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/cook_torrance.h"
#include "nacre/reflectance/schlick_ct.h"
#include "tests/reflectance/family_data.h"

namespace nacre {
namespace {

using test::at_degrees;
using test::ScalarVector;

constexpr FacetDistribution distributions[] = {FacetDistribution::beckmann,
                                               FacetDistribution::gauss, FacetDistribution::phong,
                                               FacetDistribution::trowbridge_reitz};

double density(FacetDistribution kind, double theta, double m) {
    const double tan = std::tan(theta);
    return facet_detail::facet_density(kind, tan * tan, m, facet_detail::gauss_constant(m));
}

}  // namespace

TEST(Facets, DistributionsAgreeWithTheReference) {
    test::for_each_scalar("ndf", [](const ScalarVector& v) {
        const double theta = v("theta_deg") * std::numbers::pi / 180., m = v("m");
        v.expect(density(FacetDistribution::beckmann, theta, m), "beckmann");
        v.expect(density(FacetDistribution::trowbridge_reitz, theta, m), "trowbridge_reitz");
        v.expect(density(FacetDistribution::gauss, theta, m), "gauss");
        v.expect(facet_detail::gauss_constant(m), "gauss_C");
        v.expect(0.25 * density(FacetDistribution::beckmann, theta, m), "hall_beckmann");
        v.expect(density(FacetDistribution::phong, theta, v("c")), "phong_c");
        SchlickCt<double> schlick{};
        schlick.m = m;
        v.expect(schlick.density(at_degrees(v("theta_deg"))), "schlick_D");
    });
}

TEST(Facets, DistributionsProjectToTheWholeSurface) {
    const GaussLegendre nodes(200);
    for (const FacetDistribution kind : distributions)
        for (double m : {0.1, 0.4, 1.}) {
            const double width = kind == FacetDistribution::phong ? 2. / (m * m) : m;
            const double all = nodes.integrate(0., std::numbers::pi / 2, [&](double theta) {
                return density(kind, theta, width) * 2. * std::numbers::pi * std::sin(theta) *
                       std::cos(theta);
            });
            EXPECT_NEAR(all, 1., 1e-9) << int(kind) << " " << m;
        }
}

TEST(Facets, SampledNormalsHaveTheDensityOfTheirTangent) {
    // The share of samples below a tangent is the integral of the density up to it.
    const GaussLegendre nodes(100);
    for (const FacetDistribution kind : distributions)
        for (double u : {0.05, 0.4, 0.9}) {
            const double m = kind == FacetDistribution::phong ? 30. : 0.35;
            const double constant = facet_detail::gauss_constant(m);
            const double end = std::atan(facet_detail::sample_tangent(kind, u, m));
            const double share = nodes.integrate(0., end, [&](double theta) {
                const double tan = std::tan(theta);
                return facet_detail::normal_density(kind, tan * tan, m, constant) * 2. *
                       std::numbers::pi * std::sin(theta);
            });
            EXPECT_NEAR(share, u, 1e-10) << int(kind);
        }
}

TEST(Facets, MaskingAgreesWithTheReference) {
    test::for_each_scalar("masking", [](const ScalarVector& v) {
        const Vec3d wi = v.wi(), wo = v.wo();
        const double m = v("m");
        v.expect(facet_detail::v_cavity(wi, wo), "vcavity");
        const double ti = m * facet_detail::bounded_tangent(wi);
        const double to = m * facet_detail::bounded_tangent(wo);
        const double bi = facet_detail::lambda_beckmann(ti), bo = facet_detail::lambda_beckmann(to);
        v.expect(1. / (1. + bi + bo), "sancer");
        v.expect(1. / ((1. + bi) * (1. + bo)), "smith_beckmann_sep");
        const double gi = facet_detail::lambda_trowbridge_reitz(ti),
                     go = facet_detail::lambda_trowbridge_reitz(to);
        v.expect(1. / (1. + gi + go), "smith_ggx_corr");
        v.expect(1. / ((1. + gi) * (1. + go)), "smith_ggx_sep");
        const double k = std::sqrt(2. * m * m / std::numbers::pi);
        v.expect(schlick_masking(wi.z, k) * schlick_masking(wo.z, k), "schlick");
    });
}

TEST(Facets, FresnelFormsAgreeWithTheReference) {
    FacetFresnel<double, double> f{};
    test::for_each_scalar("fresnel_dielectric", [&](const ScalarVector& v) {
        f.form = FresnelForm::dielectric;
        f.n = v("n");
        v.expect(f.at(v("c")), "R");
    });
    test::for_each_scalar("fresnel_conductor", [&](const ScalarVector& v) {
        f.form = FresnelForm::conductor;
        f.n = v("n");
        f.k = v("k");
        for (const auto& [share, name] :
             {std::pair{0., "Rs"}, {1., "Rp"}, {0.5, "F_unpolarised"}, {v("h"), "F"}}) {
            f.parallel = share;
            v.expect(f.at(v("c")), name);
        }
    });
    test::for_each_scalar("fresnel_schlick", [&](const ScalarVector& v) {
        f.f0 = v("f0");
        f.form = FresnelForm::schlick;
        v.expect(f.at(v("c")), "F");
        f.form = FresnelForm::power4;
        v.expect(f.at(v("c")), "seed002_pow4");
        f.form = FresnelForm::dielectric_f0;
        EXPECT_NEAR(f.at(1.), f.f0, 1e-12);
        EXPECT_NEAR(f.at(v("c")), fresnel_dielectric(v("c"), double(v.json["values"]["n_from_f0"])),
                    1e-9);
    });
    f.form = FresnelForm::one;
    EXPECT_EQ(f.at(0.3), 1.);
}

TEST(Facets, HalfHeightAnglesAgreeWithTheReference) {
    test::for_each_scalar("beta_conversion", [](const ScalarVector& v) {
        const double beta = v("beta_deg") * std::numbers::pi / 180.;
        v.expect(width_of_half_height(FacetDistribution::phong, beta), "Ns");
        v.expect(1. / (std::numbers::sqrt2 * width_of_half_height(FacetDistribution::gauss, beta)),
                 "C1");
        v.expect(width_of_half_height(FacetDistribution::trowbridge_reitz, beta), "C2");
        v.expect(width_of_half_height(FacetDistribution::beckmann, beta), "m");
        v.expect(width_unclipped(beta), "m_seed_alternative");
        for (const FacetDistribution kind : distributions) {
            const double m = width_of_half_height(kind, beta);
            EXPECT_NEAR(density(kind, beta, m), 0.5 * density(kind, 0., m),
                        1e-9 * density(kind, 0., m));
        }
    });
}

TEST(CookTorrance, TheHalfHeightAngleStandsForTheWidth) {
    const Vec3d wi = at_degrees(40.), wo = at_degrees(25., 170.);
    const double m =
        width_of_half_height(FacetDistribution::beckmann, 15. * std::numbers::pi / 180.);
    EXPECT_DOUBLE_EQ(
        make_model("cook_torrance", parse_settings("width=half_height beta=15 m=0.9")).eval(wi, wo),
        make_model("cook_torrance", {{"m", m}}).eval(wi, wo));
    const double other = width_unclipped(15. * std::numbers::pi / 180.);
    EXPECT_DOUBLE_EQ(
        make_model("cook_torrance", parse_settings("width=unclipped beta=15")).eval(wi, wo),
        make_model("cook_torrance", {{"m", other}}).eval(wi, wo));
}

TEST(CookTorrance, FormsInPrintAreAvailable) {
    int count = 0;
    for (const auto& v : test::family_data()["as_printed"]["cook_torrance_beckmann"]) {
        Settings settings = parse_settings("convention=m2_over_pi");
        for (const auto& [name, value] : v["params"].items())
            settings.push_back({name, value.is_string() ? SettingValue(value.get<std::string>())
                                                        : SettingValue(value.get<double>())});
        const AnyModel model(find_evaluator("cook_torrance"), settings, Bounds::ranges_only);
        const Vec3d wi{v["wi"][0], v["wi"][1], v["wi"][2]}, wo{v["wo"][0], v["wo"][1], v["wo"][2]};
        const double expected = v["value"];
        EXPECT_NEAR(model.eval(wi, wo), expected, 1e-9 * expected) << v["id"];
        ++count;
    }
    EXPECT_GE(count, 10);
    const auto at = [](const char* text) {
        return make_model("cook_torrance", parse_settings(text))
            .eval(at_degrees(40.), at_degrees(35., 170.));
    };
    EXPECT_NEAR(at("kd=0 convention=four_m2") / at("kd=0"), std::numbers::pi, 1e-12);
}

TEST(CookTorrance, WithTheGaussianItIsTorranceSparrow) {
    const Vec3d wi = at_degrees(50.), wo = at_degrees(60., 150.);
    EXPECT_NEAR(
        make_model("cook_torrance", parse_settings("distribution=gauss m=0.3")).eval(wi, wo),
        make_model("torrance_sparrow", parse_settings("m=0.3")).eval(wi, wo), 1e-14);
    // With the peak 1: D(0) is the normalised constant.
    const auto at_mirror = [](const char* text) {
        return make_model("torrance_sparrow", parse_settings(text))
            .eval(at_degrees(30.), at_degrees(30., 180.));
    };
    EXPECT_NEAR(at_mirror("kd=0 m=0.3") / at_mirror("kd=0 m=0.3 convention=peak"),
                facet_detail::gauss_constant(0.3), 1e-10);
}

TEST(CookTorrance, SeveralTermsAreTheirWeightedSum) {
    const Vec3d wi = at_degrees(50.), wo = at_degrees(60., 150.);
    for (const char* kind : {"beckmann", "gauss", "trowbridge_reitz"}) {
        const auto at = [&](const char* text) {
            return make_model("cook_torrance",
                              parse_settings(fmt::format("kd=0 distribution={} {}", kind, text)))
                .eval(wi, wo);
        };
        EXPECT_NEAR(at("terms=3 m=0.2 m2=0.4 m3=0.6 w1=0.2 w2=0.3 w3=0.5"),
                    0.2 * at("m=0.2") + 0.3 * at("m=0.4") + 0.5 * at("m=0.6"), 1e-12);
        // Weights are relative.
        EXPECT_NEAR(at("terms=2 m=0.2 m2=0.4 w1=0.1 w2=0.3"),
                    0.25 * at("m=0.2") + 0.75 * at("m=0.4"), 1e-12);
    }
    EXPECT_EQ(make_model("cook_torrance", parse_settings("kd=0 terms=2 w1=0 w2=0")).eval(wi, wo),
              0.);
}

TEST(CookTorrance, SmithOfASumIsTheSumOfLambdas) {
    // Smith's Lambda is linear in the distribution of slopes: the weak furnace holds for the sum.
    CookTorrance<double> model{};
    model.masking = FacetMasking::smith;
    model.fresnel.form = FresnelForm::one;
    model.ks = 1.;
    model.m[0] = 0.2;
    model.m[1] = 0.7;
    model.terms = 2;
    model.weight[0] = 0.3;
    model.weight[1] = 0.7;
    model.prepare();
    const Vec3d w = at_degrees(65.);
    const GaussLegendre nodes(150);
    const double g1 =
        1. /
        (1. + 0.3 * facet_detail::lambda_beckmann(0.2 * std::tan(65. * std::numbers::pi / 180.)) +
         0.7 * facet_detail::lambda_beckmann(0.7 * std::tan(65. * std::numbers::pi / 180.)));
    const double seen = nodes.integrate(0., std::numbers::pi / 2, [&](double theta) {
        return std::sin(theta) * 2. * nodes.integrate(0., std::numbers::pi, [&](double phi) {
            const Vec3d h{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                          std::cos(theta)};
            const double d = 0.3 * density(FacetDistribution::beckmann, theta, 0.2) +
                             0.7 * density(FacetDistribution::beckmann, theta, 0.7);
            return d * std::max(0., dot(w, h));
        });
    });
    EXPECT_NEAR(g1 * seen, w.z, 2e-5);
    // And the model uses it: D and F = 1 cancel in the ratio to a model without masking.
    CookTorrance<double> open = model;
    open.masking = FacetMasking::none;
    EXPECT_NEAR(model.eval(w, w) / open.eval(w, w), g1 * g1, 1e-12);
}

}  // namespace nacre
