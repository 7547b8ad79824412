#include "nacre/metrics/metrics.h"

#include <gtest/gtest.h>

#include "tests/metrics/pictures_fixture.h"

namespace nacre {
namespace {

using test::constant;
using test::error_of;
using test::waves;
using test::with_noise;

Image scaled(Image image, float factor) {
    for (float& v : image.data) v *= factor;
    return image;
}

}  // namespace

TEST(Metrics, EqualPicturesHaveNoError) {
    const Image a = waves(40, 37), v = constant(40, 37, {0.f, 0.f, 0.f});
    const Metrics m = compare({a, &v}, a);
    EXPECT_EQ(m.pixels, 40u * 37u);
    for (const Metric* metric : {&m.bias, &m.channel_bias[1], &m.mse, &m.rel_mse, &m.mape, &m.smape,
                                 &m.block.mean_square}) {
        EXPECT_EQ(metric->value, 0.);
        EXPECT_EQ(metric->noise, 0.);
        EXPECT_EQ(metric->standard_error, 0.);
    }
    EXPECT_EQ(m.block.blocks, 2 * 2 * 3);
    EXPECT_EQ(m.rel_mse_trimmed, 0.);
    for (const auto& [percent, value] : m.percentiles) EXPECT_EQ(value, 0.) << percent;
    EXPECT_EQ(m.mean_picture, m.mean_reference);
}

TEST(Metrics, TwoPixelsByHand) {
    // Differences 1 and -0.5 of a reference of 1 and 0 in every channel, epsilon 0.25.
    Image p(2, 1), t(2, 1);
    for (int c = 0; c < 3; ++c) p.at(0, 0, c) = 2.f, p.at(1, 0, c) = -0.5f, t.at(0, 0, c) = 1.f;
    const Metrics m =
        compare(p, t, {}, {.epsilon = 0.25, .trim = 0.5, .block = 1, .percentiles = {0, 50, 100}});
    EXPECT_DOUBLE_EQ(m.mean_picture[0], 0.75);
    EXPECT_DOUBLE_EQ(m.mean_reference[2], 0.5);
    EXPECT_DOUBLE_EQ(m.channel_bias[1].value, 0.25);
    EXPECT_DOUBLE_EQ(m.bias.value, 0.25);
    EXPECT_DOUBLE_EQ(m.mse.value, (1. + 0.25) / 2.);
    EXPECT_DOUBLE_EQ(m.rel_mse.value, (1. / 1.25 + 0.25 / 0.25) / 2.);
    EXPECT_DOUBLE_EQ(m.rel_mse_trimmed, 0.8);
    EXPECT_DOUBLE_EQ(m.mape.value, (1. / 1.25 + 0.5 / 0.25) / 2.);
    EXPECT_DOUBLE_EQ(m.smape.value, (1. / 3.25 + 0.5 / 0.75) / 2.);
    EXPECT_EQ(m.block.blocks, 3);  // the black pixel of the reference has no ratio
    EXPECT_DOUBLE_EQ(m.block.rms(), 1.);
    EXPECT_NEAR(m.percentiles[0].second, std::sqrt(0.8), 1e-15);
    EXPECT_NEAR(m.percentiles[1].second, (std::sqrt(0.8) + 1.) / 2., 1e-15);
    EXPECT_NEAR(m.percentiles[2].second, 1., 1e-15);
    EXPECT_FALSE(m.mse.noise.has_value());
    EXPECT_FALSE(m.mse.standard_error.has_value());
}

TEST(Metrics, BiasAndNoiseAreToldApart) {
    // A constant bias and noise in both pictures; 5 sigma.
    constexpr double bias = 0.05, sigma_p = 0.1, sigma_t = 0.04;
    const Image truth = waves(128, 128);
    Image biased = truth;
    for (float& v : biased.data) v += float(bias);
    const Image p = with_noise(biased, sigma_p, 1), t = with_noise(truth, sigma_t, 2);
    const float vp = sigma_p * sigma_p, vt = sigma_t * sigma_t;
    const Image variance_p = constant(128, 128, {vp, vp, vp}),
                variance_t = constant(128, 128, {vt, vt, vt});
    const Metrics m = compare({p, &variance_p}, {t, &variance_t});

    const double n = 128. * 128., v = double(vp) + double(vt);
    EXPECT_NEAR(*m.channel_bias[0].standard_error, std::sqrt(v / n), 1e-9);
    for (const Metric& b : m.channel_bias) EXPECT_NEAR(b.value, bias, 5. * *b.standard_error);
    EXPECT_NEAR(m.bias.value, bias, 5. * *m.bias.standard_error);
    EXPECT_NEAR(*m.mse.noise, v, 1e-8);
    EXPECT_NEAR(m.mse.value, bias * bias + v, 5. * *m.mse.standard_error);
    EXPECT_NEAR(m.mse.corrected(), bias * bias, 5. * *m.mse.standard_error);
    // The stated error is neither wide nor narrow: channels together, sqrt((4 b^2 v + 2 v^2) / n).
    EXPECT_NEAR(*m.mse.standard_error, std::sqrt((4. * bias * bias * v + 2. * v * v) / n), 2e-5);
    // Bias stands out: noise alone would have to be 10 sigma off.
    EXPECT_GT(m.mse.corrected(), 10. * *m.mse.standard_error);
    EXPECT_GT(m.bias.value, 30. * *m.bias.standard_error);
    EXPECT_LE(m.mape.corrected(), compare(biased, truth).mape.value);
    EXPECT_GT(m.mape.corrected(), 0.);
}

TEST(Metrics, NoiseAloneIsNoErrorOnceCorrected) {
    // An exact reference, so that the denominators are exact too; 5 sigma for twenty pictures.
    const Image truth = waves(64, 64);
    constexpr double sigma = 0.02;
    const float v = sigma * sigma;
    const Image variance = constant(64, 64, {v, v, v});
    double squares = 0.;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Image p = with_noise(truth, sigma, 10 + seed);
        const Metrics m = compare({p, &variance}, truth);
        EXPECT_NEAR(m.bias.value, 0., 5. * *m.bias.standard_error);
        EXPECT_NEAR(m.mse.corrected(), 0., 5. * *m.mse.standard_error);
        EXPECT_NEAR(m.rel_mse.corrected(), 0., 5. * *m.rel_mse.standard_error);
        EXPECT_NEAR(m.mape.corrected(), 0., 5. * *m.mape.standard_error);
        EXPECT_NEAR(m.block.mean_square.corrected(), 0., 5. * *m.block.mean_square.standard_error);
        squares += std::pow(m.mse.corrected() / *m.mse.standard_error, 2.) / 20.;
    }
    // The stated error takes channels to vary together; these are independent, so the mean square
    // of error over standard error is 1/3, with a sampling error of 1/3 sqrt(2/20) = 0.11.
    EXPECT_GT(squares, 0.05);
    EXPECT_LT(squares, 0.33 + 5. * 0.11);
}

