#include "nacre/layers/skin.h"
#include "nacre/optics/media.h"
#include "nacre/scene/build.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

class Media : public SceneFiles {
  protected:
    MediumPtr medium(const std::string& type, const std::string& parameters) {
        root_ = read("<medium type=\"" + type + "\">" + parameters + "</medium>");
        context_.media.clear();  // nodes of the last file are gone, and their addresses are reused
        return make_medium(*root_->children.at(0).node, context_);
    }
    PhaseFunction phase(const std::string& xml) { return medium("homogeneous", xml)->phase; }

    SceneNodePtr root_;
    BuildContext context_;
    Wavelengths rgb_ = Wavelengths::rgb_bands();
    Wavelengths nm_ = Wavelengths::at({450.f, 520.f, 600.f, 680.f});
};

void expect_rgb(const Spectral& s, const Vec3f& rgb, float tolerance = 1e-6f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(s[i], rgb[i], tolerance * std::max(1.f, rgb[i])) << i;
}

TEST_F(Media, DefaultsAreMitsubas) {
    const MediumPtr m = medium("homogeneous", "");
    ASSERT_TRUE(m->homogeneous());
    const MediumCoefficients c = m->coefficients({}, nm_);
    for (int i = 0; i < 4; ++i) {
        EXPECT_FLOAT_EQ(c.sigma_t[i], 1.f);
        EXPECT_FLOAT_EQ(c.sigma_s[i], 0.75f);
    }
    EXPECT_EQ(m->phase.kind(), PhaseFunction::Kind::isotropic);
}

TEST_F(Media, ScaleAndUnitMultiplyTheExtinctionOnly) {
    context_.mm_per_unit = 10.0;
    const MediumPtr m = medium(
        "homogeneous",
        "<rgb name=\"sigma_t\" value=\"1, 2, 4\"/><rgb name=\"albedo\" value=\"0.5, 0.25, 1\"/>"
        "<float name=\"scale\" value=\"3\"/>");
    const MediumCoefficients c = m->coefficients({}, rgb_);
    expect_rgb(c.sigma_t, {30.f, 60.f, 120.f});
    expect_rgb(c.sigma_s, {15.f, 15.f, 120.f});
    expect_rgb(m->majorant(rgb_), {30.f, 60.f, 120.f});
}

TEST_F(Media, ScatteringAndAbsorptionAddUp) {
    const MediumPtr m = medium("homogeneous",
                               "<rgb name=\"sigma_s\" value=\"2, 0, 5\"/>"
                               "<rgb name=\"sigma_a\" value=\"1, 0, 0\"/>");
    const MediumCoefficients c = m->coefficients({}, rgb_);
    expect_rgb(c.sigma_t, {3.f, 0.f, 5.f});
    expect_rgb(c.sigma_s, {2.f, 0.f, 5.f});
    const Spectral albedo = m->albedo->eval(nm_);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(albedo[i] >= 0.f && albedo[i] <= 1.f);
}

TEST_F(Media, MeasuredMarbleHasJensensCoefficients) {
    // Jensen et al. 2001, table 1, mm^-1; the scene counts in centimetres.
    context_.mm_per_unit = 10.0;
    const MediumPtr m = medium("homogeneous", "<string name=\"material\" value=\"marble\"/>");
    const MediumCoefficients c = m->coefficients({}, rgb_);
    expect_rgb(c.sigma_s, {21.9f, 26.2f, 30.0f}, 1e-5f);
    expect_rgb(c.sigma_t - c.sigma_s, {0.021f, 0.041f, 0.071f}, 1e-5f);
    EXPECT_EQ(m->phase.kind(), PhaseFunction::Kind::isotropic);
}

