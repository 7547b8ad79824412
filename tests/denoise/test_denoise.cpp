#include "nacre/denoise/denoise.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "nacre/math/error.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

/// Colour and features at a pixel.
using Truth = std::function<Vec3f(int x, int y)>;
using Features = std::function<std::vector<float>(int x, int y)>;

float gauss(Random& random) {
    const Vec2f u = random.next2();
    return std::sqrt(-2.f * std::log(1.f - u.x)) * std::cos(2.f * std::numbers::pi_v<float> * u.y);
}

/// A picture with noise of a standard deviation that is `noise` times the brightness, told from
/// `samples` samples a half; variances are those of the samples, as of a film.
DenoiseInput noisy(int width, int height, const Truth& truth, float noise,
                   const Features& features = {}, int samples = 8, std::uint64_t seed = 1) {
    DenoiseInput input{.halves = {Image(width, height), Image(width, height)},
                       .variance = Image(width, height)};
    if (features) {
        const std::vector<std::string> names(features(0, 0).size(), "f");
        input.features = input.feature_variance = Image(width, height, names);
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Random random(stream_key(seed, std::uint64_t(y) * 65536 + x));
            const Vec3f t = truth(x, y);
            const int n = 2 * samples;
            for (int c = 0; c < 3; ++c) {
                double sum[2]{}, squares = 0;
                for (int i = 0; i < n; ++i) {
                    const float v = t[c] * (1.f + noise * std::sqrt(float(n)) * gauss(random));
                    sum[i % 2] += v;
                    squares += double(v) * v;
                }
                const double mean = (sum[0] + sum[1]) / n;
                for (int h = 0; h < 2; ++h)
                    input.halves[h].at(x, y, c) = noise > 0 ? float(sum[h] / samples) : t[c];
                input.variance.at(x, y, c) =
                    noise > 0 ? float((squares / n - mean * mean) / (n - 1)) : 0.f;
            }
            if (!features) continue;
            const std::vector<float> f = features(x, y);
            for (std::size_t i = 0; i < f.size(); ++i)
                input.features.at(x, y, static_cast<int>(i)) = f[i];
        }
    return input;
}

Image mean_of(const DenoiseInput& input) {
    Image mean = input.halves[0];
    for (std::size_t i = 0; i < mean.data.size(); ++i)
        mean.data[i] += (input.halves[1].data[i] - mean.data[i]) * (1 - input.share);
    return mean;
}

double mean_square_error(const Image& image, const Truth& truth) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = image.at(x, y, c) - truth(x, y)[c];
                sum += d * d;
            }
    return sum / double(image.data.size());
}

void expect_finite(const Image& image) {
    for (const float v : image.data) ASSERT_TRUE(std::isfinite(v));
}

/// A ball on a checkered floor before a sky: curved and flat, edges of colour and of form.
struct BallOnFloor {
    int size = 96;
    bool on_ball(int x, int y) const {
        return std::hypot(x - size * 0.5f, y - size * 0.45f) < size * 0.3f;
    }
    std::vector<float> features(int x, int y) const {
        if (on_ball(x, y)) {
            const float nx = (x - size * 0.5f) / (size * 0.3f),
                        ny = (y - size * 0.45f) / (size * 0.3f);
            return {0.8f, 0.5f, 0.3f, nx, ny, std::sqrt(std::max(0.f, 1 - nx * nx - ny * ny))};
        }
        if (y < size / 2) return {0.2f, 0.3f, 0.5f, 0.f, 0.f, 0.f};
        const float a = (x / 8 + y / 8) % 2 ? 0.7f : 0.2f;
        return {a, a, a, 0.f, 1.f, 0.f};
    }
    Vec3f colour(int x, int y) const {
        const std::vector<float> f = features(x, y);
        const float light = f[3] == 0.f && f[4] == 0.f && f[5] == 0.f
                                ? 1.f
                                : 0.3f + std::max(0.f, 0.5f * f[3] + 0.6f * f[4] + 0.6f * f[5]);
        return Vec3f(f[0], f[1], f[2]) * light;
    }
};

TEST(Denoise, AnEvenPictureKeepsItsBits) {
    for (const float noise : {0.f, 0.2f}) {
        DenoiseInput input = noisy(
            40, 30, [](int, int) { return Vec3f(0.3f, 7.1f, 0.f); }, 0.f);
        for (float& v : input.variance.data) v = noise * noise;
        const Image clean = denoise(input);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                ASSERT_EQ(clean.rgb(x, y), Vec3f(0.3f, 7.1f, 0.f)) << x << ", " << y;
    }
}

