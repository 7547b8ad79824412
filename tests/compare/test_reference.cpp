// References: the noise that was asked for, kept, taken up, and not mistaken for another scene's.
#include "tests/compare/experiment_fixture.h"

namespace nacre::test {
namespace {

PixelMask whole_ball(const Scene& s) {
    bool object_only = false;
    return translucent_pixels(s, object_only);
}

}  // namespace

/// Blocks of n pixels of value t and variance v: sqrt(v / n) / t.
TEST(BlockStandardError, IsThatOfTheMeanOfABlock) {
    Image picture(8, 8), variance(8, 8);
    for (float& v : picture.data) v = 2.f;
    for (float& v : variance.data) v = 0.04f;
    EXPECT_NEAR(block_standard_error(picture, variance, {}, 4), 0.2 / 4 / 2, 1e-7);
    EXPECT_NEAR(block_standard_error(picture, variance, {}, 8), 0.2 / 8 / 2, 1e-7);
    EXPECT_EQ(error_of([&] { block_standard_error(picture, variance, {}, 16); }),
              "no block of 16 x 16 pixels lies wholly on the object: render a larger picture");
}

TEST_F(ExperimentTest, AReferenceIsRenderedUntilItsNoiseIsSmallEnough) {
    Scene s = ball(24);
    const PixelMask mask = whole_ball(s);
    const Reference r = make_reference(s, mask, reference_options(0.02));
    EXPECT_TRUE(r.reached);
    EXPECT_FALSE(r.reused);
    EXPECT_LE(r.error, 0.02);
    EXPECT_GT(r.error, 0.005);  // and not much more than that
    EXPECT_TRUE(std::filesystem::exists(r.file));
    EXPECT_EQ(s.sampler.samples, 4);
    EXPECT_EQ(s.sampler.type, "independent");
}

/// The noise that a reference states is the noise that it has, after many rounds as well: against a
/// picture of other samples whose own noise is known.
TEST_F(ExperimentTest, AReferenceHasTheNoiseThatItStates) {
    Scene s = ball(48);
    const PixelMask mask = whole_ball(s);
    ReferenceOptions asked = reference_options(0.01);
    asked.block = 2;
    const Reference r = make_reference(s, mask, asked);
    ASSERT_GT(r.samples, 100);
    const Measurement other = measure(s, {{"volpath"}, 400}, {.repeats = 2, .seed = 9});
    ASSERT_EQ(other.status, Measurement::Status::done) << other.why;
    const double own = block_standard_error(other.mean, other.variance, mask, 2);
    MetricOptions options;
    options.block = 2;
    const BlockError blocks = compare({other.mean}, {r.picture}, mask, options).block;
    ASSERT_GT(blocks.blocks, 900);
    // 300 blocks of three channels that vary together: the root of chi^2 over its 300 degrees is
    // within 1 +- 0.13 with a probability of 99.9 %.
    const double expected = std::hypot(own, r.error);
    EXPECT_NEAR(blocks.rms() / expected, 1, 0.13);
}

TEST_F(ExperimentTest, AReferenceIsTakenUpAgain) {
    Scene s = ball(24);
    const PixelMask mask = whole_ball(s);
    const Reference first = make_reference(s, mask, reference_options(0.05));
    const Reference same = make_reference(s, mask, reference_options(0.05));
    EXPECT_TRUE(same.reused);
    EXPECT_EQ(same.samples, first.samples);
    EXPECT_EQ(same.picture.data, first.picture.data);
    const Reference finer = make_reference(s, mask, reference_options(0.02));
    EXPECT_FALSE(finer.reused);
    EXPECT_GT(finer.samples, first.samples);
    EXPECT_EQ(finer.file, first.file);
    // The same picture by other samples; another picture by the same samples.
    Scene sobol = ball(24, "0.6, 0.6, 0.6", "sobol");
    EXPECT_TRUE(make_reference(sobol, mask, reference_options(0.05)).reused);
    Scene other = ball(24, "0.6, 0.6, 0.59");
    const Reference apart = make_reference(other, mask, reference_options(0.05));
    EXPECT_FALSE(apart.reused);
    EXPECT_NE(apart.file, first.file);
    ReferenceOptions fresh = reference_options(0.05);
    fresh.fresh = true;
    EXPECT_FALSE(make_reference(s, mask, fresh).reused);
}

TEST_F(ExperimentTest, AStoppedReferenceGoesOn) {
    Scene s = ball(24);
    const PixelMask mask = whole_ball(s);
    std::atomic<bool> stop = false;
    ReferenceOptions o = reference_options(0.01);
    o.stop = &stop;
    o.progress = [&](double, double error) {
        if (error > 0) stop = true;  // after the first round
    };
    const Reference part = make_reference(s, mask, o);
    EXPECT_FALSE(part.reached);
    EXPECT_EQ(part.samples, 16);
    stop = false;
    o.progress = {};
    EXPECT_TRUE(make_reference(s, mask, o).reached);
}

}  // namespace nacre::test
