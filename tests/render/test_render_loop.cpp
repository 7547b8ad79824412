#include "nacre/render/film_state.h"
#include "nacre/render/render.h"
#include "nacre/render/render_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <thread>

#include "nacre/math/error.h"
#include "nacre/render/output.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/photometry.h"
#include "tests/render/made_radiance.h"

namespace nacre {
namespace {

/// Noise whose length differs from sample to sample, as a random walk's does.
const TestIntegrator noisy([](const Ray& ray, Sampler& sampler, const Wavelengths&) {
    float v = 0.f;
    for (int i = 0; i < 200 && sampler.random().next() > 0.02f; ++i) v += sampler.next1d();
    return Spectral(v * ray.d.z, v, 1.f + ray.d.x, 0.f);
});

bool same_bits(const Film& a, const Film& b) {
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            if (!(a.mean(x, y) == b.mean(x, y)) ||
                !(a.sample_variance(x, y) == b.sample_variance(x, y)) ||
                a.count(x, y) != b.count(x, y))
                return false;
    return true;
}

TEST(RenderLoop, SameBitsForAnyNumberOfThreads) {
    for (const char* sampler : {"independent", "stratified", "sobol"})
        for (const char* filter : {"box", "mitchell"}) {
            Scene scene = test_scene(53, 37, 21);
            scene.sampler.type = sampler;
            scene.film.filter.type = filter;
            const RenderResult one = render(scene, noisy, {.threads = 1});
            EXPECT_TRUE(one.complete);
            EXPECT_EQ(one.film.count(52, 36), 21u);
            EXPECT_EQ(one.counts.rays, 53u * 37u * 21u);
            EXPECT_EQ(one.counts.scatterings, 2u * 53u * 37u * 21u);
            for (int threads : {2, 5})
                EXPECT_TRUE(same_bits(one.film, render(scene, noisy, {.threads = threads}).film));
            scene.sampler.seed = 1;
            EXPECT_FALSE(same_bits(one.film, render(scene, noisy, {.threads = 2}).film));
        }
}

/// Whoever drives the job: tiles from the last to the first, each batch by batch, the film kept and
/// taken up by another job in between.
TEST(RenderLoop, SameBitsTileByTileAndBatchByBatch) {
    Scene scene = test_scene(53, 37, 21);
    scene.sampler.type = "sobol";
    scene.film.filter.type = "mitchell";
    const RenderResult loop = render(scene, noisy);
    RenderJob early(scene, noisy, FrameSettings::of(scene)),
        late(scene, noisy, FrameSettings::of(scene));
    EXPECT_EQ(early.total(), 53u * 37u * 21u);
    SampleRange batch = early.batch_after(0);
    std::uint64_t added = 0;
    for (; batch.last < 8; batch = early.batch_after(batch.last))
        for (int t = early.tile_count(); t-- > 0;) added += early.render(early.tile(t), batch);
    late.film() = FilmState::decode(FilmState::encode(early.film(), {})).film;
    for (int t = 0; t < late.tile_count(); ++t)
        for (SampleRange b = batch; b.first < b.last; b = late.batch_after(b.last))
            added += late.render(late.tile(t), b);
    EXPECT_EQ(added, late.total());
    EXPECT_TRUE(same_bits(loop.film, late.film()));
    // A frame of other samples leaves the scene as it is.
    FrameSettings frame = FrameSettings::of(scene);
    frame.sampler.seed = 1;
    const RenderResult other = render(scene, noisy, frame);
    EXPECT_FALSE(same_bits(loop.film, other.film));
    EXPECT_EQ(other.sampler.seed, 1u);
    EXPECT_EQ(scene.sampler.seed, 0u);
}

TEST(RenderLoop, ACropWindowHasTheBitsOfTheWholeFilm) {
    Scene scene = test_scene(53, 37, 9);
    scene.sampler.type = "sobol";
    scene.film.filter.type = "gaussian";
    const RenderResult whole = render(scene, noisy);
    scene.film.crop_x = 20, scene.film.crop_y = 11;
    scene.film.crop_width = 25, scene.film.crop_height = 17;
    const RenderResult crop = render(scene, noisy);
    ASSERT_EQ(crop.film.width(), 25);
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 25; ++x)
            ASSERT_EQ(crop.film.mean(x, y), whole.film.mean(x + 20, y + 11));
}

TEST(RenderLoop, AveragesTheRadianceOverThePixel) {
    // Radiance linear in the film position: the mean over pixel x of 8 is its middle.
    Scene scene = test_scene(8, 4, 4096);
    scene.sampler.type = "stratified";
    const TestIntegrator linear([](const Ray& ray, Sampler&, const Wavelengths&) {
        const Vec3f p = ray.d / ray.d.z;
        return Spectral(1 + p.x, 1 + p.y, 2.f, 99.f);
    });
    const RenderResult r = render(scene, linear);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) {
            const Vec3f m = r.film.mean(x, y);
            // Deviation of the mean over 64 x 64 strata: width / 64 / sqrt(12) / 64; 5 of them.
            EXPECT_NEAR(m.x, 2 * (x + 0.5) / 8, 9e-5);
            EXPECT_NEAR(m.y, 2 * (y + 0.5) / 4, 1.8e-4);
            EXPECT_EQ(m.z, 2.f);
            // Variance of one sample: uniform over the width of a pixel.
            EXPECT_NEAR(r.film.sample_variance(x, y).x, 0.25 * 0.25 / 12, 1e-4);
        }
}

