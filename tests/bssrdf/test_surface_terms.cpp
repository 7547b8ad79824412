// What depends on directions: the directional dipole, single scattering along a ray, Fresnel
// factors of the exit.
#include "nacre/bssrdf/directional_dipole.h"
#include "nacre/bssrdf/exit_fresnel.h"
#include "nacre/bssrdf/photon_beam_diffusion.h"
#include "nacre/bssrdf/single_scattering.h"
#include "nacre/math/quadrature.h"
#include "tests/bssrdf/reference.h"
#include "tests/support/constants.h"

namespace nacre {

namespace {

using test::bssrdf_reference;

Vec3d vector(const nlohmann::json& v) { return {v[0], v[1], v[2]}; }

Vec3d polar(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

template <class T>
SurfaceRay<T> as(const SurfaceRay<double>& r) {
    return {Vec3<T>(r.position), Vec3<T>(r.normal), Vec3<T>(r.direction)};
}

}  // namespace

TEST(DirectionalDipole, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : bssrdf_reference()["directional_dipole"]) {
        const double ss = row["ss"], sa = row["sa"], g = row["g"], eta = row["n"];
        const DirectionalDipole<double> dipole(ss, sa, g, eta, {.clamp = false});
        const SurfaceRay<double> in{vector(row["xi"]), vector(row["ni"]), vector(row["wi"])};
        const SurfaceRay<double> out{vector(row["xo"]), vector(row["no"]), vector(row["no"])};
        EXPECT_RELATIVE(dipole.eval(in, out), number(row["S_d"]), 1e-9);
        const DirectionalDipole<float> single{float(ss), float(sa), float(g), eta};
        EXPECT_RELATIVE(single.eval(as<float>(in), as<float>(out)), number(row["S_d"]), 1e-4);
        const DirectionalDipole<Spectral> lanes{Spectral(float(ss)), Spectral(float(sa)),
                                                Spectral(float(g)), eta};
        EXPECT_RELATIVE(lanes.eval(as<Spectral>(in), as<Spectral>(out))[2], number(row["S_d"]),
                        1e-4);
        ++checked;
    }
    EXPECT_EQ(checked, 4);
}

TEST(DirectionalDipole, OptionsClampAndSymmetrise) {
    const Vec3d up(0., 0., 1.);
    const DirectionalDipole<double> raw(1., 0.1, 0., 1.3, {.clamp = false});
    const DirectionalDipole<double> clamped(1., 0.1, 0., 1.3);
    const DirectionalDipole<double> even(1., 0.1, 0., 1.3, {.clamp = false, .symmetrise = true});
    bool negative = false, lopsided = false;
    for (double x = -4.; x <= 4.; x += 0.31)
        for (double t = 0.; t < 1.55; t += 0.3) {
            const SurfaceRay<double> in{{}, up, polar(t, 0.)},
                out{{x, 0.1, 0.}, up, polar(0.4, 2.)};
            const double there = raw.eval(in, out), back = raw.eval(out, in);
            negative |= there < 0.;
            lopsided |= std::abs(there - back) > 1e-3 * std::abs(there);
            EXPECT_EQ(clamped.eval(in, out), std::max(there, 0.));
            EXPECT_NEAR(even.eval(in, out), 0.5 * (there + back), 1e-15);
            EXPECT_NEAR(even.eval(in, out), even.eval(out, in), 1e-15);
        }
    EXPECT_TRUE(lopsided);  // what symmetrising is for
    const SurfaceRay<double> in{{}, up, polar(1.2, 0.)};
    for (double x = 0.; x < 30. && !negative; x += 0.05)
        for (double z = -3.; z <= 3.; z += 0.5)
            negative |= raw.eval(in, {{-x, 0., z}, normalize(Vec3d(1., 0., 0.3)), up}) < 0.;
    EXPECT_TRUE(negative);  // what clamping is for
    // The same point, and a wall along the normal: finite.
    EXPECT_TRUE(std::isfinite(raw.eval(in, {{}, up, up})));
    EXPECT_TRUE(std::isfinite(raw.eval(in, {{0., 0., -1.}, up, up})));
    // Turned about the normal, nothing changes.
    const auto turn = [](const Vec3d& v) { return Vec3d(-v.y, v.x, v.z); };
    const SurfaceRay<double> out{{1., 0.5, 0.}, up, up};
    EXPECT_NEAR(raw.eval(in, out),
                raw.eval({{}, up, turn(in.direction)}, {turn(out.position), up, up}), 1e-15);
}

TEST(SingleScattering, IsHanrahanAndKruegerBelowAFlatSurface) {
    int checked = 0;
    for (const auto& row : bssrdf_reference()["hanrahan_krueger"]) {
        const double n = row["n"], g = row["g"], tau = row["tau"];
        const double theta_i = number(row["theta_i"]) * pi / 180.;
        const SingleScattering<double> model{2. * number(row["W"]), 2., g};
        for (const auto& sample : row["samples"]) {
            const double theta_o = number(sample["theta_o"]) * pi / 180.;
            // The vectors' azimuth 0 is the mirror side.
            const Vec3d wi = polar(theta_i, pi);
            const Vec3d wo = polar(theta_o, number(sample["phi"]) * pi / 180.);
            const double mu_i = refracted_cosine(wi.z, n), mu_o = refracted_cosine(wo.z, n);
            // The slab of thickness tau sends back this share of the half space.
            const double share = -std::expm1(-tau * (1. / mu_i + 1. / mu_o));
            EXPECT_RELATIVE(model.half_space_brdf(wi, wo, n) * share, number(sample["f_r"]), 1e-9);
            ++checked;
        }
    }
    EXPECT_GE(checked, 30);
}

TEST(SingleScattering, TheIntegralAlongTheRayIsTheClosedForm) {
    const GaussLegendre rule(40);
    for (const double eta : {1., 1.4}) {
        const SingleScattering<double> model{1.5, 2., 0.4};
        const Vec3d wi = polar(0.9, 2.), wo = polar(0.5, 0.3), up(0., 0., 1.);
        const Vec3d in = refract(wi, up, eta), out = refract(wo, up, eta);  // both downwards
        const double factors = (1. - fresnel_dielectric(wi.z, eta)) *
                               (1. - fresnel_dielectric(wo.z, eta)) / (eta * eta) / -in.z;
        const auto along = [&](double s_o) {
            // Shadow rays go straight to the light, as renderers cast them.
            const double s_i = s_o * -out.z / wi.z;
            const double s_i_refracted = refracted_light_distance(s_i, wi.z, eta);
            const double g = out.z / in.z;
            EXPECT_NEAR(s_i_refracted + s_o, combined_extinction(1., 1., g) * s_o, 1e-12);
            return factors * model.integrand(s_o, s_i_refracted, dot(in, -out));
        };
        double sum = 0.;
        for (int i = 0; i < 10; ++i) sum += rule.integrate(i, i + 1., along);
        EXPECT_RELATIVE(sum, model.half_space_brdf(wi, wo, eta), 1e-10);
        EXPECT_RELATIVE(model.half_space_brdf(wi, wo, eta), model.half_space_brdf(wo, wi, eta),
                        1e-13);
    }
    EXPECT_EQ(
        (SingleScattering<double>{1., 2., 0.}.half_space_brdf({0., 0., -1.}, {0., 0., 1.}, 1.3)),
        0.);
    const SingleScattering<Spectral> lanes{Spectral(1.5f), Spectral(2.f), Spectral(0.4f)};
    const Vec3d wi = polar(0.9, 2.), wo = polar(0.5, 0.3);
    EXPECT_RELATIVE(
        lanes.half_space_brdf(Vec3<Spectral>(wi), Vec3<Spectral>(wo), Spectral(1.4f))[3],
        (SingleScattering<double>{1.5, 2., 0.4}.half_space_brdf(wi, wo, 1.4)), 1e-5);
    EXPECT_NEAR(std::exp(-2. * sample_scattering_distance(2., 0.3)), 0.7, 1e-15);
}

TEST(SingleScattering, HasTheTotalOfTheBeamsProfile) {
    // Light at a right angle: the hemispherical reflectance of the BRDF is T times the profile's.
    const GaussLegendre rule(200);
    for (const double g : {0., 0.7, -0.4}) {
        const SingleScattering<double> model{0.9, 1., g};
        const double sum = rule.integrate(0., 1., [&](double c) {
            return 2. * pi * c * model.half_space_brdf({0., 0., 1.}, polar(std::acos(c), 0.), 1.4);
        });
        const double entry = 1. - normal_reflectance(1.4);
        EXPECT_RELATIVE(sum, entry * BeamSingleScattering({0.9, 0.1, g, 1.4}).total(), 1e-5);
    }
}

TEST(ExitFresnel, NormalisedConservesAndPaperLoses) {
    const GaussLegendre rule(200);
    for (const double eta : {1., 1.3, 1.5}) {
        const DiffuseBssrdf normalised(eta), paper(eta, ExitFresnel::paper);
        const auto mean = [&](const DiffuseBssrdf& b) {
            return rule.integrate(0., 1., [&](double c) { return 2. * c * b.exit(c); });
        };
        EXPECT_NEAR(mean(normalised), 1., 1e-6) << eta;
        EXPECT_NEAR(mean(paper), 1. - diffuse_reflectance_external(eta), 1e-6) << eta;
        EXPECT_NEAR(paper.eval(2., 0.8, 0.3), 2. / pi * paper.entry(0.8) * paper.entry(0.3), 1e-15);
        EXPECT_NEAR(normalised.eval(2., 0.8, 0.3), normalised.eval(2., 0.3, 0.8), 1e-15);
        EXPECT_NEAR(normalised.eval(Spectral(2.f), 0.8f, 0.3f)[1], normalised.eval(2., 0.8, 0.3),
                    1e-6);
    }
    EXPECT_EQ(DiffuseBssrdf(1.).exit(0.5), 1.);
}

}  // namespace nacre
