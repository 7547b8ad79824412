// What a kept film says that it shows, and what goes together.
#include "nacre/techniques/render_state.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "tests/metrics/pictures_fixture.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

using test::error_of;
namespace fs = std::filesystem;

struct Kept {
    Scene scene;
    RenderPlan plan;
    RenderIdentity is() const { return identity_of(scene, plan, FrameSettings::of(scene)); }
};

class RenderStates : public RenderTest {
  protected:
    Kept kept(double thickness = 2) {
        Kept k{scene(xml::integrator("path") + xml::constant_light() +
                     slab(thickness, subsurface("dipole", ""))),
               {}};
        k.scene.film = {};
        k.plan = plan_of(k.scene);
        return k;
    }
};

/// Each setting that changes a sample is named, alone, and what changes none is not.
TEST_F(RenderStates, EverySettingThatChangesABitIsPartOfIt) {
    const RenderIdentity plain = kept().is();
    const std::pair<void (*)(Scene&), const char*> cases[] = {
        {[](Scene& s) { s.integrator.max_depth = 7; }, "max_depth (-1 there, 7 here)"},
        {[](Scene& s) { s.integrator.rr_depth = 8; }, "rr_depth (5 there, 8 here)"},
        {[](Scene& s) { s.integrator.hide_emitters = true; },
         "hide_emitters (false there, true here)"},
        {[](Scene& s) { s.integrator.distance_grid = false; },
         "distance_grid (true there, false here)"},
        {[](Scene& s) { s.integrator.guided_exits = false; },
         "guided_exits (true there, false here)"},
        {[](Scene& s) { s.mode = ColorMode::spectral; }, "mode (rgb there, spectral here)"},
        {[](Scene& s) { s.mm_per_unit = 2; }, "scene"},
        {[](Scene& s) { s.film.filter = {.type = "box"}; },
         "film (768x576 pixels of radiance, gaussian filter there, 768x576 pixels of radiance, box "
         "filter here)"},
        {[](Scene& s) { s.film.filter.radius = 3; },
         "film (768x576 pixels of radiance, gaussian filter there, 768x576 pixels of radiance, "
         "gaussian filter of radius 3 here)"},
        {[](Scene& s) { s.film.sample_border = true; },
         "film (768x576 pixels of radiance, gaussian filter there, 768x576 pixels of radiance, "
         "gaussian filter beyond the border here)"},
        {[](Scene& s) { s.sampler.type = "sobol"; }, "sampler (independent there, sobol here)"},
        // What is the same for every sample, or is kept apart.
        {[](Scene& s) { s.integrator.moment = true; }, ""},
        {[](Scene& s) { s.sampler.samples = 99; }, ""},
        {[](Scene& s) { s.sampler.seed = 9; }, ""},
        {[](Scene& s) { s.film.crop_width = s.film.crop_height = 5; }, ""},
    };
    for (const auto& [change, difference] : cases) {
        Kept k = kept();
        change(k.scene);
        EXPECT_EQ(differences(plain, k.is()), difference);
    }
    Kept k = kept();
    k.plan = plan_of(k.scene, {"two_pass", {{"error", "0.3"}}});
    RenderIdentity two_pass = k.is();
    k.plan = plan_of(k.scene, {"two_pass", {{"error", "0.4"}}});
    const std::string text = differences(two_pass, k.is());
    EXPECT_TRUE(text.starts_with("technique of shape 1 (two_pass profile=dipole ")) << text;
    EXPECT_NE(text.find("error=0.3 "), text.npos) << text;
    EXPECT_NE(text.find("error=0.4 "), text.npos) << text;
    EXPECT_EQ(differences(plain, kept(3).is()), "mesh; shape");
}

FilmSettings settings() {
    FilmSettings s;
    s.width = 6, s.height = 4;
    s.filter.type = "mitchell";
    return s;
}

/// Samples of a seed, which another film may have, too.
void add(Film& film, std::uint64_t seed, int samples) {
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            for (int i = 0; i < samples; ++i) {
                Random random(stream_key(seed, std::uint64_t(y * 6 + x), std::uint64_t(i)));
                const float v = random.next(), w = random.next() < 0.03f ? std::nanf("") : v * v;
                film.add(x, y, std::uint32_t(i), {v, w, 1.f}, random.next() < 0.2f ? -1.f : 1.f);
            }
}

RenderState state(std::uint64_t seed, int samples) {
    RenderState s{Film(settings())};
    add(s.film, seed, samples);
    s.identity = {{"sampler", "independent"}};
    s.parts = {part_of(s.film, seed)};
    s.samples = samples;
    s.complete = true;
    s.seconds = 2;
    s.counts.rays = 10;
    return s;
}

TEST(RenderState, MergedIsTheFilmThatSawAllSamples) {
    Film whole(settings());
    std::vector<RenderState> states;
    for (const auto& [seed, samples] : {std::pair(3, 10), {1, 20}, {2, 5}}) {
        add(whole, std::uint64_t(seed), samples);
        states.push_back(state(std::uint64_t(seed), samples));
    }
    const RenderState all = merge(std::move(states), {"a", "b", "c"});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            EXPECT_EQ(all.film.count(x, y), whole.count(x, y));
            EXPECT_EQ(all.film.drawn(x, y), 35u);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(all.film.mean(x, y)[c], whole.mean(x, y)[c], 1e-6);
                EXPECT_NEAR(all.film.sample_variance(x, y)[c], whole.sample_variance(x, y)[c],
                            1e-6);
            }
        }
    EXPECT_EQ(all.film.invalid_count(), whole.invalid_count());
    EXPECT_GT(whole.invalid_count(), 0u);
    EXPECT_EQ(all.samples, 35);
    EXPECT_TRUE(all.complete);
    EXPECT_EQ(all.seconds, 6);
    EXPECT_EQ(all.counts.rays, 30u);
    EXPECT_EQ(all.parts, (std::vector<RenderPart>{
                             {3, 10, 0, 0, 6, 4}, {1, 20, 0, 0, 6, 4}, {2, 5, 0, 0, 6, 4}}));
}

TEST(RenderState, SaysAllOfItInItsFile) {
    RenderState s = state(18446744073709551615u, 7);
    s.identity = {{"shape", "0123456789abcdef"}, {"technique of shape 1", "x y=1"}};
    const fs::path file = fs::path(testing::TempDir()) / fmt::format("state_{}.exr", getpid());
    RenderState::save(s.film, s, file);
    const RenderState again = RenderState::load(file);
    EXPECT_EQ(again.identity, s.identity);
    EXPECT_EQ(again.parts, s.parts);
    EXPECT_EQ(again.samples, 7);
    EXPECT_TRUE(again.complete);
    EXPECT_EQ(again.counts.rays, 10u);
    for (const char* parts : {"", "1 2 3", "1 2 3 4 5 6 7", "x 2 0 0 6 4", "-1 2 0 0 6 4",
                              "1 -2 0 0 6 4", "1 2 0 0 6 99999999999"}) {
        FilmState::save(s.film, {{"parts", parts}}, file);
        EXPECT_EQ(error_of([&] { RenderState::load(file); }),
                  fmt::format("{}: is not the state of a render: it holds parts = '{}'",
                              file.string(), parts));
    }
    fs::remove(file);
}

}  // namespace
}  // namespace nacre
