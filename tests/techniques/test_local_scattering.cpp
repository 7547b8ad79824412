// The first order of Hanrahan and Krueger with Lambert's law for the others, against closed forms,
// and its energy against adding and doubling.
#include "nacre/subsurface/local_scattering.h"

#include "nacre/bssrdf/profile.h"
#include "nacre/bssrdf/single_scattering.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel_moments.h"
#include "tests/support/bound.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {

namespace {

constexpr double g = 0.4;

std::string half_space(const std::string& profile, const std::string& options = "") {
    return slab(30, subsurface(profile,
                               xml::phase("hg", g) + word("method", "hanrahan_krueger") + options));
}
ProfileMedium forward_medium(int c) {
    ProfileMedium m = medium(c);
    m.g = g;
    return m;
}
/// Layer of infinite thickness on matter of its own index.
LayerStack endless(const ProfileMedium& m) {
    return {
        {{m.sigma_s, m.sigma_a, m.g, std::numeric_limits<double>::infinity(), m.eta}}, 1., m.eta};
}
/// What is scattered once of even light that has entered, by the slope of adding and doubling where
/// nothing is scattered twice.
double first_order(double g, double eta) {
    const double albedo = 1e-5, cosine[] = {1.};
    const LayerTotals t =
        adding_doubling(endless({albedo, 1. - albedo, g, eta}), cosine, {}, {.nodes = 96}).diffuse;
    return (t.reflectance - t.specular) / (1. - t.specular) / albedo;
}

}  // namespace

TEST(SingleScatteringShare, IsTheSlopeOfAddingDoublingAtSmallAlbedos) {
    // Of an isotropic medium without boundary: the integral of xy / (x + y) over the unit square.
    EXPECT_NEAR(single_scattering_share(0., 1.), 2. / 3. * (1. - std::numbers::ln2), 1e-6);
    for (double asymmetry : {-0.3, 0., 0.6})
        for (double index : {1., 1.3, 1.5}) {
            const double expected = first_order(asymmetry, index);
            EXPECT_NEAR(single_scattering_share(asymmetry, index), expected, 1e-4 * expected)
                << asymmetry << " " << index;
        }
}

TEST_F(Techniques, HanrahanKruegerUnderABeamIsTheClosedForm) {
    struct Case {
        const char *profile, *single;
        bool first, subtracted;
    };
    const double scale = 1. / (1. - diffuse_reflectance_external(eta));
    for (const Case& k :
         {Case{"better_dipole", "auto", true, false}, Case{"dipole", "auto", true, true},
          Case{"dipole", "on", true, false}, Case{"dipole", "off", false, false}})
        for (const Vec3f& wi : {Vec3f{0, 0, 1}, Vec3f{0.6f, 0, 0.8f}, Vec3f{-0.8f, 0.36f, 0.48f}}) {
            const Scene s =
                scene(xml::integrator("path") +
                      fmt::format("<emitter type=\"directional\"><vector name=\"direction\" "
                                  "value=\"{}, {}, {}\"/>",
                                  -wi.x, -wi.y, -wi.z) +
                      xml::rgb("irradiance", {1, 1, 1}) + "</emitter>" +
                      half_space(k.profile, word("single_scattering", k.single)));
            for (const Vec3f& wo :
                 {Vec3f{0, 0, 1}, Vec3f{0.28f, 0, 0.96f}, Vec3f{-0.48f, 0.64f, 0.6f}}) {
                const RadianceEstimate e =
                    look(s, onto_the_middle(wo, 10), {.pixels = 10, .samples = 4});
                const double enters = 1. - fresnel_dielectric(double(wi.z), eta),
                             leaves = 1. - fresnel_dielectric(double(wo.z), eta);
                for (int c = 0; c < 3; ++c) {
                    const ProfileMedium m = forward_medium(c);
                    double rho = make_profile(k.profile, m)->total(), f = 0.;
                    if (k.subtracted) rho -= m.sigma_s / m.sigma_t() * first_order(g, eta);
                    if (k.first)
                        f = SingleScattering<double>{m.sigma_s, m.sigma_t(), g}.half_space_brdf(
                            Vec3d(wi), Vec3d(wo), eta);
                    f += rho * scale * enters * leaves / pi;
                    EXPECT_NEAR(e.mean[c], f * wi.z, 1e-4 * f) << k.profile << k.single << c;
                }
            }
        }
}