TEST_F(Media, SurfaceColourIsInvertedBandByBand) {
    // Values of the group chiang2016 of the reference vectors: A = 0.2, 0.5, 0.8 at d = 0.5 mm.
    const std::string color = "<rgb name=\"surface_color\" value=\"0.2, 0.5, 0.8\"/>";
    const Vec3f sigma_t{0.6756756756756757f, 1.1661807580174928f, 1.8181818181818183f};
    const Vec3f sigma_s{0.41407165442817423f, 1.0639049536103355f, 1.8001685991370686f};
    const MediumPtr m = medium("homogeneous", color + "<float name=\"radius\" value=\"0.5\"/>");
    expect_rgb(m->coefficients({}, rgb_).sigma_t, sigma_t, 2e-6f);
    expect_rgb(m->coefficients({}, rgb_).sigma_s, sigma_s, 2e-6f);
    EXPECT_FALSE(m->is_spectral());
    // A radius twice as long halves the coefficients of its band.
    const MediumPtr rgb =
        medium("homogeneous", color + "<rgb name=\"radius\" value=\"0.5, 1, 0.25\"/>");
    expect_rgb(rgb->coefficients({}, rgb_).sigma_t, {sigma_t.x, 0.5f * sigma_t.y, 2.f * sigma_t.z},
               2e-6f);
    // Grey stays grey, and lengths are in millimetres.
    context_.mm_per_unit = 10.0;
    const MediumPtr grey = medium("homogeneous",
                                  "<float name=\"surface_color\" value=\"0.5\"/><float "
                                  "name=\"radius\" value=\"0.5\"/>");
    for (const Wavelengths& w : {rgb_, nm_}) {
        EXPECT_NEAR(grey->coefficients({}, w).sigma_t[1], 10.f * sigma_t.y, 1e-4f);
        EXPECT_NEAR(grey->coefficients({}, w).sigma_s[1], 10.f * sigma_s.y, 1e-4f);
    }
}

TEST_F(Media, SurfaceColourKeepsTheReducedScatteringOfAnyPhaseFunction) {
    const std::string color =
        "<float name=\"surface_color\" value=\"0.5\"/><float name=\"radius\" value=\"0.5\"/>";
    const MediumCoefficients c =
        medium("homogeneous",
               color + "<phase type=\"hg\"><float name=\"g\" value=\"0.6\"/></phase>")
            ->coefficients({}, rgb_);
    EXPECT_NEAR(c.sigma_s[0] * 0.4f, 1.0639049536103355f, 5e-6f);
    EXPECT_NEAR(c.sigma_t[0] - c.sigma_s[0], 1.1661807580174928f - 1.0639049536103355f, 5e-6f);
}

TEST_F(Media, SurfaceColourReachesBothEnds) {
    const auto albedo = [&](const char* color) {
        const MediumPtr m =
            medium("homogeneous",
                   fmt::format("<float name=\"surface_color\" value=\"{}\"/><float name=\"radius\" "
                               "value=\"2\"/>",
                               color));
        return m->albedo->eval(rgb_)[0];
    };
    EXPECT_EQ(albedo("0"), 0.f);
    EXPECT_NEAR(albedo("1"), 0.998886f, 1e-6f);
}

