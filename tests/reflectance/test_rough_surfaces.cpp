// Rough metal, rough glass and rough plastic against formulas evaluated by other means.
#include "nacre/reflectance/rough_conductor.h"
#include "nacre/reflectance/rough_dielectric.h"
#include "nacre/reflectance/rough_plastic.h"
#include "tests/reflectance/chi_square.h"
#include "tests/reflectance/reference.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

Vec3d direction_of_cosine(double cosine, double phi) {
    const double s = std::sqrt(1. - cosine * cosine);
    return {s * std::cos(phi), s * std::sin(phi), cosine};
}

Vec3d random_direction(Random& random) {
    const float z = 2.f * random.next() - 1.f;
    return direction_of_cosine(z, 2. * pi * random.next());
}

}  // namespace

TEST(RoughConductor, AgreesWithTheReferenceVectors) {
    const auto data = test::reflectance_vectors();
    if (data.is_null()) GTEST_SKIP() << "shared reference data are absent";
    int compared = 0;
    for (const auto& v : data["models"]["ggx_smith"]["vectors"]) {
        const auto& p = v["params"];
        if (p["G"] != "smith_sep" || p.contains("h")) continue;  // h: polarised light
        const double m = p["m"].get<double>();
        const Vec3d wi = test::vector(v["wi"]), wo = test::vector(v["wo"]);
        RoughConductor<double, double, Ggx<double>> model{{m, m}, 0., 1., 1.};
        if (p["F"] == "conductor") {
            model.eta = p["n"].get<double>();
            model.k = p["k"].get<double>();
        } else {  // Schlick's Fresnel factor on a perfect mirror
            model.reflectance =
                fresnel_schlick(dot(wi, half_vector(wi, wo)), p["f0"].get<double>());
        }
        const double expected = v["value"].get<double>();
        const double value =
            p["kd"].get<double>() / pi + p["ks"].get<double>() * model.eval(wi, wo);
        EXPECT_NEAR(value, expected, 1e-9 * expected) << v["id"];
        ++compared;
    }
    EXPECT_EQ(compared, 4);
}

// Walter et al. 2007, eq. 16, 20, 21, evaluated step by step for directions on any sides.
TEST(RoughDielectric, IsWalters2007) {
    const Beckmann<double> facets{0.4, 0.25};
    const double n_outside = 1.1, n_inside = 1.6;
    const RoughDielectric<double, double, Beckmann<double>> model{facets, n_inside / n_outside, 1.,
                                                                  1.};
    Random random(stream_key(1, 2));
    int reflected = 0, refracted = 0;
    for (int k = 0; k < 4000; ++k) {
        const Vec3d i = random_direction(random), o = random_direction(random);
        const double ni = i.z > 0. ? n_outside : n_inside, no = o.z > 0. ? n_outside : n_inside;
        double expected;
        if (i.z * o.z > 0.) {
            const Vec3d h = normalize(i + o) * (i.z > 0. ? 1. : -1.);
            const double f =
                fresnel_dielectric(std::abs(dot(i, h)), (i.z > 0. ? n_inside : n_outside) / ni);
            expected = f * smith_g1(facets, i, h) * smith_g1(facets, o, h) * facets.density(h) /
                       (4. * std::abs(i.z) * std::abs(o.z));
            reflected += expected > 0.;
        } else {
            Vec3d h = normalize((i * ni + o * no) * -1.);
            if (h.z < 0.) h = h * -1.;
            const double ih = dot(i, h), oh = dot(o, h), sum = ni * ih + no * oh;
            const double f = fresnel_dielectric(std::abs(ih), no / ni);
            expected = std::abs(ih) * std::abs(oh) / (std::abs(i.z) * std::abs(o.z)) * no * no *
                       (1. - f) * smith_g1(facets, i, h) * smith_g1(facets, o, h) *
                       facets.density(h) / (sum * sum);
            refracted += expected > 0.;
        }
        ASSERT_NEAR(model.eval(i, o), expected, 1e-9 * expected + 1e-12);
        ASSERT_NEAR(model.eval(i, o) * ni * ni, model.eval(o, i) * no * no,
                    1e-9 * expected + 1e-12);
    }
    EXPECT_GT(reflected, 500);
    EXPECT_GT(refracted, 200);
}

