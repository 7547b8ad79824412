// Models by name: what users get to read when something is wrong.
#include "nacre/reflectance/registry.h"

#include "nacre/math/error.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::error_of;

}  // namespace

TEST(Registry, SaysWhatIsWrongWithParameters) {
    const std::pair<const char*, const char*> wrong[] = {
        {"ward alpha=0", "ward: alpha_u = 0 is out of range: must lie within (0, 10]"},
        {"ward alpha_v=-0.1", "ward: alpha_v = -0.1 is out of range: must lie within (0, 10]"},
        {"ward alpha=nan", "ward: alpha_u = nan is out of range: must lie within (0, 10]"},
        {"ward alpha=inf", "ward: alpha_u = inf is out of range: must lie within (0, 10]"},
        {"ward alpha=0.1 alpha_u=0.2", "ward: alpha_u is given twice, as 'alpha' and 'alpha_u'"},
        {"ward alpa=0.1", "ward: unknown parameter 'alpa'; did you mean 'alpha_u'?"},
        {"ward variant=balance",
         "ward: unknown variant 'balance'; known are: gmd, original, fast, duer"},
        {"ward variant=2", "ward: unknown variant '2'; known are: gmd, original, fast, duer"},
        {"ward alpha=wide", "ward: alpha_u = 'wide' must be a number within (0, 10]"},
        {"ward alpha=0.1,0.2,0.3", "ward: alpha_u is one number, not a colour or spectrum"},
        {"phong kd=0.8 ks=0.3",
         "phong: kd + ks = 1.1 is out of range: must lie within [0, 1], lest energy appear from "
         "nowhere"},
        {"phong n=-2", "phong: n = -2 is out of range: must lie within [0, 1000000]"},
        {"phong kd=0.1,0.2", "'kd=0.1,0.2' must have one number or three (red,green,blue)"},
        {"phong kd=0.1,0.2,x", "'x' in 'kd=0.1,0.2,x' is not a number"},
        {"phong kd=1x", "'1x' in 'kd=1x' is not a number"},
        {"phong kd", "'kd' does not set a parameter; write name=value, such as alpha=0.2"},
    };
    for (const auto& [text, expected] : wrong) {
        const std::string_view all = text;
        const std::size_t space = all.find(' ');
        EXPECT_EQ(error_of([&] {
                      make_model(all.substr(0, space), parse_settings(all.substr(space + 1)));
                  }),
                  expected);
    }
}

TEST(Registry, SuggestsTheNearestModel) {
    EXPECT_EQ(error_of([] { make_model("fong"); }).substr(0, 33),
              "unknown reflectance model 'fong';");
    EXPECT_NE(error_of([] { make_model("wart"); }).find("did you mean 'ward'?"), std::string::npos);
}

TEST(Registry, DefaultsAndAliasesAreTheDescriptions) {
    const ValuesD v =
        make_model("ward", parse_settings("form=duer alpha=0.25")).values_double(550.);
    EXPECT_EQ(v.option[0], 3);
    EXPECT_EQ(v.color[1], 0.5);
    EXPECT_EQ(v.color[2], 0.2);
    EXPECT_EQ(v.scalar[3], 0.25);
    EXPECT_EQ(v.scalar[4], 0.25);
}

TEST(Registry, ColoursVaryWithTheWavelength) {
    const AnyModel red = make_model("lambert", parse_settings("reflectance=0.8,0.1,0.1"));
    const Vec3d up{0., 0., 1.};
    EXPECT_GT(red.eval(up, up, 650.), 3. * red.eval(up, up, 500.));
    const Spectral bands = red.eval(Vec3f(up), Vec3f(up), Wavelengths::rgb_bands());
    EXPECT_NEAR(bands[0] * std::numbers::pi, 0.8, 1e-3);
    EXPECT_NEAR(bands[1] * std::numbers::pi, 0.1, 1e-3);
}

TEST(Registry, BulkEvaluationNeedsEquallyManyDirections) {
    std::vector<Vec3f> wi(3, {0.f, 0.f, 1.f}), wo(2, {0.f, 0.f, 1.f});
    std::vector<float> out(3);
    EXPECT_EQ(error_of([&] { make_model("phong").eval_many(wi, wo, out); }),
              "phong: 3 directions wi, 2 directions wo and 3 results must be equally many");
}

// The parameters that a model visits are those that it describes, in the same order.
TEST(Registry, ParametersAreVisitedInTheOrderOfTheDescription) {
    for (const ModelDescription* m : models())
        for (std::size_t i = 0; i < m->parameters.size(); ++i)
            EXPECT_EQ(find_evaluator(m->name).parameter_names().at(i), m->parameters[i].name);
}

}  // namespace nacre