TEST_F(Media, SkinIsThatOfItsParameters) {
    context_.mm_per_unit = 10.0;
    const MediumPtr m = medium("skin", "");
    EXPECT_TRUE(m->homogeneous());
    EXPECT_TRUE(m->is_spectral());
    EXPECT_EQ(m->phase.kind(), PhaseFunction::Kind::isotropic);
    // 450, 520, 600, 680 nm are points of the table.
    const auto expect = [&](const MediumPtr& medium, const SkinParameters& skin, double g) {
        const MediumCoefficients c = medium->coefficients({}, nm_);
        for (int i = 0; i < 4; ++i) {
            const Layer one = skin_coefficients(skin, nm_.lambda[i]);
            const double s = 10. * one.sigma_s * (1. - one.g) / (1. - g), a = 10. * one.sigma_a;
            EXPECT_NEAR(c.sigma_s[i], s, 1e-5 * s) << i;
            EXPECT_NEAR(c.sigma_t[i] - c.sigma_s[i], a, 1e-6 * s + 1e-5 * a) << i;
        }
    };
    expect(m, {}, 0.);
    SkinParameters skin;
    skin.epidermis.melanin = 0.2;
    skin.papillary_dermis.blood = 0.04;
    skin.reticular_dermis.blood = skin.hypodermis.blood = 0.03;
    skin.oxygenation = 0.6;
    const std::string parameters =
        "<float name=\"melanin\" value=\"0.2\"/><float name=\"blood\" value=\"0.04\"/><float "
        "name=\"oxygenation\" value=\"0.6\"/>";
    expect(medium("skin", parameters), skin, 0.);
    expect(medium("skin", parameters + "<phase type=\"hg\"/>"), skin, 0.8);
    skin.melanin_model = MelaninModel::donner_jensen;
    skin.scattering_model = SkinScattering::donner_jensen;
    skin.eumelanin = 0.3;
    expect(medium("skin", parameters + "<string name=\"optics\" value=\"donner_jensen\"/><float "
                                       "name=\"eumelanin\" value=\"0.3\"/>"),
           skin, 0.);
}

TEST_F(Media, SkinCoversTheVisibleRange) {
    const MediumPtr m = medium("skin", "");
    for (float nm = visible_min; nm <= visible_max; nm += 1.f) {
        const MediumCoefficients c = m->coefficients({}, Wavelengths::at(Spectral(nm)));
        EXPECT_GT(c.sigma_s[0], 0.f) << nm;
        EXPECT_GT(c.sigma_t[0], c.sigma_s[0]) << nm;
        // Between the points of its table it is close to the model, most of all in the bands.
        const Layer one = skin_coefficients({}, nm);
        EXPECT_NEAR(c.sigma_t[0] - c.sigma_s[0], one.sigma_a, 0.02 * one.sigma_a) << nm;
    }
}

TEST_F(Media, AReferenceIsBuiltOnce) {
    root_ = read("<medium type=\"homogeneous\" id=\"fog\"/>");
    const SceneNode& node = *root_->children.at(0).node;
    EXPECT_EQ(make_medium(node, context_), make_medium(node, context_));
    EXPECT_EQ(make_medium(node, context_)->id, "fog");
}

TEST_F(Media, OptionsOfMitsubasIntegratorsAreAccepted) {
    EXPECT_NO_THROW(medium("homogeneous",
                           "<boolean name=\"has_spectral_extinction\" value=\"false\"/>"
                           "<boolean name=\"sample_emitters\" value=\"false\"/>"));
}

TEST_F(Media, PhaseFunctionsGoByTheirNames) {
    using Kind = PhaseFunction::Kind;
    for (const auto& [type, kind] : {std::pair{"isotropic", Kind::isotropic},
                                     {"rayleigh", Kind::rayleigh},
                                     {"hg", Kind::hg},
                                     {"mie_hazy", Kind::mie_hazy},
                                     {"mie_murky", Kind::mie_murky},
                                     {"schlick", Kind::schlick},
                                     {"cornette_shanks", Kind::cornette_shanks},
                                     {"two_term_hg", Kind::two_term_hg}})
        EXPECT_EQ(phase(fmt::format("<phase type=\"{}\"/>", type)).kind(), kind) << type;
    EXPECT_FLOAT_EQ(phase("<phase type=\"hg\"/>").mean_cosine(), 0.8f);
    EXPECT_FLOAT_EQ(
        phase("<phase type=\"hg\"><float name=\"g\" value=\"-0.3\"/></phase>").mean_cosine(),
        -0.3f);
    EXPECT_FLOAT_EQ(
        phase("<phase type=\"two_term_hg\"><float name=\"weight\" value=\"0.75\"/><float "
              "name=\"g1\" value=\"0.8\"/><float name=\"g2\" value=\"-0.4\"/></phase>")
            .mean_cosine(),
        0.75f * 0.8f - 0.25f * 0.4f);
}

