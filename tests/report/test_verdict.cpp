// Known bias and known noise are told apart.
#include "nacre/compare/verdict.h"
#include "nacre/metrics/flip.h"
#include "nacre/report/crops.h"
#include "tests/compare/experiment_fixture.h"

namespace nacre::test {
namespace {

constexpr int size = 64;

Image constant(double value) {
    Image image(size, size);
    for (float& v : image.data) v = float(value);
    return image;
}

}  // namespace

TEST(Verdict, OfTheReferenceItselfIsNothing) {
    const Measurement m = made_up(size, 2, 0, 0, 3, 1);
    const Verdict v = judge(m, constant(2), constant(0), {});
    EXPECT_EQ(v.systematic.value, 0);
    EXPECT_EQ(v.bias.value, 0);
    EXPECT_EQ(v.frame, 0);
    EXPECT_EQ(v.noise, 0);
    EXPECT_EQ(v.flip, 0);
}

/// Every combination of a bias that is there or not and noise that is there or not. Three and a
/// half standard errors: 5 of 10,000 correct results would fail, and seeds are fixed.
TEST(Verdict, TellsBiasFromNoise) {
    for (const double bias : {0., 0.05, -0.2})
        for (const double sigma : {0., 0.3, 1.}) {
            const double truth = 2;
            const Measurement m = made_up(size, truth, bias, sigma, 4, 7);
            const Verdict v = judge(m, constant(truth), constant(0), {});
            const std::string what = fmt::format("bias {} sigma {}", bias, sigma);
            EXPECT_NEAR(v.bias.value, bias, 3.5 * v.bias.sigma + 1e-6) << what;
            EXPECT_NEAR(v.systematic.value, std::abs(bias), 3.5 * v.systematic.sigma + 1e-6)
                << what;
            // relMSE has epsilon 0.01 beside truth^2.
            const double relative = truth / std::sqrt(truth * truth + 0.01);
            EXPECT_NEAR(v.noise, sigma / truth * relative, 0.03 * sigma / truth) << what;
            const double frame = std::hypot(bias, sigma / truth) * relative;
            EXPECT_NEAR(v.frame, frame, 0.03 * frame + 1e-6) << what;
        }
}

/// Noise of the reference is no error of the technique.
TEST(Verdict, TakesOffTheNoiseOfTheReference) {
    Normal normal(3);
    Image reference = constant(1);
    for (float& v : reference.data) v += float(0.05 * normal());
    const Verdict v = judge(made_up(size, 1, 0, 0.1, 3, 5), reference, constant(0.0025), {});
    EXPECT_NEAR(v.noise, 0.1 / std::sqrt(1.01), 0.01);
    // One standard error of the mean square of what noise adds is 0.009^2.
    EXPECT_LT(v.pixel_systematic, 0.03);
    EXPECT_LE(v.systematic.value, 3.5 * v.systematic.sigma);
}

/// One sees a frame and not the mean of the repeats.
TEST(Verdict, FlipIsThatOfAFrame) {
    const Measurement m = made_up(size, 1, 0, 0.3, 4, 2);
    EXPECT_EQ(judge(m, constant(1), constant(0), {}).flip, flip_hdr(m.frame, constant(1)).mean);
    EXPECT_GT(flip_hdr(m.frame, constant(1)).mean, 1.3 * flip_hdr(m.mean, constant(1)).mean);
}

TEST(Verdict, CountsOnlyWhatTheMaskLeaves) {
    Measurement m = made_up(size, 1, 0, 0, 2, 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size / 2; ++x)
            for (int c = 0; c < 3; ++c) m.mean.at(x, y, c) = m.frame.at(x, y, c) = 5.f;
    const PixelMask right(size, size, [](int x, int) { return x >= size / 2; });
    EXPECT_EQ(judge(m, constant(1), constant(0), right).systematic.value, 0);
    EXPECT_NEAR(judge(m, constant(1), constant(0), {}).systematic.value, 4 / std::sqrt(2.), 1e-6);
}

TEST(Crops, AreWhereThePicturesDiffer) {
    Image picture = constant(1);
    for (int y = 40; y < 52; ++y)
        for (int x = 8; x < 20; ++x)
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 1.3f;
    const std::vector<Crop> crops = telling_crops({&picture}, constant(1), {}, 3);
    ASSERT_FALSE(crops.empty());
    EXPECT_EQ(crops[0].side, 24);
    // Within the first one lies all that differs.
    EXPECT_LE(crops[0].x, 8);
    EXPECT_GE(crops[0].x + 24, 20);
    EXPECT_LE(crops[0].y, 40);
    EXPECT_GE(crops[0].y + 24, 52);
    for (std::size_t i = 0; i < crops.size(); ++i) {
        EXPECT_LE(crops[i].x + crops[i].side, size);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_TRUE(std::abs(crops[i].x - crops[j].x) >= 24 ||
                        std::abs(crops[i].y - crops[j].y) >= 24);
    }
    // Where nothing counts nobody needs to look, even if nothing differs elsewhere.
    const PixelMask right(size, size, [](int x, int) { return x >= 40; });
    for (const Crop& c : telling_crops({&picture}, constant(1), right, 3)) EXPECT_GE(c.x, 28);
    const PixelMask left(size, size, [](int x, int) { return x < 20; });
    for (const Crop& c : telling_crops({&picture}, constant(1), left, 3)) EXPECT_LE(c.x, 8);
}

}  // namespace nacre::test