TEST(Metrics, TheStandardErrorOfAGreyPictureIsExact) {
    // Its three channels are one: 4 sigma on the mean square of 60 ratios, which is 1 +- 0.18.
    Image truth(32, 32, {"Y"});
    for (float& v : truth.data) v = 0.5f;
    Image variance(32, 32, {"Y"});
    for (float& v : variance.data) v = 0.01f;
    double squares = 0.;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Image p = with_noise(truth, 0.1, 100 + seed);
        const Metrics m = compare({p, &variance}, truth);
        squares += std::pow(m.bias.value / *m.bias.standard_error, 2.) / 60.;
    }
    EXPECT_NEAR(squares, 1., 4. * 0.18);
}

TEST(Metrics, ScaleWithThePictures) {
    const Image p = with_noise(waves(48, 48), 0.05, 3), t = waves(48, 48);
    const Metrics m = compare(p, t);
    // Powers of two are exact in floating point; epsilon scales with the picture's square or value.
    const Metrics scaled_4 = compare(scaled(p, 4.f), scaled(t, 4.f), {}, {.epsilon = 0.16});
    EXPECT_NEAR(scaled_4.bias.value, 4. * m.bias.value, 1e-12);
    EXPECT_NEAR(scaled_4.mse.value, 16. * m.mse.value, 1e-12);
    EXPECT_NEAR(scaled_4.rel_mse.value, m.rel_mse.value, 1e-12);
    EXPECT_NEAR(scaled_4.rel_mse_trimmed, m.rel_mse_trimmed, 1e-12);
    EXPECT_NEAR(scaled_4.block.rms(), m.block.rms(), 1e-12);
    const Metrics scaled_linear = compare(scaled(p, 4.f), scaled(t, 4.f), {}, {.epsilon = 0.04});
    EXPECT_NEAR(scaled_linear.mape.value, m.mape.value, 1e-12);
    EXPECT_NEAR(scaled_linear.smape.value, m.smape.value, 1e-12);
}

