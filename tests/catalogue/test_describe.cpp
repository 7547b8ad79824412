// Parameters as pages and as JSON.
#include "nacre/catalogue/describe.h"

#include <nlohmann/json.hpp>

namespace nacre {

TEST(Describe, ParametersAreLinesOfAPage) {
    EXPECT_EQ(parameter_text({.name = "thickness",
                              .meaning = "of the slab",
                              .unit = "mm",
                              .high = infinite,
                              .above_low = true,
                              .otherwise = 10.,
                              .aliases = {"d", "depth"}}),
              "      thickness    of the slab\n"
              "                   (number, (0, inf) mm, default 10)\n"
              "                   also d, depth\n");
    EXPECT_EQ(parameter_text({.name = "irradiance_samples", .meaning = "paths", .high = 8.}),
              "      irradiance_samples\n"
              "                   paths\n"
              "                   (number, [0, 8], default 0)\n");
    EXPECT_EQ(parameter_text(choice_parameter(
                  "fit", "which", {{"fast", "the quick one", {"quick"}}, {"slow", ""}}, 1)),
              "      fit          which\n"
              "                   (choice, default slow)\n"
              "                     fast           the quick one (also quick)\n"
              "                     slow           \n");
}

TEST(Describe, ParametersAreJson) {
    const std::vector<Parameter> all = {
        {.name = "beta",
         .meaning = "angle",
         .unit = "degrees",
         .high = 90.,
         .above_low = true,
         .below_high = true,
         .otherwise = 30.},
        {.name = "n", .meaning = "", .kind = ParameterKind::integer, .high = infinite},
        choice_parameter("fit", "which", {{"fast", "quick"}, {"slow", ""}}, 1, {"how"})};
    EXPECT_EQ(parameters_json(all), nlohmann::ordered_json::parse(R"([
        {"name": "beta", "meaning": "angle", "kind": "number", "unit": "degrees", "low": 0.0,
         "low_allowed": false, "high": 90.0, "high_allowed": false, "default": 30.0,
         "aliases": []},
        {"name": "n", "meaning": "", "kind": "whole number", "low": 0.0, "low_allowed": true,
         "high": null, "default": 0.0, "aliases": []},
        {"name": "fit", "meaning": "which", "kind": "choice",
         "choices": [{"name": "fast", "meaning": "quick"}, {"name": "slow", "meaning": ""}],
         "default": "slow", "aliases": ["how"]}])"));
    EXPECT_EQ(parameters_json({}).dump(), "[]");
}

TEST(Describe, LinesAreAtMostAHundredLettersLong) {
    // 7 + 50 + 1 + 42 letters, and what no longer fits.
    EXPECT_EQ(wrapped("  lead ", fmt::format("{:a<50} {:b<42} {:c<42} d", "", "", "")),
              fmt::format("  lead {:a<50} {:b<42}\n       {:c<42} d\n", "", "", ""));
    // One letter more is too long, though it is the last word.
    EXPECT_EQ(wrapped("  lead ", fmt::format("{:a<50} {:b<43}", "", "")),
              fmt::format("  lead {:a<50}\n       {:b<43}\n", "", ""));
}

}  // namespace nacre
