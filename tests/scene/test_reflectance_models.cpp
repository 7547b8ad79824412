// Reflectance models as materials of a scene.
#include "nacre/math/random.h"
#include "nacre/reflectance/registry.h"
#include "tests/scene/bands.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

using test::bsdf;
using test::child;
using test::node;
using test::number;
using test::rgb;
using test::text;

const Vec3f wi{0.48f, 0.36f, 0.8f}, wo{-0.6f, 0.f, 0.8f};

}  // namespace

TEST(ReflectanceModels, AreMaterials) {
    for (const ModelDescription* m : models()) {
        const MaterialPtr material = test::material(bsdf(std::string(m->name)));
        const AnyModel model = make_model(m->name);
        const test::Bound bound(material);
        const Spectral f = bound->eval(wi, wo);
        const Spectral expected = model.eval(wi, wo, bands) * wi.z;
        for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(f[i], expected[i]) << m->name;
        EXPECT_EQ(bound->eval(wi, {0.6f, 0.f, -0.8f})[0], 0.f) << m->name;
        Random random(stream_key(3, 1));
        for (int i = 0; i < 50; ++i) {
            const float u1 = random.next();
            const auto s = bound->sample(wo, u1, random.next2());
            if (!s || s->delta) continue;
            EXPECT_FLOAT_EQ(s->pdf, bound->pdf(s->wi, wo)) << m->name;
            const Spectral e = bound->eval(s->wi, wo);
            EXPECT_NEAR(s->weight[1], e[1] / s->pdf, 1e-5f * s->weight[1]) << m->name;
        }
    }
}

// The names of Mitsuba 3 and 0.6, and the values of what Mitsuba calls phong and ward (0.6, the
// variants "ward", "ward-duer", "balanced"), written out.
TEST(ReflectanceModels, TakeTheNamesOfOtherRenderers) {
    const auto phong =
        test::bound(bsdf("phong", {number("exponent", 2.), rgb("diffuse_reflectance", {}),
                                   number("specularReflectance", 0.5)}));
    // 0.5 (2 + 2)/(2 pi) (R.wo)^2 cos, R.wo = 0.48 * 0.6 + 0.64 = 0.928
    EXPECT_NEAR(phong->eval(wi, wo)[0], 0.5 * 2. / M_PI * 0.928 * 0.928 * 0.8, 1e-6);

    const auto ward = [](const char* variant) {
        return test::bound(
                   bsdf("ward", {text("variant", variant), number("alphaU", 0.2),
                                 number("alphaV", 0.4), number("kd", 0.), number("ks", 0.5)}))
            ->eval(wi, wo)[1];
    };
    const double x = -0.12, y = 0.36, z = 1.6;  // wi + wo
    const double e = std::exp(-(x * x / 0.04 + y * y / 0.16) / (z * z));
    const double norm = 0.5 / (M_PI * 0.08) * e;
    EXPECT_NEAR(ward("ward"), norm / 4. / 0.8 * 0.8, 1e-6);
    EXPECT_NEAR(ward("ward-duer"), norm / 4. / 0.64 * 0.8, 1e-6);
    EXPECT_NEAR(ward("balanced"), norm * (x * x + y * y + z * z) / std::pow(z, 4) * 0.8, 1e-6);
}

TEST(ReflectanceModels, OneNameSetsBothRoughnesses) {
    const auto value = [](std::vector<SceneValue> v) {
        return test::bound(bsdf("ward", std::move(v)))->eval(wi, wo)[0];
    };
    EXPECT_EQ(value({number("alpha", 0.3)}),
              value({number("alpha_u", 0.3), number("alpha_v", 0.3)}));
    EXPECT_NE(value({number("alpha", 0.3)}), value({number("alpha_u", 0.3)}));
}

TEST(ReflectanceModels, ShapeAndColourMayBeTextures) {
    const auto squares = [](double a, double b) {
        return node("texture", "checkerboard", {number("color0", a), number("color1", b)});
    };
    const MaterialPtr m = test::material(
        bsdf("phong", {}, {child(squares(0.1, 0.7), "ks"), child(squares(5., 50.), "n")}));
    SurfacePoint at;
    for (const auto& [u, ks, n] : {std::tuple{0.25f, 0.1, 5.}, {0.75f, 0.7, 50.}}) {
        at.uv = {u, 0.25f};
        const AnyModel model = make_model("phong", {{"ks", ks}, {"n", n}}, Bounds::ranges_only);
        EXPECT_NEAR(test::Bound(m, at)->eval(wi, wo)[0], model.eval(wi, wo) * wi.z, 1e-6);
    }
}

TEST(ReflectanceModels, SayWhatIsWrongWithTheirParameters) {
    struct Wrong {
        SceneNodePtr node;
        std::string message;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Wrong wrong[] = {
        {bsdf("ward", {number("alpha", 0.)}),
         "test.xml:2:5: ward: alpha_u = 0 is out of range: must lie within (0, 10]"},
        {bsdf("ward", {number("alpha", nan)}),
         "test.xml:2:5: ward: alpha_u = nan is out of range: must lie within (0, 10]"},
        {bsdf("phong", {number("n", -1.)}),
         "test.xml:2:5: phong: n = -1 is out of range: must lie within [0, 1000000]"},
        {bsdf("phong", {number("kd", 0.75), number("ks", 0.5)}),
         "test.xml:1:1: phong: kd + ks = 1.25 is out of range: must lie within [0, 1], lest energy "
         "appear from nowhere"},
        {bsdf("phong", {number("kd", 1.5)}),
         "test.xml:2:5: 'kd' of <bsdf type=\"phong\"> must lie within [0, 1], lest energy appear "
         "from nowhere; got 1.5"},
        {bsdf("phong", {number("exponents", 3.)}),
         "test.xml:2:5: <bsdf type=\"phong\"> has no parameter 'exponents'; did you mean "
         "'exponent'?"},
        {bsdf("phong", {number("n", 3.), number("exponent", 4.)}),
         "test.xml:2:5: <bsdf type=\"phong\"> takes either 'n' or 'exponent', not both"},
        {bsdf("ward", {text("variant", "dur")}),
         "test.xml:2:5: ward: unknown variant 'dur'; did you mean 'duer'?"},
        {bsdf("wart"), "test.xml:1:1: unknown bsdf type 'wart'; did you mean 'ward'?"},
    };
    for (const Wrong& w : wrong) EXPECT_EQ(test::error_of(w.node), w.message);
}

// One colour in red and one in blue do not add up.
TEST(ReflectanceModels, SumsAreBoundedWavelengthByWavelength) {
    const auto error_of = [](SceneValue kd, SceneValue ks) {
        return test::error_of(bsdf("phong", {std::move(kd), std::move(ks)}));
    };
    const Vec3f red{0.9f, 0.f, 0.f}, blue{0.f, 0.f, 0.9f}, dark_red{0.3f, 0.f, 0.f};
    EXPECT_EQ(error_of(rgb("kd", red), rgb("ks", blue)), "");
    EXPECT_NE(error_of(rgb("kd", red), rgb("ks", dark_red)), "");
    const auto rises = test::tabulated("kd", {300.f, 900.f}, {0.f, 1.f});
    EXPECT_EQ(error_of(rises, test::tabulated("ks", {300.f, 900.f}, {1.f, 0.f})), "");
    EXPECT_EQ(error_of(rises, test::tabulated("ks", {300.f, 900.f}, {0.5f, 0.5f})).substr(0, 30),
              "test.xml:1:1: phong: kd + ks =");
}

}  // namespace nacre
