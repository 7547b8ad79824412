#include "nacre/optics/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

#include "nacre/optics/fresnel_moments.h"
#include "tests/optics/reference.h"

namespace nacre {

namespace {

constexpr double degree = 3.14159265358979323846 / 180.;

}  // namespace

TEST(Fresnel, DielectricAgreesWithTheReference) {
    int checked = 0;
    for (const auto& group : test::optics_reference()["fresnel"]["directional"]) {
        const double n = group["n"];
        for (std::size_t i = 0; i < group["theta_deg"].size(); ++i, ++checked) {
            const double c = std::cos(double(group["theta_deg"][i]) * degree);
            EXPECT_NEAR(fresnel_dielectric(c, n), double(group["R_outside"][i]), 1e-10) << n;
            EXPECT_NEAR(fresnel_dielectric(c, 1. / n), double(group["R_inside"][i]), 1e-10) << n;
            // The renderer's types: single precision, four indices at once.
            const Spectral lanes = fresnel_dielectric(float(c), Spectral(float(n)));
            EXPECT_NEAR(lanes[2], double(group["R_outside"][i]), 2e-6) << n;
        }
        EXPECT_NEAR(normal_reflectance(n), double(group["normal_R"]), 1e-14);
    }
    EXPECT_GT(checked, 40);
}

TEST(Fresnel, IsReciprocal) {
    // The same pair of directions seen from either side.
    for (const double n : {1.1, 1.33, 1.5, 2.4})
        for (double c = 0.02; c < 1.; c += 0.07) {
            const double t = refracted_cosine(c, n);
            EXPECT_NEAR(fresnel_dielectric(c, n), fresnel_dielectric(t, 1. / n), 1e-12);
            EXPECT_NEAR(refracted_cosine(t, 1. / n), c, 1e-12);
        }
}

TEST(Fresnel, ConservesEnergyForEachPolarisation) {
    // T = (n cos_t / cos_i) t^2 with t_s = 1 + r_s, t_p = (1 + r_p) / n; R + T = 1.
    for (const double n : {0.8, 1.33, 2.4})
        for (double c = 0.65; c <= 1.; c += 0.05) {
            const auto r = fresnel_amplitudes(c, n);
            const double factor = n * refracted_cosine(c, n) / c;
            EXPECT_NEAR(r.s * r.s + factor * (1. + r.s) * (1. + r.s), 1., 1e-12);
            EXPECT_NEAR(r.p * r.p + factor * (1. + r.p) * (1. + r.p) / (n * n), 1., 1e-12);
        }
}

TEST(Fresnel, ParallelLightVanishesAtBrewstersAngle) {
    const double c = std::cos(std::atan(1.5));
    EXPECT_NEAR(fresnel_dielectric_polarised(c, 1.5).p, 0., 1e-28);
    EXPECT_GT(fresnel_dielectric_polarised(c, 1.5).s, 0.14);
}

TEST(Fresnel, LimitsAreFinite) {
    EXPECT_EQ(fresnel_dielectric(0.f, 1.5f), 1.f);
    EXPECT_EQ(fresnel_dielectric(0.f, 1.f), 0.f);
    EXPECT_EQ(fresnel_dielectric(0.7f, 1.f), 0.f);
    EXPECT_EQ(fresnel_dielectric(0.f, 0.7f), 1.f);
    EXPECT_EQ(fresnel_conductor(0.f, 0.2f, 3.f), 1.f);
    EXPECT_EQ(fresnel_conductor(1.f, 1.f, 0.f), 0.f);
    const Spectral mixed =
        fresnel_dielectric(Spectral(0.f, 0.3f, 1.f, 0.5f), Spectral(1.f, 0.5f, 1.5f, 1.f));
    EXPECT_EQ(mixed[0], 0.f);
    EXPECT_EQ(mixed[1], 1.f);
    EXPECT_NEAR(mixed[2], 0.04f, 1e-7f);
    EXPECT_EQ(mixed[3], 0.f);
}

TEST(Fresnel, ConductorWithoutAbsorptionIsADielectric) {
    for (const double n : {0.6, 1.5})
        for (double c = 0.; c <= 1.; c += 0.1) {
            const auto metal = fresnel_conductor_polarised(c, n, 0.);
            const auto glass = fresnel_dielectric_polarised(c, n);
            EXPECT_NEAR(metal.s, glass.s, 1e-13);
            EXPECT_NEAR(metal.p, glass.p, 1e-13);
        }
}

TEST(Fresnel, ConductorAgreesWithComplexArithmetic) {
    // r_s = (c - root) / (c + root), r_p = (eps c - root) / (eps c + root), straight from the
    // definition, for silver, gold, iron and a black absorber.
    for (const auto& [n, k] :
         {std::pair(0.05, 3.3), std::pair(0.43, 2.455), std::pair(2.9, 3.), std::pair(1.5, 0.01)})
        for (double c = 0.; c <= 1.; c += 0.05) {
            const std::complex<double> eps = std::complex(n, k) * std::complex(n, k);
            const std::complex<double> root = std::sqrt(eps - (1. - c * c));
            const auto r = fresnel_conductor_polarised(c, n, k);
            EXPECT_NEAR(r.s, std::norm((c - root) / (c + root)), 1e-12);
            EXPECT_NEAR(r.p, std::norm((eps * c - root) / (eps * c + root)), 1e-12);
            EXPECT_NEAR(fresnel_conductor(float(c), float(n), float(k)), r.mean(), 3e-6);
        }
    const double n = 0.2, k = 3.;  // F0 = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)
    EXPECT_NEAR(fresnel_conductor(1., n, k), (0.64 + 9.) / (1.44 + 9.), 1e-14);
}

TEST(Fresnel, SchlicksErrorIsThePublishedOne) {
    const auto largest_error = [](double n) {
        double worst = 0.;
        for (double c = 0.; c <= 1.; c += 1e-4)
            worst = std::max(worst, std::abs(fresnel_schlick(c, normal_reflectance(n)) -
                                             fresnel_dielectric(c, n)));
        return worst;
    };
    EXPECT_NEAR(largest_error(1.33), 0.060, 5e-4);
    EXPECT_NEAR(largest_error(1.5), 0.036, 5e-4);
    EXPECT_NEAR(index_of_normal_reflectance(normal_reflectance(1.7)), 1.7, 1e-14);
}

TEST(Fresnel, RefractionObeysSnell) {
    const Vec3d n = normalize(Vec3d(0.3, -0.2, 0.9));
    const Vec3d w = normalize(Vec3d(0.8, 0.1, 0.6));
    for (const double eta : {1.5, 1. / 1.3}) {
        const Vec3d t = refract(w, n, eta);
        EXPECT_NEAR(length(t), 1., 1e-14);
        EXPECT_LT(dot(t, n), 0.);
        EXPECT_NEAR(length(cross(w, n)), eta * length(cross(t, n)), 1e-14);  // sines
        EXPECT_NEAR(dot(cross(w, n), t), 0., 1e-14);                         // one plane
        EXPECT_NEAR(-dot(t, n), refracted_cosine(dot(w, n), eta), 1e-14);
        const Vec3d back = refract(t, -n, 1. / eta);
        EXPECT_NEAR(length(back - w), 0., 1e-13);
    }
    EXPECT_EQ(refract(Vec3d(0.8, 0., 0.6), Vec3d(0., 0., 1.), 1. / 1.5), Vec3d());
}

TEST(FresnelMoments, AgreeWithTheReference) {
    int checked = 0;
    for (const auto& row : test::optics_reference()["fresnel"]["diffuse"]) {
        const double eta = row["eta"];
        const auto expect = [&](const char* key, double value, double tolerance = 1e-10) {
            if (!row.contains(key)) return;
            EXPECT_NEAR(value, double(row[key]), tolerance) << key << " at " << eta;
            ++checked;
        };
        expect("Fdr_fit", diffuse_reflectance_fit(eta));
        expect("two_C1_fit", two_c1_fit(eta));
        expect("three_C2_fit", three_c2_fit(eta), 1e-10);
        expect("Fdr_internal_exact", diffuse_reflectance_internal(eta));
        expect("two_C1_exact", 2. * fresnel_moment(1, eta));
        expect("three_C2_exact", 3. * fresnel_moment(2, eta));
        // The vectors' external value is always for light that enters the denser side.
        expect("Fdr_external_exact", diffuse_reflectance_external(std::max(eta, 1. / eta)));
        if (eta != 1.) expect("A_fit", boundary_parameter(eta, BoundaryModel::fit), 1e-9);
        expect("A_exact", boundary_parameter(eta, BoundaryModel::exact), 1e-9);
        expect("A_robin_two_moment_exact", boundary_parameter(eta, BoundaryModel::two_moment),
               1e-9);
    }
    EXPECT_GT(checked, 60);
}

TEST(FresnelMoments, ClosedFormAndQuadratureMeet) {
    for (const double eta : {1.0101, 1.02, 1.2, 1.5, 2., 3.}) {
        EXPECT_NEAR(diffuse_reflectance_internal(eta), 2. * fresnel_moment(1, eta), 1e-11);
        EXPECT_NEAR(diffuse_reflectance_external(eta), 2. * fresnel_moment(1, 1. / eta), 1e-11);
    }
    EXPECT_EQ(diffuse_reflectance_internal(1.), 0.);
    EXPECT_LT(diffuse_reflectance_internal(1.0001), 1e-3);
    EXPECT_EQ(boundary_parameter(1., BoundaryModel::fit), 1.);
}

}  // namespace nacre
