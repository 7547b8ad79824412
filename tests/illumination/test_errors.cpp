// Descriptions, names, and the messages for wrong parameters.
#include "nacre/math/error.h"
#include "tests/illumination/reference.h"

namespace nacre::illumination {
namespace {

template <class F>
std::string error_of(F&& action) {
    try {
        action();
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

TEST(IlluminationModels, AreFoundByNumberAndName) {
    ASSERT_EQ(descriptions().size(), 23u);
    for (const Description* d : descriptions()) {
        EXPECT_EQ(&find_model(std::to_string(d->number)), d);
        EXPECT_EQ(&find_model(d->name), d);
    }
    EXPECT_EQ(find_model("Blinn-Phong").number, 15);
    EXPECT_EQ(find_model("Romney").year, 1969);
}

TEST(IlluminationModels, DescriptionsAreComplete) {
    for (const Description* d : descriptions()) {
        EXPECT_FALSE(d->title.empty() || d->authors.empty() || d->source.empty() ||
                     d->formula.empty() || d->properties.empty())
            << d->name;
        EXPECT_TRUE(d->year >= 1969 && d->year <= 2004) << d->name;
        for (const Parameter& p : d->parameters) {
            EXPECT_FALSE(p.meaning.empty()) << d->name;
            EXPECT_EQ(p.choices.empty(), p.kind != Parameter::Kind::choice) << d->name;
            EXPECT_NO_THROW(check_value(*d, p, p.otherwise)) << d->name << " " << p.name;
        }
    }
}

TEST(IlluminationModels, UnknownNamesAreRefused) {
    EXPECT_EQ(error_of([] { find_model("0"); }), "illumination models are numbered 1 to 23; got 0");
    EXPECT_EQ(error_of([] { find_model("24"); }),
              "illumination models are numbered 1 to 23; got 24");
    const std::string misspelt = error_of([] { find_model("romny"); });
    EXPECT_NE(misspelt.find("illumination model \"romny\""), misspelt.npos) << misspelt;
    EXPECT_NE(misspelt.find("romney"), misspelt.npos) << misspelt;
}

TEST(IlluminationModels, WrongParametersAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const struct {
        const char* model;
        std::string_view parameter;
        double value;
        const char* message;
    } cases[] = {
        {"1", "ka", 1.5,
         "'ka' of illumination model 1 (bouknight_ambient) must be within [0, 1]; got 1.5"},
        {"2", "f", -0.1,
         "'f' of illumination model 2 (cook_torrance_ambient) must be within [0, 1]; got -0.1"},
        {"5", "kd", -1., "'kd' of illumination model 5 (romney) must be at least 0; got -1"},
        {"10", "dk", 0.,
         "'dk' of illumination model 10 (foley_van_dam_diffuse) must be greater than 0; got 0"},
        {"13", "ks", 1.01, "'ks' of illumination model 13 (phong) must be within [0, 1]; got 1.01"},
        {"13", "m", -1., "'m' of illumination model 13 (phong) must be at least 0; got -1"},
        {"13", "m", nan, "'m' of illumination model 13 (phong) must be at least 0; got nan"},
        {"13", "m", unlimited, "'m' of illumination model 13 (phong) must be at least 0; got inf"},
        {"18", "beta", 90.,
         "'beta' of illumination model 18 (blinn_torrance_sparrow) must be within (0, 90); got 90"},
        {"18", "beta", 0.,
         "'beta' of illumination model 18 (blinn_torrance_sparrow) must be within (0, 90); got 0"},
        {"19", "m", 0.,
         "'m' of illumination model 19 (cook_torrance) must be greater than 0; got 0"},
        {"19", "beta", 90.,
         "'beta' of illumination model 19 (cook_torrance) must be within [0, 90); got 90"},
        {"20", "sigma0", 0.,
         "'sigma0' of illumination model 20 (he_torrance) must be greater than 0; got 0"},
        {"21", "kt", 2.,
         "'kt' of illumination model 21 (linear_transparency) must be within [0, 1]; got 2"},
        {"23", "n", 0.,
         "'n' of illumination model 23 (hall_transparency) must be greater than 0; got 0"},
    };
    for (const auto& c : cases) {
        const Description& model = find_model(c.model);
        const auto p = std::ranges::find(model.parameters, c.parameter, &Parameter::name);
        ASSERT_NE(p, model.parameters.end()) << c.parameter;
        EXPECT_EQ(error_of([&] { check_value(model, *p, c.value); }), c.message);
    }
    const Description& blinn = find_model("18");
    EXPECT_EQ(
        error_of([&] { find_choice(blinn, blinn.parameters[0], "ggx"); }),
        "'distribution' of illumination model 18 (blinn_torrance_sparrow) must be one of phong, "
        "torrance_sparrow, trowbridge_reitz; got 'ggx'");
}

}  // namespace
}  // namespace nacre::illumination