TEST(RoughBoundary, ReflectsTheIntegralOfItsBrdf) {
    const Ggx<double> facets{0.5, 0.5};
    const RoughDielectric<double, double, Ggx<double>> model{facets, 1.5, 1., 0.};
    const GaussLegendre nodes(64);
    for (double cosine : {0.2, 0.6, 0.95}) {
        const Vec3d wo = direction_of_cosine(cosine, 0.);
        const double integral = nodes.integrate(0., 1., [&](double z) {
            return 2. * nodes.integrate(0., pi, [&](double phi) {
                return model.eval(direction_of_cosine(z, phi), wo) * z;
            });
        });
        EXPECT_NEAR(rough_reflectance(facets, wo, 1.5), integral, 1e-4) << cosine;
    }
}

TEST(RoughBoundary, BecomesSmooth) {
    const double eta = 1.49 / 1.000277;
    const RoughBoundary boundary(Beckmann<double>{1e-3, 1e-3}, eta);
    for (int i = 4; i < RoughBoundary::size; ++i)
        EXPECT_NEAR(boundary.transmittance[i], 1. - fresnel_dielectric(i / 63., eta), 1e-4) << i;
    // Mitsuba's mean over 64 cosines, of the smooth boundary.
    double sum = 0.;
    for (int i = 0; i < 64; ++i) sum += i / 63. * fresnel_dielectric(i / 63., 1. / eta);
    EXPECT_NEAR(boundary.internal, sum / 32., 1e-3);
    // Between the nodes, linear.
    EXPECT_FLOAT_EQ(boundary.transmittance_at(10.5f / 63.f),
                    0.5f * (boundary.transmittance[10] + boundary.transmittance[11]));
    EXPECT_FLOAT_EQ(boundary.transmittance_at(1.f), boundary.transmittance[63]);
}

// What facets of any roughness mirror and let through never exceeds what came: R + T <= 1.
TEST(RoughBoundary, KeepsSharesWithinBounds) {
    for (double alpha : {0.05, 0.3, 1.0})
        for (double eta : {1.1, 1.5, 2.4}) {
            const RoughBoundary b(Ggx<double>{alpha, alpha}, eta);
            double mean = 0.;
            for (int i = 0; i < 64; ++i) {
                EXPECT_GE(b.transmittance[i], 0.f);
                EXPECT_LE(b.transmittance[i], 1.f);
                mean += 2. * i / 63. * b.transmittance[i] / 64.;
            }
            // White base, all light counted: mean transmittance in times out over 1 - Fi.
            EXPECT_GE(b.internal, 0.f);
            EXPECT_LT(mean / (eta * eta * (1. - b.internal)), 1.) << alpha << " " << eta;
        }
}

// Saunderson's correction with the closed form of the mean reflectance, for each incidence:
// albedo (1 - F) rho (1 - Fi) / (1 - r Fi).
TEST(Plastic, HasTheAlbedoOfItsClosedForm) {
    const double eta = 1.5, inner = 0.596339;  // Fi of 1.5: Walsh 1926; reference.md, 2 C_1
    const GaussLegendre nodes(64);
    for (double rho : {0.2, 0.8, 1.0})
        for (bool nonlinear : {false, true})
            for (double cosine : {0.1, 0.5, 1.0}) {
                const Plastic<double> model{rho, eta, inner, nonlinear};
                const Vec3d wo = direction_of_cosine(cosine, 0.);
                const double albedo = nodes.integrate(0., 1., [&](double z) {
                    return 2. * pi * model.eval(direction_of_cosine(z, 1.), wo) * z;
                });
                const double expected = (1. - fresnel_dielectric(cosine, eta)) * rho *
                                        (1. - inner) / (1. - (nonlinear ? rho : 1.) * inner);
                EXPECT_NEAR(albedo, expected, 2e-4 * expected);
            }
}

}  // namespace nacre
