// GGX with Smith's masking: the table of albedos, and the white furnace of the compensation.
#include "nacre/math/quadrature.h"
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/ggx_albedo.h"
#include "tests/reflectance/family_data.h"

namespace nacre {

TEST(GgxAlbedo, TheQuadratureAgreesWithTheReference) {
    // The reference's table of ggx_smith with F = 1 and correlated masking, at 0 and 60 degrees.
    EXPECT_NEAR(ggx_albedo_by_quadrature(1., 0.3), 0.877358416, 2e-9);
    EXPECT_NEAR(ggx_albedo_by_quadrature(0.5, 0.3), 0.821711003, 2e-9);
    EXPECT_NEAR(ggx_albedo_by_quadrature(0.5, 0.1), 0.969204984, 2e-9);
    EXPECT_NEAR(ggx_albedo_by_quadrature(0.5, 1.), 0.450693856, 2e-9);
    EXPECT_NEAR(ggx_albedo_by_quadrature(1., 1.), 1. - std::numbers::ln2, 1e-11);
}

TEST(GgxAlbedo, TheSeriesAgreesWithTheQuadrature) {
    for (double alpha : {0.01, 0.03, 0.1, 0.25, 0.5, 0.8, 1., 1.3, 1.5}) {
        const GgxAlbedo<double> albedo(alpha);
        for (double root : {0.005, 0.02, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.}) {
            const double mu = root * root;
            EXPECT_NEAR(albedo(mu, std::sqrt(1. - mu * mu)), ggx_albedo_by_quadrature(mu, alpha),
                        1e-6)
                << alpha << " " << mu;
        }
    }
}

TEST(GgxAlbedo, TheAverageIsItsIntegral) {
    // Over angles, mu dmu = sin cos dtheta, nodes gathered towards grazing incidence.
    const GaussLegendre nodes(50);
    for (double alpha : {0.02, 0.1, 0.4, 1., 1.4}) {
        const double mean = nodes.integrate(0., 1., [&](double x) {
            const double half_pi = 0.5 * std::numbers::pi, theta = half_pi * (1. - x * x * x);
            return ggx_albedo_by_quadrature(std::cos(theta), alpha) * std::sin(2. * theta) *
                   half_pi * 3. * x * x;
        });
        EXPECT_NEAR(GgxAlbedo<double>(alpha).average(), mean, 2e-7) << alpha;
    }
    // What the reference's quadrature converges to with 1024 azimuths.
    EXPECT_NEAR(GgxAlbedo<double>(0.6).average(), 0.630648615997, 1e-8);
}

TEST(GgxSmith, CompensationMakesTheFurnaceWhite) {
    for (const char* alpha : {"0.1", "0.3", "0.6", "1"})
        for (double degrees : {0., 45., 78.}) {
            const AnyModel model =
                make_model("ggx", parse_settings(fmt::format(
                                      "fresnel=one compensation=kulla_conty alpha={}", alpha)));
            EXPECT_NEAR(directional_albedo(model, test::at_degrees(degrees)).value, 1., 3e-6)
                << alpha << " at " << degrees;
        }
}

TEST(GgxSmith, TheSlidesColourIsBrighterByOneReflection) {
    const Vec3d wi = test::at_degrees(30.), wo = test::at_degrees(50., 60.);
    const auto at = [&](const char* text) {
        return make_model("ggx", parse_settings(fmt::format("fresnel=schlick f0=0.4 alpha=0.7 "
                                                            "compensation={}",
                                                            text)))
            .eval(wi, wo);
    };
    const double average = 0.4 + 0.6 / 21.;
    EXPECT_NEAR((at("kulla_conty") - at("none")) / (at("slides") - at("none")), average, 1e-9);
}

}  // namespace nacre
