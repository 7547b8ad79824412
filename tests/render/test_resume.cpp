// Renders that go on where others stopped, and that end at a noise.
#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "nacre/render/film_state.h"
#include "nacre/render/noise.h"
#include "nacre/render/render.h"
#include "tests/render/made_radiance.h"

namespace nacre {
namespace {

/// Samples of differing length, some invalid.
const TestIntegrator uneven([](const Ray& ray, Sampler& sampler, const Wavelengths&) {
    float v = 0.f;
    for (int i = 0; i < 60 && sampler.random().next() > 0.05f; ++i) v += sampler.next1d();
    if (sampler.random().next() < 0.002f) v = std::nanf("");
    return Spectral(v * ray.d.z, v, 1.f + ray.d.x, 0.f);
});

/// Mean 1 and variance 1/3 in each channel, independent: the channels of a pixel, too.
const TestIntegrator uniform([](const Ray&, Sampler& sampler, const Wavelengths&) {
    Random& random = sampler.random();
    return Spectral(2 * random.next(), 2 * random.next(), 2 * random.next(), 0.f);
});

Scene wide_filter(int width, int height, int samples) {
    return test_scene(width, height, samples, "mitchell");
}

/// All that a state holds: sums, counts, invalid samples.
std::string bits(const Film& film) { return FilmState::encode(film, {}); }

TEST(Resume, HasTheBitsOfOneRenderWhereverItStoppedAndForAnyThreads) {
    for (const char* sampler : {"independent", "sobol", "stratified"}) {
        Scene scene = wide_filter(37, 21, 40);
        scene.sampler.type = sampler;
        const std::string whole = bits(render(scene, uneven).film);
        for (const std::uint64_t stop_at : {1u, 777u, 20000u, 31079u}) {
            std::atomic<bool> stop{false};
            std::atomic<std::uint64_t> n{0};
            const TestIntegrator stopping([&](const Ray& ray, Sampler& s, const Wavelengths&) {
                if (++n == stop_at) stop = true;
                Wavelengths w = Wavelengths::rgb_bands();
                RayCounts counts;
                return uneven.radiance(ray, s, w, counts);
            });
            const RenderResult part = render(scene, stopping, {.threads = 3, .stop = &stop});
            ASSERT_FALSE(part.complete) << stop_at;
            const Film kept = FilmState::decode(bits(part.film)).film;
            std::uint64_t first = 0;
            RenderOptions options{.threads = 2};
            options.begun = &kept;
            options.progress = [&](const RenderProgress& p) {
                if (!first) first = p.done;
            };
            const RenderResult rest = render(scene, uneven, options);
            EXPECT_TRUE(rest.complete);
            EXPECT_EQ(bits(rest.film), whole) << sampler << ", stopped at " << stop_at;
            EXPECT_EQ(part.counts.rays + rest.counts.rays, 37u * 21u * 40u);
            EXPECT_GE(first, part.counts.rays);
        }
    }
}

TEST(Resume, MoreSamplesOfAFinishedRenderHaveTheBitsOfOne) {
    for (const char* sampler : {"independent", "sobol"}) {
        Scene few = wide_filter(20, 20, 25), many = wide_filter(20, 20, 70);
        few.sampler.type = many.sampler.type = sampler;
        const RenderResult part = render(few, uneven);
        RenderOptions options;
        options.begun = &part.film;
        EXPECT_EQ(bits(render(many, uneven, options).film), bits(render(many, uneven).film));
        // Nothing is left to do.
        const RenderResult again = render(few, uneven, options);
        EXPECT_TRUE(again.complete);
        EXPECT_EQ(again.counts.rays, 0u);
    }
}

TEST(Resume, AFilmOfAnotherPictureIsRefused) {
    const Scene scene = wide_filter(20, 20, 4), other = wide_filter(20, 21, 4);
    const RenderResult part = render(other, uneven);
    RenderOptions options;
    options.begun = &part.film;
    EXPECT_THROW(render(scene, uneven, options), InputError);
}

/// Every checkpoint of a render on many threads is a film from which to go on.
TEST(Resume, CheckpointsWhileOthersRenderGoOnToTheSameBits) {
    // As long as two checkpoints need, whatever the machine does besides.
    for (int samples = 60; samples < 100000; samples *= 4) {
        const Scene scene = wide_filter(70, 50, samples);
        std::vector<std::string> kept;
        std::uint64_t rays = 0;
        RenderOptions options{.threads = 4};
        options.checkpoint_s = 0.01;
        options.checkpoint = [&](const RenderCheckpoint& c) {
            EXPECT_GE(c.counts.rays, rays);
            rays = c.counts.rays;
            kept.push_back(bits(c.film));
        };
        const std::string checked = bits(render(scene, uneven, options).film);
        if (kept.size() < 2) continue;
        const std::string whole = bits(render(scene, uneven).film);
        EXPECT_EQ(checked, whole);
        for (const std::string& state : {kept[0], kept[kept.size() / 2], kept.back()}) {
            const Film film = FilmState::decode(state).film;
            RenderOptions rest;
            rest.begun = &film;
            EXPECT_EQ(bits(render(scene, uneven, rest).film), whole);
        }
        return;
    }
    FAIL() << "no two checkpoints";
}

/// The estimate, against the variance that is known and against the error that is there: N = 12288
/// values, so that either square has a relative standard deviation of at most sqrt(2 / N) = 1.3 %;
/// held to 4 of them.
TEST(Noise, IsTheErrorThatThereIs) {
    Scene scene = wide_filter(64, 64, 50);
    scene.film.filter.type = "box";
    const RenderResult r = render(scene, uniform);
    double error = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = r.film.mean(x, y)[c] - 1;
                error += d * d / 1.01 / (3 * 64 * 64);
            }
    const double noise = film_noise(r.film), truth = 1. / 3 / 50 / 1.01;
    EXPECT_NEAR(error / truth, 1, 4 * 0.0128);
    EXPECT_NEAR(noise * noise / truth, 1, 4 * 0.0128);
    // A picture of twice the light has the same; a half without any noise does not make it cleaner.
    const TestIntegrator brighter([](const Ray& ray, Sampler& s, const Wavelengths&) {
        Wavelengths w = Wavelengths::rgb_bands();
        RayCounts counts;
        return 2.f * uniform.radiance(ray, s, w, counts);
    });
    EXPECT_NEAR(film_noise(render(scene, brighter).film), noise, 1e-6 * noise);
    const TestIntegrator half([](const Ray& ray, Sampler& s, const Wavelengths&) {
        Wavelengths w = Wavelengths::rgb_bands();
        RayCounts counts;
        return ray.d.x > 0 ? Spectral(1.f) : uniform.radiance(ray, s, w, counts);
    });
    EXPECT_NEAR(film_noise(render(scene, half).film), noise, 0.03 * noise);
    scene.sampler.samples = 1;
    EXPECT_EQ(film_noise(render(scene, uniform).film), std::numeric_limits<double>::infinity());
}

/// 1 / 3 / n / 1.01 <= 0.05^2 takes n = 133 samples: the batch that ends at 144; the noise that is
/// told is what is there, and the difference to an independent render of the same is sqrt(2) of it.
TEST(Noise, EndsARenderAtTheSameSamplesForAnyThreadsAndAfterResuming) {
    Scene scene = wide_filter(64, 64, 1 << 30);
    scene.film.filter.type = "box";
    const RenderResult one = render(scene, uniform, {.threads = 1, .noise = 0.05});
    EXPECT_TRUE(one.complete);
    EXPECT_EQ(one.sampler.samples, 144);
    EXPECT_EQ(one.film.count(63, 63), 144u);
    ASSERT_TRUE(one.noise);
    EXPECT_LE(*one.noise, 0.05);
    const std::string whole = bits(one.film);
    EXPECT_EQ(bits(render(scene, uniform, {.threads = 3, .noise = 0.05}).film), whole);
    // From samples that are no whole batch.
    FrameSettings few = FrameSettings::of(scene);
    few.sampler.samples = 41;
    const RenderResult part = render(scene, uniform, few);
    RenderOptions options{.noise = 0.05};
    options.begun = &part.film;
    EXPECT_EQ(bits(render(scene, uniform, options).film), whole);
    // It is there already.
    options.begun = &one.film;
    const RenderResult again = render(scene, uniform, options);
    EXPECT_EQ(again.counts.rays, 0u);
    EXPECT_EQ(again.sampler.samples, 144);
    EXPECT_EQ(bits(again.film), whole);

    scene.sampler.seed = 1;
    const RenderResult other = render(scene, uniform, {.noise = 0.05});
    double difference = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = one.film.mean(x, y)[c] - other.film.mean(x, y)[c];
                difference += d * d / 1.01 / (3 * 64 * 64);
            }
    EXPECT_NEAR(difference / 2 / (*one.noise * *one.noise), 1, 4 * 0.0128 * 1.42);
}

TEST(Noise, HasAtLeastSomeSamplesAndAtMostThoseOfTheFrame) {
    const Scene scene = wide_filter(16, 16, 50);
    const RenderResult easy = render(scene, uniform, {.noise = 1});
    EXPECT_EQ(easy.sampler.samples, least_noise_samples);
    const RenderResult hard = render(scene, uniform, {.noise = 0.001});
    EXPECT_TRUE(hard.complete);
    EXPECT_EQ(hard.sampler.samples, 50);
    ASSERT_TRUE(hard.noise);
    EXPECT_GT(*hard.noise, 0.001);
    EXPECT_FALSE(render(scene, uniform).noise);
}

}  // namespace
}  // namespace nacre