TEST(Metrics, SmapeIsSymmetricAndBelowOne) {
    const Image a = with_noise(waves(32, 32), 3., 4), b = waves(32, 32);
    EXPECT_EQ(compare(a, b).smape.value, compare(b, a).smape.value);
    EXPECT_LT(compare(a, b).smape.value, 1.);
    const Image black = constant(4, 4, {}), bright = constant(4, 4, {1e6f, 1e6f, 1e6f});
    EXPECT_NEAR(compare(bright, black).smape.value, 1., 1e-7);
    EXPECT_LT(compare(bright, black).smape.value, 1.);
}

TEST(Metrics, BlocksAverageNoiseAndKeepBias) {
    // Halves that are too bright and too dark have no bias; blocks see them. The mask cuts blocks.
    const Image t = constant(64, 32, {0.5f, 0.5f, 0.5f});
    Image p = t;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) p.at(x, y, c) += x < 32 ? 0.125f : -0.125f;
    const Metrics m = compare(p, t);
    EXPECT_NEAR(m.bias.value, 0., 1e-15);
    EXPECT_EQ(m.block.blocks, 4 * 2 * 3);
    EXPECT_NEAR(m.block.rms(), 0.25, 1e-12);
    const PixelMask mask(64, 32, [](int x, int) { return x > 0; });
    EXPECT_EQ(compare(p, t, mask).block.blocks, 3 * 2 * 3);
    EXPECT_EQ(compare(p, t, mask).pixels, 63u * 32u);
    EXPECT_EQ(compare(p, t, mask, {.block = 33}).block.blocks, 0);
    EXPECT_EQ(compare(p, t, mask, {.block = 33}).block.rms(), 0.);
}

TEST(Metrics, TheNoiseOfABlockIsThatOfARatioOfSums) {
    // p = 2 t: the ratio 2 of sums over n = 256 pixels has the variance (v_p + 2^2 v_t) / (n t^2).
    const Image t = constant(16, 16, {0.5f, 0.5f, 0.5f}), p = constant(16, 16, {1.f, 1.f, 1.f});
    const Image vp = constant(16, 16, {0.25f, 0.25f, 0.25f}),
                vt = constant(16, 16, {0.125f, 0.125f, 0.125f});
    const double noise_p = 0.25 / (256. * 0.25), noise_t = 4. * 0.125 / (256. * 0.25);
    EXPECT_NEAR(*compare({p, &vp}, t).block.mean_square.noise, noise_p, 1e-12);
    EXPECT_NEAR(*compare(p, {t, &vt}).block.mean_square.noise, noise_t, 1e-12);
    EXPECT_NEAR(*compare({p, &vp}, {t, &vt}).block.mean_square.noise, noise_p + noise_t, 1e-12);
}

TEST(Metrics, WhatTheMaskHidesDoesNotCount) {
    const Image t = waves(16, 16);
    Image p = t, mask = constant(16, 16, {0.f, 1.f, 0.f});
    p.at(3, 4, 0) = std::nanf("");
    mask.at(3, 4, 1) = 0.5f;
    const Metrics m = compare(p, t, PixelMask(mask));
    EXPECT_EQ(m.pixels, 255u);
    EXPECT_EQ(m.mse.value, 0.);
}

TEST(Metrics, ErrorImages) {
    Image p(1, 1), t(1, 1);
    p.at(0, 0, 0) = 3.f, t.at(0, 0, 0) = 1.f;
    p.at(0, 0, 2) = 0.25f, t.at(0, 0, 2) = 0.5f;
    const Image s = signed_relative_error(p, t, 0.5), q = squared_relative_error(p, t, 0.5);
    EXPECT_FLOAT_EQ(s.at(0, 0, 0), 2.f / 1.5f);
    EXPECT_EQ(s.at(0, 0, 1), 0.f);
    EXPECT_FLOAT_EQ(s.at(0, 0, 2), -0.25f);
    EXPECT_FLOAT_EQ(q.at(0, 0, 0), 4.f / 1.5f);
    EXPECT_FLOAT_EQ(q.at(0, 0, 2), 0.0625f / 0.75f);
}

