// What slab Monte Carlo refuses, and how it is stopped.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nacre/layers/slab_monte_carlo.h"
#include "tests/layers/slab_reference.h"

namespace nacre {
namespace {

using test::infinite;
using test::layer_of;

TEST(SlabMonteCarlo, WrongInputIsExplained) {
    const LayerStack good{{layer_of(0.9, 1., 0., 1.)}};
    const auto fails = [&](auto change) {
        SlabMonteCarloOptions options;
        options.photons = 64;
        change(options);
        return test::error_of([&] { slab_monte_carlo(good, options); });
    };
    using O = SlabMonteCarloOptions;
    EXPECT_EQ(fails([](O&) {}), "no error");
    EXPECT_EQ(fails([](O& o) { o.photons = 63; }), "photons = 63 must be at least 64");
    EXPECT_EQ(fails([](O& o) { o.cosine = 0.; }), "cosine = 0 must be above 0 and at most 1");
    EXPECT_EQ(fails([](O& o) { o.cosine = std::nan(""); }),
              "cosine = nan must be above 0 and at most 1");
    EXPECT_EQ(fails([](O& o) { o.roulette_weight = -1.; }),
              "roulette_weight = -1 must be from 0 to 1");
    EXPECT_EQ(fails([](O& o) { o.roulette_gain = 1.; }),
              "roulette_gain = 1 must be above 1 and at most 1000");
    EXPECT_EQ(fails([](O& o) { o.bins.radius = 20000; }),
              "bins of radius = 20000 must be from 0 to 10000");
    EXPECT_EQ(fails([](O& o) { o.bins.depth = -1; }), "bins of depth = -1 must be from 0 to 10000");
    EXPECT_EQ(fails([](O& o) { o.bins.angle = -5; }), "bins of angle = -5 must be from 0 to 10000");
    EXPECT_EQ(fails([](O& o) { o.bins.radius = 2; }),
              "width of radius bins = 0 must be positive and finite");
    EXPECT_EQ(fails([](O& o) { o.bins.depth = 2, o.bins.depth_width = infinite; }),
              "width of depth bins = inf must be positive and finite");
    EXPECT_EQ(test::error_of([] { slab_monte_carlo({}); }), "a stack needs at least one layer");
    EXPECT_EQ(test::error_of([] { slab_monte_carlo({{layer_of(1., infinite, 0., 1.)}}); }),
              "layer 1: walks in a half space that absorbs 0 of the light per collision need not "
              "end; give it more absorption or a finite thickness");
    // 1.5 (1e7)^2 collisions to get through.
    EXPECT_EQ(test::error_of([] { slab_monte_carlo({{layer_of(1., 1e7, 0., 1.)}}); }),
              "Monte Carlo: walks through layers of an optical thickness of 1e+07 with so little "
              "absorption take up to 2e+14 collisions, hours each: adding-doubling answers at "
              "once; or make the layers thinner or their absorption stronger");
    // Absorption ends them long before.
    EXPECT_EQ(test::error_of([] {
                  slab_monte_carlo({{layer_of(0.9, 1e7, 0., 1.)}}, {.photons = 64, .bins = {}});
              }),
              "no error");
}

TEST(SlabMonteCarlo, StopsWhenItIsAskedTo) {
    std::atomic<bool> stop{false};
    double told = -1.;
    const Work work(&stop, Work::Clock::time_point::max(), [&](std::string_view, double share) {
        told = share;
        if (share > 0.) stop = true;
    });
    SlabMonteCarloOptions options;
    options.photons = 1'000'000'000;  // minutes
    EXPECT_THROW(slab_monte_carlo({{layer_of(0.999, 50., 0., 1.)}}, options, work), Stopped);
    EXPECT_GT(told, 0.);
    EXPECT_LT(told, 0.5);
}

}  // namespace
}  // namespace nacre
