// What the models must be in general: linear in the light, right in their limits.
#include "nacre/illumination/all_models.h"
#include "nacre/illumination/light_convention.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/random.h"
#include "tests/illumination/reference.h"
#include "tests/support/constants.h"

namespace nacre::illumination {
namespace {

/// The default parameters of a model in some situation.
Lighting<double> some_lighting(Random& random) {
    const auto upper = [&] {
        return polar(1.4 * double(random.next()), 2. * pi * double(random.next()));
    };
    return {.wi = upper(),
            .wo = upper(),
            .ambient = 0.3,
            .light_distance = 2.,
            .viewer_distance = 3.,
            .solid_angle = 0.01};
}

TEST(IlluminationProperties, ModelsAreLinearInTheLight) {
    Random random(stream_key(1, 2));
    for (const Description* model : models()) {
        if (model->part == Part::transparency) continue;
        const auto values = Values<double>::defaults(*model);
        for (int i = 0; i < 20; ++i) {
            Lighting<double> at = some_lighting(random);
            const auto with = [&](double light) {
                at.light = light;
                return intensity(*model, values, at);
            };
            const double one = with(1.);
            const double expected = model->uses_light ? 2.5 * one : one;
            EXPECT_NEAR(with(2.5), expected, 1e-14 * std::abs(expected)) << model->name;
        }
    }
}

TEST(IlluminationProperties, FourWavelengthsAreFourSingleOnes) {
    Random random(stream_key(3, 4));
    const Spectral light(1.f, 0.5f, 2.f, 0.25f), wavelength(450.f, 520.f, 600.f, 680.f);
    for (const Description* model : models()) {
        if (model->part == Part::transparency) continue;
        auto four = Values<float, Spectral>::defaults(*model);
        for (std::size_t i = 0; i < model->parameters.size(); ++i)
            if (model->parameters[i].kind == ParameterKind::spectrum)
                four.spectra[i] *= Spectral(1.f, 0.9f, 0.8f, 0.7f);
        for (int sample = 0; sample < 10; ++sample) {
            const Lighting<double> exact = some_lighting(random);
            Lighting<float, Spectral> at{.wi = Vec3f(exact.wi),
                                         .wo = Vec3f(exact.wo),
                                         .light = light,
                                         .ambient = light,
                                         .light_distance = 2.f,
                                         .viewer_distance = 3.f,
                                         .solid_angle = 0.01f,
                                         .wavelength = wavelength};
            const Spectral result = intensity(*model, four, at);
            for (int lane = 0; lane < 4; ++lane) {
                Values<float> single{.numbers = four.numbers};
                for (std::size_t i = 0; i < single.spectra.size(); ++i)
                    single.spectra[i] = four.spectra[i][lane];
                const float expected =
                    intensity(*model, single,
                              Lighting<float>{at.wi, at.wo, light[lane], light[lane], 2.f, 3.f,
                                              0.01f, wavelength[lane]});
                EXPECT_NEAR(result[lane], expected, 2e-5f * std::abs(expected) + 1e-12f)
                    << model->name << " lane " << lane;
            }
        }
    }
}

TEST(IlluminationProperties, NothingComesFromLightsBehindTheSurface) {
    for (const Description* model : models()) {
        if (model->part == Part::transparency || model->part == Part::ambient) continue;
        const Lighting<double> at{.wi = {0.6, 0., -0.8}, .wo = {0., 0.6, 0.8}};
        const double value = intensity(*model, Values<double>::defaults(*model), at);
        // Warnock and Romney drew surfaces from behind: |cos| and cos^2.
        const double expected = model->number == 4 ? 0.8 : model->number == 5 ? 0.64 : 0.;
        EXPECT_DOUBLE_EQ(value, expected) << model->name;
    }
}

TEST(IlluminationProperties, DistancesActAsPublished) {
    const Lighting<double> near{.wi = {0., 0., 1.}, .wo = {0., 0., 1.}};
    Lighting<double> far = near;
    far.light_distance = 3.;
    far.viewer_distance = 2.;
    far.solid_angle = 1. / 9.;
    const std::map<int, double> ratio = {
        {3, 1.},       {4, 1. / 2.},  {5, 1. / 16.}, {6, 1. / 9.},  {7, 1. / 9.}, {8, 4. / 25.},
        {9, 1. / 36.}, {10, 2. / 3.}, {11, 1.},      {12, 1. / 2.}, {13, 1.},     {14, 2. / 3.},
        {15, 1.},      {16, 2. / 3.}, {17, 1.},      {18, 1.},      {19, 1.},     {20, 1.}};
    for (const auto& [number, expected] : ratio) {
        const Description& model = models().find(std::to_string(number));
        const auto values = Values<double>::defaults(model);
        EXPECT_NEAR(intensity(model, values, far) / intensity(model, values, near), expected, 1e-12)
            << model.name;
    }
    // The clamped quadratic: never brighter than without it, an inverse square far away.
    EXPECT_EQ(distance_attenuation(0.1, 0., 0., 1.), 1.);
    EXPECT_DOUBLE_EQ(distance_attenuation(3., 1., 0.5, 0.25), 1. / 4.75);
    EXPECT_DOUBLE_EQ(absorption_attenuation(0.5, 2.), std::exp(-1.));
    EXPECT_DOUBLE_EQ(solid_angle(2., 4.), 0.125);
}

TEST(IlluminationProperties, DescriptionsSayWhatTheFormulasUse) {
    Random random(stream_key(5, 6));
    for (const Description* model : models()) {
        if (model->part == Part::transparency) continue;
        auto values = Values<double>::defaults(*model);
        if (model->number == 11) values.numbers[3] = 1.;  // else there is no attenuation
        Lighting<double> at = some_lighting(random);
        at.wo = at.wi * -1. + Vec3d{0., 0., 2. * at.wi.z};  // in the highlight
        const double value = intensity(*model, values, at);
        ASSERT_GT(value, 0.) << model->name;
        Lighting<double> moved = at;
        moved.viewer_distance *= 2.;
        EXPECT_EQ(intensity(*model, values, moved) != value, model->uses_viewer_distance)
            << model->name;
        moved = at;
        moved.light_distance *= 2.;
        moved.solid_angle /= 4.;
        EXPECT_EQ(intensity(*model, values, moved) != value,
                  model->light_distance != LightDistance::ignored)
            << model->name;
        EXPECT_EQ(model->is_brdf && model->uses_viewer_distance, false) << model->name;
    }
}

// k_d = 1 reflects pi times the light physically and exactly all of it in the pi convention.
TEST(IlluminationProperties, ConventionsDecideTheAlbedo) {
    const GaussLegendre nodes(32);
    const auto albedo = [&](LightConvention convention) {
        return nodes.integrate(0., pi / 2, [&](double theta) {
            return 2. * pi * std::sin(theta) * std::cos(theta) *
                   brdf(BouknightDiffuse<double>{1.}, polar(0.5), polar(theta), convention);
        });
    };
    EXPECT_NEAR(albedo(LightConvention::physical), pi, 1e-12);
    EXPECT_NEAR(albedo(LightConvention::pi), 1., 1e-12);
    EXPECT_DOUBLE_EQ(light_intensity(3., LightConvention::physical), 3.);
    EXPECT_DOUBLE_EQ(light_intensity(pi, LightConvention::pi), 1.);
    // Phong's highlight at normal incidence: 2 pi k_s / (m + 2).
    const double phong = nodes.integrate(0., pi / 2, [&](double theta) {
        return 2. * pi * std::sin(theta) * std::cos(theta) *
               brdf(Phong<double>{0.7, 10.}, {0., 0., 1.}, polar(theta), LightConvention::physical);
    });
    EXPECT_NEAR(phong, 2. * pi * 0.7 / 12., 1e-12);
    EXPECT_EQ(brdf(Phong<double>{0.7, 10.}, polar(0.3), {0.6, 0., -0.8}, LightConvention::physical),
              0.);
}

TEST(IlluminationProperties, FacetsAreReciprocalBrdfs) {
    Random random(stream_key(7, 8));
    const auto symmetric = [&](const auto& model, const char* what) {
        for (int i = 0; i < 50; ++i) {
            const Lighting<double> at = some_lighting(random);
            const double there = brdf(model, at.wi, at.wo, LightConvention::physical);
            const double back = brdf(model, at.wo, at.wi, LightConvention::physical);
            EXPECT_NEAR(there, back, 1e-12 * there) << what;
        }
    };
    for (int d : {0, 1, 2}) symmetric(BlinnTorranceSparrow<double>{d, 20., 1.5, 1.}, "blinn");
    for (int g : {0, 1}) symmetric(CookTorrance<double>{0.4, 0., 1.5, 1., g}, "cook-torrance");
    symmetric(HeTorrance<double>{0.2, 2., 1.5, 2., 0., 1., 0.}, "he-torrance");
}

// All of Blinn's distributions are one half at beta and one at the normal; Beckmann's is half of
// its value at the normal.
TEST(IlluminationProperties, BetaIsTheHalfHeightAngle) {
    for (double beta : {5., 15., 40.}) {
        const Vec3d up{0., 0., 1.}, h = polar(radians(beta));
        for (int d : {0, 1, 2}) {
            const BlinnTorranceSparrow<double> model{d, beta, 1.5, 1.};
            EXPECT_NEAR(model.facets(up), 1., 1e-12);
            EXPECT_NEAR(model.facets(h), 0.5, 1e-12) << d << " " << beta;
        }
        const double m = beckmann_slope_of_beta(radians(beta));
        EXPECT_NEAR(distribution_hall_beckmann(h, m), 0.5 * distribution_hall_beckmann(up, m),
                    1e-12 / (m * m));
        const double hall = unclipped_slope_of_beta(radians(beta));
        EXPECT_NEAR(distribution_hall_beckmann(up, hall),
                    std::pow(1. + std::sqrt(std::tan(radians(beta))), -2.), 1e-12);
    }
}

// The lobe of the half angle: in the plane of incidence Yang's m is Blinn's 2 m, which follows from
// (1 + cos x) / 2 = cos^2(x / 2).
TEST(IlluminationProperties, YangIsBlinnWithTwiceTheExponent) {
    for (double theta : {-1.2, -0.4, 0.2, 1.1}) {
        const Lighting<double> at{.wi = polar(0.7), .wo = polar(theta)};
        EXPECT_NEAR((Yang<double>{1., 7.}.intensity(at)),
                    (BlinnPhong<double>{1., 14.}.intensity(at)), 1e-13);
    }
}

// A surface much rougher than the wavelength: He's series becomes Beckmann's distribution of slopes
// 2 sigma / tau, that is, pi F D S / (4 cos_o) over pi with the normalised D, to 1 / g.
TEST(IlluminationProperties, HeBecomesBeckmannOnRoughSurfaces) {
    const double sigma = 4., tau = 40.;
    const HeTorrance<double> he{sigma, tau, 1.5, 2., 0., 1., 0.};
    for (double theta : {0., 0.05, 0.1}) {
        const Lighting<double> at{.wi = polar(0.3), .wo = polar(theta - 0.35)};
        const Vec3d h = half_vector(at.wi, at.wo);
        const double expected = fresnel_conductor(dot(h, at.wo), 1.5, 2.) *
                                distribution_hall_beckmann(h, 2. * sigma / tau) / at.wo.z;
        EXPECT_NEAR(he.intensity(at) / expected, 1., 2e-3) << theta;
    }
    // A surface much smoother than the wavelength is a mirror: all in the cone.
    const HeTorrance<double> smooth{1e-4, 2., 1.5, 2., 1., 1., 1.};
    const Lighting<double> mirror{.wi = polar(0.5), .wo = polar(-0.5)};
    EXPECT_NEAR(smooth.intensity(mirror), fresnel_conductor(std::cos(0.5), 1.5, 2.), 1e-4);
    const Lighting<double> beside{.wi = polar(0.5), .wo = polar(-0.55)};
    EXPECT_LT(smooth.intensity(beside), 1e-3);
}

TEST(IlluminationProperties, TransparencyReachesItsEnds) {
    const Vec3d up{0., 0., 1.}, edge{1., 0., 0.}, behind{0., 0., -1.};
    EXPECT_EQ(blend(0., 2., 5.), 2.);
    EXPECT_EQ(blend(1., 2., 5.), 5.);
    const CrowTransparency<double> crow{0.1, 0.8, 3.};
    EXPECT_DOUBLE_EQ(crow.transmittance(up), 0.8);
    EXPECT_DOUBLE_EQ(crow.transmittance(behind), 0.8);
    EXPECT_DOUBLE_EQ(crow.transmittance(edge), 0.1);
    EXPECT_DOUBLE_EQ(HallTransparency<double>{1.}.transmittance(up), 1.);
    EXPECT_LT(HallTransparency<double>{2.4}.transmittance(up), interface_transmittance(2.4));
}

// Light along the horizon, viewers along it, both at the normal: numbers, not NaNs.
TEST(IlluminationProperties, ExtremeDirectionsGiveFiniteValues) {
    const Vec3f directions[] = {{0.f, 0.f, 1.f},   {1.f, 0.f, 0.f},  {-1.f, 0.f, 1e-7f},
                                {0.f, 1.f, 1e-4f}, {0.f, 0.f, -1.f}, {-1.f, 0.f, -1e-7f}};
    for (const Description* model : models())
        for (const Vec3f& wi : directions)
            for (const Vec3f& wo : directions) {
                const auto values = Values<float>::defaults(*model);
                const float value =
                    model->part == Part::transparency
                        ? transmittance(*model, values, wo)
                        : intensity(*model, values, Lighting<float>{.wi = wi, .wo = wo});
                EXPECT_TRUE(std::isfinite(value) && value >= 0.f) << model->name << " " << value;
            }
}

}  // namespace
}  // namespace nacre::illumination
