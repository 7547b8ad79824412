// Settings from text, and the values that they become.
#include "nacre/catalogue/settings.h"

#include "nacre/math/random.h"
#include "nacre/spectrum/spectrum.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::error_of;

enum class Points { elimination, repulsion, random };

const std::vector<Parameter>& parameters() {
    static const std::vector<Parameter> all = {
        {.name = "spacing", .meaning = "", .high = 100., .above_low = true, .otherwise = 1.},
        {.name = "irradiance_samples",
         .meaning = "",
         .kind = ParameterKind::integer,
         .low = 1.,
         .high = 65536.,
         .otherwise = 8.,
         .aliases = {"irr_samples"}},
        choice_parameter("points", "",
                         {{"elimination", ""}, {"repulsion", "", {"pushed"}}, {"random", ""}}, 1),
        {.name = "ks", .meaning = "", .kind = ParameterKind::spectrum, .aliases = {"k"}},
        {.name = "kd",
         .meaning = "",
         .kind = ParameterKind::spectrum,
         .high = 10.,
         .otherwise = 0.5,
         .aliases = {"k"}},
        {.name = "lambda", .meaning = "", .kind = ParameterKind::wavelength, .high = 1000.}};
    return all;
}

ParameterValues values(std::string_view text) {
    return ParameterValues("way", parameters(), parse_settings(text));
}

}  // namespace

TEST(Settings, AreReadFromText) {
    const Settings expected = {
        {"variant", "duer"},   {"alpha", 0.2}, {"ks", Vec3f(0.1f, 0.3f, 0.2f)},
        {"n", -1e-3},          {"m", 5.},      {"way", "inverse"},  // begins as infinity does
        {"how", "nanometres"}, {"x", infinite}};
    EXPECT_EQ(parse_settings("variant=duer  alpha=0.2 ks=.1,3e-1,+0.2 n=-1e-3 m=+5 way=inverse "
                             "how=nanometres x=inf "),
              expected);
    EXPECT_TRUE(parse_settings("  ").empty());
}