TEST(RenderLoop, SpectralModeDrawsWavelengthsAndAllowsNegativeColours) {
    Scene scene = test_scene(8, 8, 256);
    scene.mode = ColorMode::spectral;
    // A narrow line at 500 nm, outside the gamut: its red is negative.
    const TestIntegrator line([](const Ray&, Sampler&, const Wavelengths& w) {
        EXPECT_EQ(w.mode, ColorMode::spectral);
        return select(abs(w.lambda - 500.f) < 10.f, Spectral(1.f), Spectral(0.f));
    });
    const RenderResult r = render(scene, line);
    EXPECT_EQ(r.film.invalid_count(), 0u);
    double red = 0, variance = 0;
    for (int i = 0; i < 64; ++i) {
        red += r.film.mean(i % 8, i / 8).x / 64;
        variance += r.film.sample_variance(i % 8, i / 8).x / (64.0 * 64 * 256);
    }
    const Vec3f exact =
        xyz_to_rgb(integrate_xyz([](float nm) { return std::abs(nm - 500.f) < 10.f ? 1.f : 0.f; }));
    EXPECT_LT(exact.x, 0.f);
    EXPECT_NEAR(red, exact.x, 5 * std::sqrt(variance) + 1e-4);
}

TEST(RenderLoop, InvalidSamplesAreCountedAndLocatedInBothModes) {
    for (ColorMode mode : {ColorMode::rgb_bands, ColorMode::spectral}) {
        Scene scene = test_scene(40, 20, 8);
        scene.mode = mode;
        scene.film.crop_x = 4, scene.film.crop_y = 2, scene.film.crop_width = 30,
        scene.film.crop_height = 10;
        // Wrong in the right half of the film for one sample in eight.
        const TestIntegrator bad([](const Ray& ray, Sampler& sampler, const Wavelengths&) {
            if (ray.d.x < 0 || sampler.sample_index() != 3) return Spectral(1.f);
            return Spectral(1.f, ray.d.y < 0 ? -0.5f : std::nanf(""), 1.f, 1.f);
        });
        const RenderResult one = render(scene, bad, {.threads = 1});
        EXPECT_EQ(one.film.invalid_count(), 14u * 10u);  // columns 20..33 of rows 2..11
        ASSERT_EQ(one.film.invalid_samples().size(), 16u);
        const InvalidSample first = one.film.invalid_samples()[0];
        EXPECT_EQ(std::tuple(first.x, first.y, first.sample), std::tuple(20, 2, 3u));
        EXPECT_EQ(one.film.count(20, 5), 7u);
        const RenderResult five = render(scene, bad, {.threads = 5});
        for (int i = 0; i < 16; ++i) {
            EXPECT_EQ(one.film.invalid_samples()[i].x, five.film.invalid_samples()[i].x);
            EXPECT_EQ(one.film.invalid_samples()[i].y, five.film.invalid_samples()[i].y);
        }
        EXPECT_EQ(describe_invalid(one.film),
                  "140 invalid samples (not finite or negative), the first at pixel (20, 2), "
                  "sample 3: (1, -0.5, 1)");
        const Image image = render_image(one, scene, {});
        EXPECT_EQ(image.metadata.at("nacre.invalid"), "140");
        EXPECT_TRUE(image.metadata.at("nacre.invalid_samples")
                        .starts_with("pixel (20, 2), sample 3: (1, -0.5, 1); pixel (21, 2)"));
    }
}

