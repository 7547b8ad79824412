#include "nacre/layers/layer.h"

#include <limits>

#include "tests/layers/layer_vectors.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

TEST(Layer, DerivesWhatFollowsFromItsCoefficients) {
    const Layer l{.sigma_s = 3., .sigma_a = 1., .g = 0.5, .thickness = 2., .eta = 1.4};
    EXPECT_EQ(l.sigma_t(), 4.);
    EXPECT_EQ(l.albedo(), 0.75);
    EXPECT_EQ(l.optical_thickness(), 8.);
    const Layer clear{.thickness = inf};
    EXPECT_EQ(clear.albedo(), 0.);
    EXPECT_EQ(clear.optical_thickness(), 0.);
    EXPECT_EQ((Layer{.sigma_a = 1., .thickness = inf}.optical_thickness()), inf);
}

TEST(Layer, CheckAcceptsTheEndsOfTheRanges) {
    EXPECT_NO_THROW(check({{Layer{}}}));
    EXPECT_NO_THROW(
        check({{Layer{.sigma_s = 1e6, .sigma_a = 0., .g = -0.999, .thickness = 1e-9, .eta = 0.5},
                Layer{.thickness = inf}},
               2.4,
               0.1}));
}

TEST(Layer, CheckSaysWhatIsWrong) {
    const auto message = [](std::vector<Layer> layers, double above = 1., double below = 1.) {
        return test::error_of([&] { check({std::move(layers), above, below}); });
    };
    const Layer good{.sigma_s = 1.};
    EXPECT_EQ(message({}), "a stack needs at least one layer");
    EXPECT_EQ(message({{.sigma_s = -1.}}), "layer 1: sigma_s = -1 must be finite and at least 0");
    EXPECT_EQ(message({{.sigma_s = nan}}), "layer 1: sigma_s = nan must be finite and at least 0");
    EXPECT_EQ(message({good, {.sigma_a = -0.5}}),
              "layer 2: sigma_a = -0.5 must be finite and at least 0");
    EXPECT_EQ(message({good, {.sigma_a = inf}}),
              "layer 2: sigma_a = inf must be finite and at least 0");
    EXPECT_EQ(message({{.g = 1.}}), "layer 1: g = 1 must be between -1 and 1");
    EXPECT_EQ(message({{.g = -1.}}), "layer 1: g = -1 must be between -1 and 1");
    EXPECT_EQ(message({{.g = nan}}), "layer 1: g = nan must be between -1 and 1");
    EXPECT_EQ(message({{.thickness = 0.}}), "layer 1: thickness = 0 must be positive");
    EXPECT_EQ(message({{.thickness = nan}}), "layer 1: thickness = nan must be positive");
    EXPECT_EQ(message({{.thickness = inf}, good}),
              "layer 1: thickness = inf must be finite, except in the last layer");
    EXPECT_EQ(message({good, good, {.eta = 0.}}), "layer 3: eta = 0 must be positive and finite");
    EXPECT_EQ(message({{.eta = inf}}), "layer 1: eta = inf must be positive and finite");
    EXPECT_EQ(message({good}, -1.),
              "the index of refraction above the layers is -1; it must be positive and finite");
    EXPECT_EQ(message({good}, 1., inf),
              "the index of refraction below the layers is inf; it must be positive and finite");
}

}  // namespace
}  // namespace nacre