TEST(Settings, WrongTextIsRefused) {
    const std::pair<const char*, const char*> cases[] = {
        {"kd", "'kd' does not set a parameter; write name=value, such as alpha=0.2"},
        {"=1", "'=1' does not set a parameter; write name=value, such as alpha=0.2"},
        {"kd=", "'kd=' does not set a parameter; write name=value, such as alpha=0.2"},
        {"kd=1x", "'1x' in 'kd=1x' is not a number"},
        {"kd=-.5.5", "'-.5.5' in 'kd=-.5.5' is not a number"},
        {"kd=0.1,0.2", "'kd=0.1,0.2' must have one number or three (red,green,blue)"},
        {"kd=1,2,3,4", "'kd=1,2,3,4' must have one number or three (red,green,blue)"},
        {"kd=0.1,0.2,x", "'x' in 'kd=0.1,0.2,x' is not a number"},
        {"kd=0.1,,1", "'' in 'kd=0.1,,1' is not a number"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_EQ(error_of([&] { parse_settings(text); }), message);
}

TEST(Settings, TextIsReadAsWhatWasWritten) {
    Random random(3);
    const auto anything = [&] {
        return std::bit_cast<float>(0x00800000u + std::uint32_t(random.next() * 0x7effffffu));
    };
    for (int i = 0; i < 1000; ++i) {
        const Settings settings = {
            {"a", double(anything()) * (1. + random.next() * 1e-9)},
            {"word", "v_cavity"},
            {"colour", Vec3f(anything(), random.next(), -anything())},
        };
        EXPECT_EQ(parse_settings(settings_text(settings)), settings) << settings_text(settings);
    }
    EXPECT_EQ(settings_text({{"a", 0.1}, {"b", Vec3f(0.1f, 1.f, 1e-5f)}, {"n", 1e6}}),
              "a=0.1 b=0.1,1,1e-05 n=1000000");
    EXPECT_EQ(settings_text({}), "");
}

TEST(ParameterValues, WhatIsNotSetHasItsDefault) {
    const ParameterValues v = values("");
    EXPECT_EQ(v.size(), 6u);
    EXPECT_EQ(v.number("spacing"), 1.);
    EXPECT_EQ(v.whole("irradiance_samples"), 8);
    EXPECT_EQ(v.choice<Points>("points"), Points::repulsion);
    EXPECT_EQ(v.word("points"), "repulsion");
    EXPECT_EQ(v.number("kd"), 0.5);
    for (const Parameter& p : parameters()) EXPECT_FALSE(v.given(p.name)) << p.name;
}

TEST(ParameterValues, SettingsAreReadByName) {
    const ParameterValues v = values("spacing=2.5 irr_samples=12 points=random ks=0.1,0.2,0.3");
    EXPECT_EQ(v.number("spacing"), 2.5);
    EXPECT_EQ(v.whole("irradiance_samples"), 12);
    EXPECT_EQ(v.number("irradiance_samples"), 12.);
    EXPECT_EQ(v.choice<Points>("points"), Points::random);
    EXPECT_TRUE(v.given("irradiance_samples"));
    EXPECT_FALSE(v.given("kd"));
    ASSERT_TRUE(v[3].spectrum);
    EXPECT_FLOAT_EQ(v[3].spectrum->eval(Wavelengths::rgb_bands())[1], 0.2f);
    EXPECT_EQ(v[1].given, "irr_samples");
    EXPECT_EQ(v.parameters().data(), parameters().data());
    // A choice by its alias, and an alias that means two.
    EXPECT_EQ(values("points=pushed").word("points"), "repulsion");
    const ParameterValues both = values("k=0.25");
    EXPECT_EQ(both.number("ks") + both.number("kd"), 0.5);
}

// As attributes of scene files come: numbers are then text.
TEST(ParameterValues, NumbersMayComeAsWords) {
    const ParameterValues v("way", parameters(),
                            {{"spacing", "2.5"}, {"irradiance_samples", "16"}, {"lambda", "550"}});
    EXPECT_EQ(v.number("spacing"), 2.5);
    EXPECT_EQ(v.whole("irradiance_samples"), 16);
    EXPECT_EQ(v.number("lambda"), 550.);
}

TEST(ParameterValues, WrongSettingsAreRefused) {
    const std::pair<const char*, const char*> cases[] = {
        {"spacing=0", "way: spacing = 0 is out of range: must lie within (0, 100]"},
        {"spacing=nan", "way: spacing = nan is out of range: must lie within (0, 100]"},
        {"spacing=-inf", "way: spacing = -inf is out of range: must lie within (0, 100]"},
        {"spacing=1e999", "way: spacing = inf is out of range: must lie within (0, 100]"},
        {"spacing=wide", "way: spacing = 'wide' must be a number within (0, 100]"},
        {"spacing=1,2,3", "way: spacing is one number, not a colour or spectrum"},
        {"irradiance_samples=1.5", "way: irradiance_samples = 1.5 must be a whole number"},
        {"irradiance_samples=many",
         "way: irradiance_samples = 'many' must be a whole number within [1, 65536]"},
        {"points=repulsive", "way: unknown points 'repulsive'; did you mean 'repulsion'?"},
        {"points=1", "way: unknown points '1'; known are: elimination, repulsion, random"},
        {"points=1,0,0",
         "way: unknown points 'a colour'; known are: elimination, repulsion, random"},
        {"ks=0.1,1.5,0.2", "way: ks = 1.5 is out of range: must lie within [0, 1]"},
        {"spaceing=1", "way: unknown parameter 'spaceing'; did you mean 'spacing'?"},
        {"spacing=1 spacing=1", "way: spacing is given twice, as 'spacing' and 'spacing'"},
        {"k=0.1 kd=0.2", "way: kd is given twice, as 'k' and 'kd'"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_EQ(error_of([&] { values(text); }), message) << text;
    EXPECT_EQ(error_of([] {
                  ParameterValues("way", parameters(), {{"ks", make_constant(2.f)}});
              }),
              "way: ks = 2 is out of range: must lie within [0, 1]");
    EXPECT_EQ(error_of([] {
                  ParameterValues("way", {}, {{"ks", 1.}});
              }),
              "way: it has no parameter 'ks', nor any other");
}

TEST(ParameterValues, AskingWrongIsAMistakeOfTheProgram) {
    const ParameterValues v = values("ks=0.1,0.2,0.3");
    EXPECT_THROW(v.number("space"), std::logic_error);
    EXPECT_THROW(v.given("k"), std::logic_error);  // an alias is no name
    EXPECT_THROW(v.number("points"), std::logic_error);
    EXPECT_THROW(v.number("ks"), std::logic_error);  // a spectrum
    EXPECT_THROW(v.whole("spacing"), std::logic_error);
    EXPECT_THROW(v.word("spacing"), std::logic_error);
    EXPECT_THROW(v.choice<Points>("spacing"), std::logic_error);
}

}  // namespace nacre