TEST(RenderLoop, LuminanceAndIlluminanceAreInPhotometricUnits) {
    const TestIntegrator white(
        [](const Ray&, Sampler&, const Wavelengths&) { return Spectral(0.5f); });
    Scene scene = test_scene(32, 32, 2);
    scene.film.quantity = FilmQuantity::luminance;
    // 0.5 W m^-2 sr^-1 nm^-1 of white of Y = 1: 683 lm/W times 106.857 nm times a half.
    EXPECT_NEAR(render(scene, white).film.mean(3, 4).y, 0.5 * 683 * 106.857, 1.0);
    scene.film.quantity = FilmQuantity::illuminance;
    const RenderResult r = render(scene, white);
    double lux = 0;
    for (int i = 0; i < 32 * 32; ++i) lux += r.film.mean(i % 32, i / 32).x;
    // One face of a cube seen from its middle: a sixth of the sphere.
    EXPECT_NEAR(lux / (0.5 * 683 * 106.857 * 4 * M_PI / 6), 1.0, 1e-4);
    scene.camera = std::make_shared<TestCamera>(true);
    EXPECT_THROW(render(scene, white), InputError);
}

TEST(RenderLoop, ATimeoutGivesAnEvenPartialPicture) {
    Scene scene = test_scene(32, 32, 100000);
    const TestIntegrator slow([](const Ray&, Sampler&, const Wavelengths&) {
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        return Spectral(1.f);
    });
    const RenderResult r = render(scene, slow, {.threads = 2, .timeout_s = 0.5});
    EXPECT_FALSE(r.complete);
    EXPECT_GE(r.seconds, 0.5);
    EXPECT_LT(r.seconds, 2.0);
    std::uint32_t least = ~0u, most = 0;
    for (int i = 0; i < 32 * 32; ++i) {
        least = std::min(least, r.film.count(i % 32, i / 32));
        most = std::max(most, r.film.count(i % 32, i / 32));
    }
    EXPECT_GE(least, 1u);
    EXPECT_LE(most, least + 16);
    EXPECT_EQ(render_image(r, scene, {}).metadata.at("nacre.complete"), "no");
}

TEST(RenderLoop, TheStopFlagEndsTheRenderAndKeepsAPrefixOfTheSamples) {
    Scene scene = test_scene(20, 20, 64);
    std::atomic<bool> stop{false};
    std::atomic<int> drawn{0};
    const TestIntegrator stopping([&](const Ray& ray, Sampler& s, const Wavelengths& w) {
        if (++drawn == 20 * 20 * 3) stop = true;
        return noisy.radiance(ray, s, w, *std::make_unique<RayCounts>());
    });
    const RenderResult r = render(scene, stopping, {.threads = 2, .stop = &stop});
    EXPECT_FALSE(r.complete);
    EXPECT_LE(drawn, 20 * 20 * 3 + 2);
    // Every pixel holds its first samples, so it equals a render of that many.
    std::map<std::uint32_t, RenderResult> shorter;
    for (int i = 0; i < 400; ++i) {
        const std::uint32_t n = r.film.count(i % 20, i / 20);
        if (n == 0) continue;
        Scene fewer = test_scene(20, 20, int(n));
        if (!shorter.contains(n)) shorter.emplace(n, render(fewer, noisy));
        ASSERT_EQ(r.film.mean(i % 20, i / 20), shorter.at(n).film.mean(i % 20, i / 20));
    }
}