TEST(Denoise, WithoutNoiseNothingChanges) {
    const BallOnFloor scene;
    const auto colour = [&](int x, int y) { return scene.colour(x, y); };
    const auto features = [&](int x, int y) { return scene.features(x, y); };
    const DenoiseInput input = noisy(scene.size, scene.size, colour, 0.f, features);
    EXPECT_LT(mean_square_error(denoise(input), colour), 1e-10);
}

TEST(Denoise, ARampOfAFeatureIsReproducedWithinItsNoise) {
    // The colour is linear in the feature, 0.2 to 2 over the picture: a filter of order 0 would
    // flatten it at the borders.
    const auto colour = [](int x, int) { return Vec3f(0.2f, 0.4f, 0.6f) * (1.f + x / 12.f); };
    const auto features = [](int x, int) { return std::vector<float>{x / 108.f}; };
    const DenoiseInput input = noisy(108, 60, colour, 0.2f, features);
    const Image clean = denoise(input);
    // Means of columns: 60 pixels of a relative deviation of at most 0.2, averaged over 60 by
    // themselves, and what is left of them is taken to vary together.
    for (const int x : {0, 1, 20, 54, 90, 106, 107}) {
        double sum = 0;
        for (int y = 0; y < 60; ++y) sum += clean.at(x, y, 1) / 60;
        EXPECT_NEAR(sum / colour(x, 0).y, 1, 4 * 0.2 / std::sqrt(60.)) << x;
    }
    EXPECT_LT(mean_square_error(clean, colour), mean_square_error(mean_of(input), colour) / 20);
}

TEST(Denoise, ErrorFallsToATenthWhereFeaturesTell) {
    const BallOnFloor scene;
    const auto colour = [&](int x, int y) { return scene.colour(x, y); };
    const auto features = [&](int x, int y) { return scene.features(x, y); };
    for (const float noise : {0.1f, 0.4f}) {
        const DenoiseInput input = noisy(scene.size, scene.size, colour, noise, features);
        const Image clean = denoise(input);
        EXPECT_LT(mean_square_error(clean, colour), mean_square_error(mean_of(input), colour) / 10)
            << noise;
    }
}

TEST(Denoise, AnEdgeThatOnlyAFeatureShowsStaysSharp) {
    // A step of 10 % under noise of 20 %: colour alone does not tell it.
    const auto colour = [](int x, int) {
        return x < 40 ? Vec3f(1.f, 1.f, 1.f) : Vec3f(1.1f, 1.1f, 1.1f);
    };
    const auto features = [](int x, int) { return std::vector<float>{x < 40 ? 0.2f : 0.8f}; };
    const Image clean = denoise(noisy(80, 60, colour, 0.2f, features));
    double left = 0, right = 0;
    for (int y = 0; y < 60; ++y) {
        left += clean.at(39, y, 1) / 60;
        right += clean.at(40, y, 1) / 60;
    }
    // Each is a mean over 10 columns and 60 rows: 0.2 / sqrt(600) = 0.008.
    EXPECT_NEAR(right - left, 0.1, 3 * 0.008 * std::sqrt(2.));
}

TEST(Denoise, AnEdgeOfColourStaysWhereNoFeatureTells) {
    const auto colour = [](int x, int) {
        return x < 40 ? Vec3f(0.2f, 0.2f, 0.2f) : Vec3f(1.f, 1.f, 1.f);
    };
    const Image clean = denoise(noisy(80, 60, colour, 0.1f));
    for (int y = 0; y < 60; ++y) {
        EXPECT_LT(clean.at(39, y, 0), 0.25f);
        EXPECT_GT(clean.at(40, y, 0), 0.9f);
    }
}

TEST(Denoise, KeepsThePicturesMean) {
    const BallOnFloor scene;
    const auto colour = [&](int x, int y) { return scene.colour(x, y); };
    const auto features = [&](int x, int y) { return scene.features(x, y); };
    const DenoiseInput input = noisy(scene.size, scene.size, colour, 0.4f, features);
    const auto sum = [](const std::vector<float>& v) {
        return std::accumulate(v.begin(), v.end(), 0.);
    };
    const double error = std::sqrt(sum(input.variance.data));
    EXPECT_NEAR(sum(denoise(input).data), sum(mean_of(input).data), 3 * error);
}

