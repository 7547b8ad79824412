// Schlick's factors and Lafortune's lobes: reference values, closed forms, special cases.
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/lafortune.h"
#include "nacre/reflectance/schlick.h"
#include "tests/reflectance/family_data.h"

namespace nacre {
namespace {

using test::at_degrees;
using test::ScalarVector;

double at(const char* model, const std::string& settings, const Vec3d& wi, const Vec3d& wo) {
    return AnyModel(find_evaluator(model), parse_settings(settings), Bounds::ranges_only)
        .eval(wi, wo);
}
double albedo(const char* model, const std::string& settings, double degrees) {
    return directional_albedo(make_model(model, parse_settings(settings)), at_degrees(degrees))
        .value;
}

}  // namespace

TEST(Schlick, FactorsAgreeWithTheReference) {
    test::for_each_scalar("schlick_factors", [](const ScalarVector& v) {
        const double t = v("t"), w = v("w");
        v.expect(schlick_zenith(1. / (t * t) - 1., v("r")), "Z");
        v.expect(schlick_azimuth(w * w, 1. - w * w, v("p")), "A");
        v.expect(schlick_masking(v("v"), v("r")), "G1_k");
    });
}

TEST(Schlick, AnisotropyKeepsTheMeanOfItsSquare) {
    for (double p : {0.1, 0.5, 1.}) {
        double sum = 0., square = 0.;
        constexpr int n = 2000;
        for (int i = 0; i < n; ++i) {
            const double c = std::cos(2. * std::numbers::pi * (i + 0.5) / n);
            const double a = schlick_azimuth(c * c, 1. - c * c, p);
            sum += a / n;
            square += a * a / n;
        }
        EXPECT_NEAR(square, 1., 1e-9);
        EXPECT_NEAR(
            sum, 2. * std::sqrt(p) * std::comp_ellint_1(std::sqrt(1. - p * p)) / std::numbers::pi,
            1e-9);
    }
}

TEST(Schlick, ClosedForms) {
    for (const char* r : {"0.1", "0.5", "1"})
        EXPECT_NEAR(albedo("schlick", fmt::format("form=simple spectral=constant c=1 r={}", r), 0.),
                    1. / (1. + std::stod(r)), 1e-6);
    // r = 1 of the mixture is Lambert's law; of the simple form, 1 / (4 pi v v').
    const Vec3d wi = at_degrees(20.), wo = at_degrees(70., 100.);
    EXPECT_NEAR(at("schlick", "form=mixture spectral=constant c=1 r=1", wi, wo), inv_pi, 1e-12);
    EXPECT_NEAR(at("schlick", "form=simple spectral=constant c=1 r=1", wi, wo),
                0.25 * inv_pi / (wi.z * wo.z), 1e-12);
    // The mass of the density at normal incidence.
    const AnyModel model = make_model("schlick", parse_settings("form=simple r=0.2 p=0.5"));
    const Vec3d n{0., 0., 1.};
    const Integral mass = integrate_hemisphere([&](const Vec3d& w) { return model.pdf(w, n); }, n);
    EXPECT_NEAR(mass.value, 1. / 1.2, 1e-6);
}

TEST(Schlick, TheMixtureMirrorsWhatIsNeitherGlossyNorDiffuse) {
    const Vec3d w = at_degrees(40.);
    const auto mirror = [&](const char* text) {
        return make_model("schlick", parse_settings(text)).mirror(w);
    };
    EXPECT_NEAR(mirror("form=mixture spectral=constant c=0.5 r=0.1"), 0.5 * (1. - 0.36), 1e-12);
    EXPECT_EQ(mirror("form=mixture spectral=constant c=0.5 r=0.7"), 0.);
    EXPECT_EQ(mirror("form=simple spectral=constant c=0.5 r=0.1"), 0.);
    // Two layers: (1 - S) S' of the second.
    EXPECT_NEAR(mirror("form=mixture spectral=constant layers=two c=0.2 r=0.8 c2=0.5 r2=0.1"),
                0.8 * 0.5 * (1. - 0.36), 1e-12);
}

TEST(Schlick, TheMaskedFormConservesEnergyEvenAtGrazingIncidence) {
    for (const char* r : {"0.01", "0.1", "0.5", "1"})
        for (double degrees : {0., 60., 85., 89.}) {
            const double e = albedo(
                "schlick", fmt::format("form=masked spectral=constant c=1 r={}", r), degrees);
            EXPECT_LT(e, 1.) << r << " " << degrees;
            EXPECT_GT(e, 0.3) << r << " " << degrees;
        }
}

TEST(SchlickCt, ConsistentMaskingIsThatOfTheSlopeOfTheDistribution) {
    // m of G is m/sqrt(2) of D: k = sqrt(2/pi) m / sqrt(2).
    const Vec3d wi = at_degrees(50.), wo = at_degrees(65., 170.);
    const double k1 = std::sqrt(2. / std::numbers::pi) * 0.4, k2 = k1 / std::numbers::sqrt2;
    const double ratio = schlick_masking(wi.z, k2) * schlick_masking(wo.z, k2) /
                         (schlick_masking(wi.z, k1) * schlick_masking(wo.z, k1));
    EXPECT_NEAR(at("schlick_ct", "kd=0 m=0.4 masking=consistent", wi, wo) /
                    at("schlick_ct", "kd=0 m=0.4", wi, wo),
                ratio, 1e-12);
    EXPECT_NEAR(at("schlick_ct", "kd=0 m=0.4 convention=literal", wi, wo) /
                    at("schlick_ct", "kd=0 m=0.4", wi, wo),
                4., 1e-12);
}

TEST(Lafortune, TheClassicLobeIsModifiedPhong) {
    const Vec3d wi = at_degrees(50.), wo = at_degrees(60., 150.);
    EXPECT_NEAR(at("lafortune", "kd=0.3 ks=0.6 n=20", wi, wo),
                at("phong", "variant=modified kd=0.3 ks=0.6 n=20", wi, wo), 1e-12);
}

TEST(Lafortune, AlbedosOfSpecialCases) {
    const auto closed = [](const char* text, double degrees) {
        return *make_model("lafortune", parse_settings(text)).albedo(at_degrees(degrees));
    };
    // Diffuse falloff: cos^n.
    EXPECT_NEAR(closed("kd=0 ks=0.8 cx=0 cy=0 cz=1 n=2.5", 60.), 0.8 * std::pow(0.5, 2.5), 1e-9);
    // The classic lobe at normal incidence, and at grazing (n+2)/(2 pi) B((n+1)/2, 3/2).
    EXPECT_NEAR(closed("kd=0 ks=1 n=10", 0.), 1., 1e-10);
    EXPECT_NEAR(closed("kd=0 ks=1 n=10", 90.), 0.123046875, 1e-10);
    EXPECT_NEAR(closed("kd=0 ks=1 n=100", 90.), 0.0397946186936, 1e-10);
    EXPECT_NEAR(closed("kd=0 ks=1 norm=density n=10", 0.), 11. / 12., 1e-10);
    // The reference's table, n = 5 and 20 at 30, 60 and 80 degrees.
    EXPECT_NEAR(closed("kd=0 ks=1 n=5", 30.), 0.866253576, 1e-9);
    EXPECT_NEAR(closed("kd=0 ks=1 n=5", 60.), 0.519406836, 1e-9);
    EXPECT_NEAR(closed("kd=0 ks=1 n=20", 80.), 0.200341869, 1e-9);
}

TEST(Lafortune, TheMirrorTakesWhatTheLobeLacks) {
    const Vec3d w = at_degrees(60.);
    const AnyModel model = make_model("lafortune", parse_settings("kd=0 ks=0.9 n=20 mirror=1"));
    EXPECT_NEAR(directional_albedo(model, w).value + model.mirror(w), 0.9, 1e-6);
    const Vec3d normal{0., 0., 1.};
    EXPECT_NEAR(model.mirror(normal), 0., 1e-9);
    // With (n+1)/(2 pi) a mirror is left at normal incidence.
    const AnyModel density =
        make_model("lafortune", parse_settings("kd=0 ks=0.9 n=20 norm=density mirror=0.5"));
    EXPECT_NEAR(density.mirror(normal), 0.5 * 0.9 / 22., 1e-9);
}

TEST(Lafortune, RetroReflectingLobesShineBack) {
    const Vec3d wi = at_degrees(50.);
    const auto value = [&](double phi) {
        return at("lafortune", "kd=0 cx=1 cy=1 n=15", wi, at_degrees(50., phi));
    };
    EXPECT_GT(value(0.), 100. * value(180.));
}

TEST(Lafortune, AMatrixIsItsPrincipalAxesTurned) {
    // diag(-1, -0.5, 0.8) turned by 30 degrees about the normal.
    const double a = std::numbers::pi / 6., c = std::cos(a), s = std::sin(a);
    const double xx = -c * c - 0.5 * s * s, yy = -s * s - 0.5 * c * c, xy = -0.5 * c * s;
    const Settings turned = {{"kd", 0.},  {"cx", xx},  {"cy", yy},
                             {"cxy", xy}, {"cz", 0.8}, {"n", 7.}};
    const AnyModel model(find_evaluator("lafortune"), turned);
    const auto turn = [&](const Vec3d& w) {
        return Vec3d{c * w.x + s * w.y, -s * w.x + c * w.y, w.z};
    };
    const Vec3d wi = at_degrees(40., 20.), wo = at_degrees(55., 170.);
    EXPECT_NEAR(model.eval(wi, wo),
                at("lafortune", "kd=0 cx=-1 cy=-0.5 cz=0.8 n=7", turn(wi), turn(wo)), 1e-12);
}

}  // namespace nacre