TEST(RenderLoop, ProgressGrowsToTheTotalAndIsNeverConcurrent) {
    Scene scene = test_scene(64, 64, 8);
    std::atomic<int> inside{0};
    std::uint64_t last = 0;
    int calls = 0;
    RenderOptions options{.threads = 4};
    options.progress = [&](const RenderProgress& p) {
        EXPECT_EQ(++inside, 1);
        EXPECT_GE(p.done, last);
        EXPECT_EQ(p.total, 64u * 64u * 8u);
        last = p.done;
        ++calls;
        --inside;
    };
    const TestIntegrator slow([](const Ray&, Sampler&, const Wavelengths&) {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
        return Spectral(1.f);
    });
    render(scene, slow, options);
    EXPECT_EQ(last, 64u * 64u * 8u);
    EXPECT_GT(calls, 2);
}

TEST(RenderLoop, AnErrorInAThreadReachesTheCaller) {
    const TestIntegrator failing([](const Ray&, Sampler&, const Wavelengths&) -> Spectral {
        throw RunError("the disk is full");
    });
    EXPECT_THROW(render(test_scene(64, 64, 4), failing, {.threads = 4}), RunError);
}

TEST(RenderLoop, WrongRequestsAreAnswered) {
    const auto error = [](const Scene& scene) -> std::string {
        try {
            render(scene, noisy);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(error(test_scene(4, 4, 0)), "0 samples a pixel make no picture; ask for at least 1");
    Scene scene = test_scene(4, 4, 1);
    scene.camera = nullptr;
    EXPECT_EQ(error(scene), "the scene has no camera; add a <sensor>");
}

TEST(RenderOutput, HoldsChannelsVariancesAndOrigin) {
    Scene scene = test_scene(6, 5, 16);
    scene.sampler.seed = 77;
    scene.integrator.moment = true;
    scene.film.crop_x = 1, scene.film.crop_width = 4, scene.film.crop_height = 5;
    const RenderResult r = render(scene, noisy);
    const auto file =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_{}.exr", getpid());
    save_render(r, scene, file, {"nacre render a.xml", "1.2.3", "a.xml"});
    const Image image = read_image(file);
    std::filesystem::remove(file);
    EXPECT_EQ(image.channels,
              (std::vector<std::string>{"R", "G", "B", "variance.B", "variance.G", "variance.R"}));
    EXPECT_EQ(image.rgb(3, 4), r.film.mean(3, 4));
    EXPECT_EQ(image.at(2, 1, image.channel("variance.G")), r.film.sample_variance(2, 1).y);
    const std::map<std::string, std::string> expected{{"nacre.command", "nacre render a.xml"},
                                                      {"nacre.version", "1.2.3"},
                                                      {"nacre.scene", "a.xml"},
                                                      {"nacre.seed", "77"},
                                                      {"nacre.samples", "16"},
                                                      {"nacre.sampler", "independent"},
                                                      {"nacre.mode", "rgb"},
                                                      {"nacre.quantity", "radiance"},
                                                      {"nacre.complete", "yes"},
                                                      {"nacre.crop", "1,0,4,5 of 6x5"},
                                                      {"nacre.rays", "320"},
                                                      {"nacre.scatterings", "640"},
                                                      {"nacre.invalid", "0"}};
    for (const auto& [key, value] : expected) EXPECT_EQ(image.metadata.at(key), value) << key;
    EXPECT_FALSE(image.metadata.contains("nacre.invalid_samples"));
    EXPECT_EQ(partial_path("out/a.png"), "out/a.partial.exr");
    EXPECT_EQ(describe_invalid(r.film), "");
}

}  // namespace
}  // namespace nacre