TEST(Denoise, AFireflyLeavesNoBlot) {
    const auto colour = [](int, int) { return Vec3f(0.5f, 0.5f, 0.5f); };
    DenoiseInput input = noisy(60, 60, colour, 0.1f);
    // One sample of 16 that is 10000 times too bright.
    for (int c = 0; c < 3; ++c) {
        input.halves[0].at(30, 30, c) += 5000.f / 8;
        input.variance.at(30, 30, c) += 5000.f * 5000.f / 256;
    }
    const Image clean = denoise(input);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) EXPECT_NEAR(clean.at(x, y, 1), 0.5f, 0.05f) << x << ", " << y;
}

TEST(Denoise, AHighlightOfOnePixelStays) {
    // As bright in both halves, with the same relative noise as all else.
    const auto colour = [](int x, int y) {
        return x == 30 && y == 30 ? Vec3f(20.f, 20.f, 20.f) : Vec3f(0.5f, 0.5f, 0.5f);
    };
    const Image clean = denoise(noisy(60, 60, colour, 0.1f));
    EXPECT_NEAR(clean.at(30, 30, 0), 20.f, 8.f);
    EXPECT_NEAR(clean.at(31, 30, 0), 0.5f, 0.2f);
}

TEST(Denoise, AnythingHasAnAnswer) {
    const auto colour = [](int x, int y) { return Vec3f(0.1f * x, 0.2f * y, 0.f); };
    const auto features = [](int x, int) { return std::vector<float>{0.01f * x, 0.f}; };
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 7}, {33, 19}, {17, 64}}) {
        SCOPED_TRACE(fmt::format("{} x {}", width, height));
        expect_finite(denoise(noisy(width, height, colour, 0.3f, features)));
        expect_finite(denoise(noisy(width, height, colour, 0.f)));
        DenoiseInput one = noisy(width, height, colour, 0.3f, features, 1);
        for (float& v : one.variance.data) v = 0.f;  // what one sample says of its variance
        one.halves[1] = one.halves[0];
        expect_finite(denoise(one));
        DenoiseInput bright = noisy(
            width, height, [](int, int) { return Vec3f(1e30f, 1, 0); }, 0.f);
        expect_finite(denoise(bright));
        expect_finite(denoise(noisy(
            width, height, [](int, int) { return Vec3f(); }, 0.f)));
    }
}

TEST(Denoise, ScalesWithThePicture) {
    const BallOnFloor scene{.size = 48};
    const auto features = [&](int x, int y) { return scene.features(x, y); };
    const Image one = denoise(noisy(
        48, 48, [&](int x, int y) { return scene.colour(x, y); }, 0.3f, features));
    const Image many = denoise(noisy(
        48, 48, [&](int x, int y) { return scene.colour(x, y) * 4096.f; }, 0.3f, features));
    for (std::size_t i = 0; i < one.data.size(); ++i) EXPECT_EQ(one.data[i] * 4096.f, many.data[i]);
}

TEST(Denoise, SameBitsForAnyNumberOfThreads) {
    const BallOnFloor scene;
    const DenoiseInput input = noisy(
        scene.size, scene.size, [&](int x, int y) { return scene.colour(x, y); }, 0.3f,
        [&](int x, int y) { return scene.features(x, y); });
    const auto with = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        std::size_t(threads));
        return denoise(input);
    };
    EXPECT_EQ(with(1).data, with(4).data);
}

TEST(Denoise, WrongInputIsAnswered) {
    const auto flat = [](int, int) { return Vec3f(1.f, 1.f, 1.f); };
    const auto error = [](const DenoiseInput& input) -> std::string {
        try {
            denoise(input);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    DenoiseInput other = noisy(8, 6, flat, 0.1f);
    other.variance = Image(8, 7);
    EXPECT_EQ(error(other), "denoise: images of 8 x 6 and 8 x 7 pixels");
    DenoiseInput nan = noisy(8, 6, flat, 0.1f);
    nan.halves[1].at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error(nan), "denoise: channel G at (3, 2) is nan; all values must be finite");
    DenoiseInput many = noisy(8, 6, flat, 0.1f, [](int, int) { return std::vector<float>(9); });
    EXPECT_EQ(error(many), "denoise: 9 features; at most 8");
    const std::atomic<bool> stop{true};
    EXPECT_THROW(denoise(noisy(8, 6, flat, 0.1f), Work(&stop, Work::Clock::time_point::max(), {})),
                 Stopped);
}

}  // namespace
}  // namespace nacre
