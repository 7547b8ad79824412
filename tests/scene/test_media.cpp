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
    struct Case {
        const char* type;
        std::string parameters, message;
    };
    for (const Case& c : {
             Case{"homogenous", "",
                  "unknown medium type 'homogenous'; did you mean 'homogeneous'?"},
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