TEST_F(Media, HeterogeneousMediaTakeConstantsAndVolumes) {
    const MediumPtr constant = medium("heterogeneous",
                                      "<volume name=\"sigma_t\" type=\"constvolume\"><float "
                                      "name=\"value\" value=\"2\"/></volume>");
    EXPECT_TRUE(constant->homogeneous());
    EXPECT_FLOAT_EQ(constant->coefficients({5.f, 5.f, 5.f}, rgb_).sigma_t[0], 2.f);
}

TEST_F(Media, WrongInputIsExplained) {
    const auto value = [](const char* tag, const char* name, const char* v) {
        return fmt::format("<{} name=\"{}\" value=\"{}\"/>", tag, name, v);
    };
    const std::string color = value("float", "surface_color", "0.5");
    const std::string radius = value("float", "radius", "1");
    struct Case {
        const char* type;
        std::string parameters, message;
    };
    for (
        const Case& c : {
            Case{"homogenous", "", "unknown medium type 'homogenous'; did you mean 'homogeneous'?"},
            {"homogeneous", value("float", "sigma_t", "-1"),
             "'sigma_t' must be finite and at least 0, but has the value -1"},
            {"homogeneous", value("rgb", "albedo", "0.5, 1.25, 0.5"),
             "'albedo' must lie within [0, 1], but has the value 1.25"},
            {"homogeneous", value("rgb", "albedo", "0.5, -0.5, 0.5"),
             "'albedo' must lie within [0, 1], but has the value -0.5"},
            {"homogeneous", value("spectrum", "albedo", "400:0.5, 700:2"),
             "'albedo' must lie within [0, 1], but has the value 2"},
            {"homogeneous", value("float", "scale", "-2"),
             "'scale' must be finite and at least 0, but has the value -2"},
            {"homogeneous", value("float", "sigma_s", "1"), "'sigma_s' needs 'sigma_a' as well"},
            {"homogeneous", value("float", "sigma_a", "1"), "'sigma_a' needs 'sigma_s' as well"},
            {"homogeneous",
             value("float", "sigma_a", "1") + value("float", "sigma_s", "1") +
                 value("float", "albedo", "1"),
             "give either 'sigma_t' and 'albedo' or 'sigma_s' and 'sigma_a', not a mixture"},
            {"homogeneous", value("string", "material", "marble") + value("float", "sigma_t", "1"),
             "give either 'material' or 'sigma_t', not both"},
            {"homogeneous", "<volume name=\"sigma_t\" type=\"gridvolume\"/>",
             "'sigma_t' of a homogeneous medium is the same everywhere; use <medium "
             "type=\"heterogeneous\"> for a gridvolume"},
            {"homogeneous", value("float", "sigmat", "1"),
             "<medium type=\"homogeneous\"> has no parameter 'sigmat'; did you mean 'sigma_t'?"},
            {"homogeneous", "<phase type=\"hg\"/><phase type=\"hg\"/>",
             "a medium has only one phase function"},
            {"homogeneous", "<phase type=\"hgg\"/>",
             "unknown phase function 'hgg'; did you mean 'hg'?"},
            {"homogeneous", "<phase type=\"hg\">" + value("float", "g", "1") + "</phase>",
             "'g' must lie between -1 and 1, exclusive, but has the value 1"},
            {"homogeneous",
             "<phase type=\"schlick\">" + value("float", "g", "0.5") + value("float", "k", "0.5") +
                 "</phase>",
             "give either 'k' or 'g', not both"},
            {"homogeneous", value("float", "surface_color", "0.5"),
             "'surface_color' needs 'radius' as well"},
            {"homogeneous", value("float", "radius", "1"),
             "'radius' needs 'surface_color' as well"},
            {"homogeneous", value("rgb", "surface_color", "0.5, 1.5, 0.5") + radius,
             "'surface_color' must lie within [0, 1], but has the value 1.5"},
            {"homogeneous", value("float", "surface_color", "-0.25") + radius,
             "'surface_color' must lie within [0, 1], but has the value -0.25"},
            {"homogeneous", color + value("rgb", "radius", "1, 0, 1"),
             "'radius' must be finite and positive, but has the value 0"},
            {"homogeneous", color + value("float", "radius", "-1"),
             "'radius' must be finite and positive, but has the value -1"},
            {"homogeneous", value("spectrum", "surface_color", "400:0.5, 700:0.2") + radius,
             "'surface_color' must be a number or a colour in RGB"},
            {"homogeneous", color + "<volume name=\"radius\" type=\"constvolume\"/>",
             "'radius' must be a number or a colour in RGB"},
            {"homogeneous", color + radius + value("string", "material", "marble"),
             "give either 'surface_color' and 'radius' or 'material', not a mixture"},
            {"homogeneous", color + radius + value("float", "albedo", "0.5"),
             "give either 'surface_color' and 'radius' or 'albedo', not a mixture"},
            {"heterogeneous", color,
             "<medium type=\"heterogeneous\"> has no parameter 'surface_color'; known are: albedo, "
             "has_spectral_extinction, sample_emitters, scale, sigma_t"},
            {"skin", value("float", "melanin", "1.5"),
             "'melanin' of <medium type=\"skin\"> must lie within [0, 1]; got 1.5"},
            {"skin", value("float", "blood", "-0.1"),
             "'blood' of <medium type=\"skin\"> must lie within [0, 1]; got -0.1"},
            {"skin", value("float", "oxygenation", "75"),
             "'oxygenation' of <medium type=\"skin\"> must lie within [0, 1]; got 75"},
            {"skin", value("string", "optics", "donner_jensen") + value("float", "eumelanin", "2"),
             "'eumelanin' of <medium type=\"skin\"> must lie within [0, 1]; got 2"},
            {"skin", value("float", "eumelanin", "0.5"),
             "'eumelanin' is a parameter of 'optics' donner_jensen; jacques has one melanin"},
            {"skin", value("string", "optics", "jaques"),
             "'optics' of <medium type=\"skin\"> cannot be 'jaques'; did you mean 'jacques'?"},
            {"skin", value("float", "melanine", "0.1"),
             "<medium type=\"skin\"> has no parameter 'melanine'; did you mean 'melanin'?"},
            {"skin", value("float", "scale", "-2"),
             "'scale' must be finite and at least 0, but has the value -2"},
            {"heterogeneous",
             "<volume name=\"sigma_t\" type=\"constvolume\">" + value("float", "value", "-3") +
                 "</volume>",
             "'value' must be finite and at least 0, but has the value -3"},
            {"heterogeneous", "<volume name=\"albedo\" type=\"gridvolum\"/>",
             "unknown volume type 'gridvolum'; did you mean 'gridvolume'?"},
            {"heterogeneous", value("string", "material", "marble"),
             "<medium type=\"heterogeneous\"> has no parameter 'material'; known are: albedo, "
             "has_spectral_extinction, sample_emitters, scale, sigma_t"},
        }) {
        const std::string error = error_of([&] { medium(c.type, c.parameters); });
        EXPECT_TRUE(error.starts_with("scene.xml:2:")) << error;
        EXPECT_EQ(error.substr(std::min(error.size(), error.find(' ') + 1)), c.message);
    }
    const std::string unknown =
        error_of([&] { medium("homogeneous", "<string name=\"material\" value=\"marbel\"/>"); });
    EXPECT_TRUE(unknown.starts_with("scene.xml:2:") && unknown.find("Marble") != unknown.npos)
        << unknown;
}

}  // namespace
}  // namespace nacre
