// Parameters that describe themselves: ranges, words and names.
#include "nacre/catalogue/parameter.h"

#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::error_of;

struct Range {
    double low, high;
    bool above_low, below_high;
    std::string text;
    std::vector<double> inside, outside;
};

Parameter parameter(const Range& r) {
    return {.name = "x",
            .meaning = "",
            .low = r.low,
            .high = r.high,
            .above_low = r.above_low,
            .below_high = r.below_high};
}

}  // namespace

TEST(Parameters, RangesHaveTheirEndsOrNot) {
    const Range ranges[] = {
        {0., 1., false, false, "[0, 1]", {0., 0.5, 1.}, {-1e-300, 1.0000001}},
        {0., 1., true, false, "(0, 1]", {1e-300, 1.}, {0., -0., 1.1}},
        {0., 90., false, true, "[0, 90)", {0., 89.999}, {90., -1.}},
        {-1., 1., true, true, "(-1, 1)", {-0.999, 0.999}, {-1., 1.}},
        {0., infinite, false, false, "[0, inf)", {0., 1e300}, {-1.}},
        {-infinite, 2., false, false, "(-inf, 2]", {-1e300, 2.}, {2.1}},
    };
    for (const Range& r : ranges) {
        const Parameter p = parameter(r);
        EXPECT_EQ(range_text(p), r.text);
        for (const double x : r.inside) EXPECT_NO_THROW(check_range("m", p, x)) << r.text << x;
        for (const double x : r.outside)
            EXPECT_EQ(error_of([&] { check_range("m", p, x); }),
                      fmt::format("m: x = {} is out of range: must lie within {}", x, r.text));
        for (const double x : {nan, infinite, -infinite})
            EXPECT_EQ(error_of([&] { check_range("m", p, x); }),
                      fmt::format("m: x = {} is out of range: must lie within {}", x, r.text));
    }
}

TEST(Parameters, WholeNumbersAreWhole) {
    const Parameter p{.name = "count", .meaning = "", .kind = ParameterKind::integer, .high = 9.};
    EXPECT_NO_THROW(check_range("m", p, 9.));
    EXPECT_EQ(error_of([&] { check_range("m", p, 1.5); }), "m: count = 1.5 must be a whole number");
    EXPECT_EQ(error_of([&] { check_range("m", p, 9.5); }),
              "m: count = 9.5 is out of range: must lie within [0, 9]");
}

TEST(Parameters, ChoicesAreFoundByTheirWords) {
    const Parameter p = choice_parameter(
        "variant", "", {{"gmd", "", {"balanced"}}, {"fast", ""}, {"v_cavity", ""}}, 1);
    EXPECT_EQ(default_text(p), "fast");
    EXPECT_EQ(p.high, 2.);
    for (const auto& [word, position] : {std::pair{"gmd", 0}, {"balanced", 0}, {"V-cavity", 2}})
        EXPECT_EQ(find_choice("m", p, word), position) << word;
    EXPECT_EQ(error_of([&] { find_choice("m", p, "fats"); }),
              "m: unknown variant 'fats'; did you mean 'fast'?");
    EXPECT_EQ(error_of([&] { find_choice("m", p, "2"); }),
              "m: unknown variant '2'; known are: gmd, fast, v_cavity");
}

TEST(Parameters, AreFoundByNameAndAlias) {
    const std::vector<Parameter> p = {
        {.name = "alpha_u", .meaning = "", .aliases = {"alpha", "ax"}},
        {.name = "alpha_v", .meaning = "", .aliases = {"alpha", "alphaU"}},
        {.name = "n", .meaning = ""}};
    using Found = std::vector<int>;
    EXPECT_EQ(find_parameters("m", p, "alpha"), (Found{0, 1}));
    EXPECT_EQ(find_parameters("m", p, "Alpha"), (Found{0, 1}));
    EXPECT_EQ(find_parameters("m", p, "ax"), Found{0});
    EXPECT_EQ(find_parameters("m", p, "n"), Found{2});
    EXPECT_EQ(find_parameters("m", p, "Alpha-V"), Found{1});
    // As it is written comes first: the second's alias, though it is the first's name but for case.
    EXPECT_EQ(find_parameters("m", p, "alphaU"), Found{1});
    EXPECT_EQ(error_of([&] { find_parameters("m", p, "alpha_w"); }),
              "m: unknown parameter 'alpha_w'; did you mean 'alpha_u'?");
    EXPECT_EQ(error_of([&] { find_parameters("m", p, "kd"); }),
              "m: unknown parameter 'kd'; known are: alpha_u, alpha_v, n");
    EXPECT_EQ(error_of([] { find_parameters("m", {}, "kd"); }),
              "m: it has no parameter 'kd', nor any other");
}

}  // namespace nacre