TEST(Metrics, TheVarianceOfTheMeanIsThatOfASampleOverTheSamples) {
    Image p(2, 1, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    for (int c = 0; c < 3; ++c) p.at(1, 0, 3 + c) = float(c + 1);
    EXPECT_FALSE(variance_of_mean(p));  // of how many samples?
    p.metadata = {{"nacre.samples", "4"}, {"nacre.complete", "yes"}};
    const std::optional<Image> v = variance_of_mean(p);
    ASSERT_TRUE(v);
    EXPECT_EQ(v->rgb(0, 0), Vec3f(0.f, 0.f, 0.f));
    EXPECT_EQ(v->rgb(1, 0), Vec3f(0.25f, 0.5f, 0.75f));
    p.metadata["nacre.complete"] = "no";
    EXPECT_FALSE(variance_of_mean(p));
    p.metadata = {{"nacre.samples", "1"}, {"nacre.complete", "yes"}};
    EXPECT_FALSE(variance_of_mean(p));
    Image grey(1, 1, {"Y", "variance.Y"});
    grey.at(0, 0, 1) = 8.f;
    grey.metadata = {{"nacre.samples", "16"}, {"nacre.complete", "yes"}};
    EXPECT_EQ(variance_of_mean(grey)->rgb(0, 0), Vec3f(0.5f, 0.5f, 0.5f));
    Image plain(1, 1);
    plain.metadata = grey.metadata;
    EXPECT_FALSE(variance_of_mean(plain));
}

TEST(Metrics, WrongInputIsNamed) {
    const Image a(3, 2), b(4, 2);
    Image bad = a, negative = a;
    bad.at(1, 1, 2) = std::numeric_limits<float>::infinity();
    negative.at(2, 0, 0) = -1.f;
    const std::pair<std::function<void()>, const char*> cases[] = {
        {[&] { compare(a, b); },
         "the picture has 3 x 2 pixels, but the reference has 4 x 2; compare pictures of one size"},
        {[&] {
             compare({a, &b}, a);
         },
         "the variance of the picture has 4 x 2 pixels, but the reference has 3 x 2; compare "
         "pictures of one size"},
        {[&] { compare(a, a, PixelMask(b)); },
         "the mask has 4 x 2 pixels, but the pictures have 3 x 2; make it of their size"},
        {[&] { compare(a, a, PixelMask(a)); },
         "the mask leaves no pixel; its green must be above 0.5 where a pixel counts"},
        {[&] { PixelMask(0, 2, [](int, int) { return true; }); },
         "a mask of 0 x 2 pixels cannot be made; both sides must be positive"},
        {[&] { compare(bad, a); },
         "the picture is not finite at pixel (1, 1): (0, 0, inf); mend it or mask it out"},
        {[&] { compare(a, bad); },
         "the reference is not finite at pixel (1, 1): (0, 0, inf); mend it or mask it out"},
        {[&] {
             compare(a, {a, &negative});
         },
         "the variance of the reference is negative at pixel (2, 0): (-1, 0, 0)"},
        {[&] { compare(Image{}, Image{}); }, "the picture has no pixels"},
        {[&] { compare(a, a, {}, {.epsilon = 0.}); },
         "epsilon: 0 is out of range; it must be positive"},
        {[&] { compare(a, a, {}, {.trim = 1.}); },
         "trim: 1 is out of range; it must be at least 0 and below 1"},
        {[&] { compare(a, a, {}, {.block = 0}); },
         "block: 0 is out of range; it must be at least 1"},
        {[&] { compare(a, a, {}, {.percentiles = {101.}}); },
         "percentiles: 101 is out of range; it must be from 0 to 100"},
        {[&] { signed_relative_error(a, b); },
         "the picture has 3 x 2 pixels, but the reference has 4 x 2; compare pictures of one size"},
    };
    for (const auto& [act, message] : cases) EXPECT_EQ(error_of(act), message);
}

}  // namespace nacre