TEST_F(Techniques, HanrahanKruegerInEvenLightIsItsAlbedo) {
    // Light samples and directions of the lobe together; the first order's albedo by quadrature.
    const Scene s =
        scene(xml::integrator("path") + xml::constant_light() + half_space("better_dipole"));
    for (const Vec3f& wo : {Vec3f{0, 0, 1}, Vec3f{0.6f, 0, 0.8f}, Vec3f{0.954f, 0, 0.3f}}) {
        const Vec3f o = normalize(wo);
        const double mirrored = fresnel_dielectric(double(o.z), eta);
        const RadianceEstimate e = look(s, onto_the_middle(o, 10), {.pixels = 1000, .samples = 64});
        Vec3d expected;
        for (int c = 0; c < 3; ++c) {
            const ProfileMedium m = forward_medium(c);
            const LayerTotals once = HanrahanKruegerStack(endless(m)).totals(double(o.z));
            expected[c] =
                once.reflectance + (1. - mirrored) * make_profile("better_dipole", m)->total();
        }
        expect_radiance(e, expected, 1e-3, fmt::format("view cosine {}", o.z), 4.5);
    }
}

TEST_F(Techniques, SamplesOfLocalScatteringHaveTheDensityThatItSays) {
    const Scene s =
        scene(xml::integrator("path") + xml::constant_light() + half_space("better_dipole"));
    const Medium& inside = *s.shapes[0].interior;
    const LocalScatteringLobe lobe(
        inside, std::make_shared<ProfileTables>(inside, eta, "better_dipole", Bands(s.mode)), eta,
        1.f, {});
    SurfacePoint at;
    at.ng = {0, 0, 1};
    const Vec3f wo{0.6f, 0.f, 0.8f};
    const test::Bound bsdf(lobe, at);
    // Mean and mean square of a cosine over the density, against the same by samples.
    double density = 0., moment = 0.;
    const GaussLegendre rule(64);
    for (int k = 0; k < 128; ++k) {
        const double phi = 2. * pi * (k + 0.5) / 128;
        const auto integral = [&](auto&& f) {
            return rule.integrate(0., 1., [&](double z) {
                const double r = std::sqrt(1. - z * z);
                const Vec3f wi{float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)};
                return f(wi) * bsdf->pdf(wi, wo);
            });
        };
        density += 2. * pi / 128 * integral([](const Vec3f&) { return 1.; });
        moment += 2. * pi / 128 * integral([](const Vec3f& wi) { return double(wi.x * wi.x); });
    }
    Random random(7);
    std::vector<Vec3d> found;
    for (int i = 0; i < 200'000; ++i) {
        const float u = random.next();
        const auto sample = bsdf->sample(wo, u, random.next2());
        if (sample) {
            const Spectral f = bsdf->eval(sample->wi, wo);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sample->weight[c] * sample->pdf, f[c], 1e-5 * f[c]);
        }
        found.push_back(sample ? Vec3d(1., double(sample->wi.x * sample->wi.x), 0.) : Vec3d());
    }
    const RadianceEstimate e = RadianceEstimate::of(std::move(found));
    EXPECT_NEAR(e.mean.x, density, 4.5 * e.error.x + 1e-4);
    EXPECT_NEAR(e.mean.y, moment, 4.5 * e.error.y + 1e-4);
}

TEST(HanrahanKruegerTechnique, ReturnsWhatAddingDoublingDoesAsFarAsDiffusionHolds) {
    // All that comes back of even light that entered, index 1.3. With the dipole, which holds the
    // first order, it is the dipole's total. The better dipole gives back all the light of a white
    // medium by itself, so that with the first order more comes out than went in: up to 9 %.
    const double cosine[] = {1.}, once = single_scattering_share(0., eta);
    for (const double albedo : {0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999, 1.}) {
        const ProfileMedium m{albedo, 1. - albedo, 0., eta};
        const LayerTotals t = adding_doubling(endless(m), cosine).diffuse;
        const double exact = (t.reflectance - t.specular) / (1. - t.specular);
        const double better = make_profile("better_dipole", m)->total() + albedo * once;
        const double dipole = make_profile("dipole", m)->total();
        EXPECT_NEAR(better, exact, (albedo > 0.9 ? 0.09 : 0.04) * exact) << albedo;
        EXPECT_NEAR(dipole, exact, 0.09 * exact) << albedo;
        // There is something left for Lambert's law when the first order is taken off.
        EXPECT_GT(dipole, albedo * once) << albedo;
    }
}

}  // namespace nacre
