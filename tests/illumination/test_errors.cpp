// Descriptions, names, and the messages for wrong parameters.
#include "tests/illumination/reference.h"
#include "tests/support/error_of.h"

namespace nacre::illumination {
namespace {

using test::error_of;

TEST(IlluminationModels, AreFoundByNumberAndName) {
    ASSERT_EQ(models().size(), 23u);
    for (const Description* d : models()) {
        EXPECT_EQ(&models().find(std::to_string(d->number)), d);
        EXPECT_EQ(&models().find(d->name), d);
    }
    EXPECT_EQ(models().find("Blinn-Phong").number, 15);
    EXPECT_EQ(models().find("Romney").year, 1969);
}

TEST(IlluminationModels, DescriptionsAreComplete) {
    for (const Description* d : models()) {
        EXPECT_FALSE(d->title.empty() || d->authors.empty() || d->source.empty() ||
                     d->formula.empty() || d->properties.empty())
            << d->name;
        EXPECT_TRUE(d->year >= 1969 && d->year <= 2004) << d->name;
        for (const Parameter& p : d->parameters) {
            EXPECT_FALSE(p.meaning.empty()) << d->name;
            EXPECT_LE(d->parameters.size(), Values<float>::largest) << d->name;
            EXPECT_EQ(p.choices.empty(), p.kind != ParameterKind::choice) << d->name;
            EXPECT_NO_THROW(check_range(d->name, p, p.otherwise)) << d->name << " " << p.name;
        }
    }
}

TEST(IlluminationModels, UnknownNamesAreRefused) {
    EXPECT_EQ(error_of([] { models().find("romny"); }),
              "unknown illumination model 'romny'; did you mean 'romney'?");
    for (const char* number : {"0", "24", "-1", "1.5"})
        EXPECT_TRUE(error_of([&] { models().find(number); })
                        .starts_with(fmt::format("unknown illumination model '{}'; known are: "
                                                 "bouknight_ambient, ",
                                                 number)))
            << number;
}

TEST(IlluminationModels, WrongParametersAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const struct {
        const char* model;
        std::string_view parameter;
        double value;
        const char* message;
    } cases[] = {
        {"1", "ka", 1.5, "bouknight_ambient: ka = 1.5 is out of range: must lie within [0, 1]"},
        {"2", "f", -0.1, "cook_torrance_ambient: f = -0.1 is out of range: must lie within [0, 1]"},
        {"5", "kd", -1., "romney: kd = -1 is out of range: must lie within [0, inf)"},
        {"10", "dk", 0., "foley_van_dam_diffuse: dk = 0 is out of range: must lie within (0, inf)"},
        {"13", "ks", 1.01, "phong: ks = 1.01 is out of range: must lie within [0, 1]"},
        {"13", "m", -1., "phong: m = -1 is out of range: must lie within [0, inf)"},
        {"13", "m", nan, "phong: m = nan is out of range: must lie within [0, inf)"},
        {"13", "m", infinite, "phong: m = inf is out of range: must lie within [0, inf)"},
        {"18", "beta", 90.,
         "blinn_torrance_sparrow: beta = 90 is out of range: must lie within (0, 90)"},
        {"18", "beta", 0.,
         "blinn_torrance_sparrow: beta = 0 is out of range: must lie within (0, 90)"},
        {"19", "m", 0., "cook_torrance: m = 0 is out of range: must lie within (0, inf)"},
        {"19", "beta", 90., "cook_torrance: beta = 90 is out of range: must lie within [0, 90)"},
        {"20", "sigma0", 0., "he_torrance: sigma0 = 0 is out of range: must lie within (0, inf)"},
        {"21", "kt", 2., "linear_transparency: kt = 2 is out of range: must lie within [0, 1]"},
        {"23", "n", 0., "hall_transparency: n = 0 is out of range: must lie within (0, inf)"},
    };
    for (const auto& c : cases) {
        const Description& model = models().find(c.model);
        const auto p = std::ranges::find(model.parameters, c.parameter, &Parameter::name);
        ASSERT_NE(p, model.parameters.end()) << c.parameter;
        EXPECT_EQ(error_of([&] { check_range(model.name, *p, c.value); }), c.message);
    }
    const Description& blinn = models().find("18");
    EXPECT_EQ(error_of([&] { find_choice(blinn.name, blinn.parameters[0], "ggx"); }),
              "blinn_torrance_sparrow: unknown distribution 'ggx'; known are: phong, "
              "torrance_sparrow, trowbridge_reitz");
}

}  // namespace
}  // namespace nacre::illumination
