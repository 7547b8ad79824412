// Signals and timeouts where the work has not begun to draw yet, and what is saved where it has.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using test::Outcome;
using test::quick_scene;

class Interrupt : public test::CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        std::ofstream(folder_ / "cube.obj")
            << "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
               "v -1 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
    }
};

/// Minutes of irradiance at the points of a cube.
const std::vector<std::string> long_precomputation = {
    "render", "cube.obj", "--technique", "two_pass", "--set", "irradiance_samples=65536",
    "--size", "32x32",    "-o",          "o.exr"};

TEST_F(Interrupt, EverySignalEndsPrecomputation) {
    const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    pid_t children[3];
    for (int i = 0; i < 3; ++i) children[i] = start(long_precomputation, fmt::format("log{}", i));
    for (int i = 0; i < 3; ++i) {
        const std::string log = fmt::format("log{}", i);
        wait_for(log, ": ");
        ASSERT_EQ(kill(children[i], signals[i]), 0);
        int status = 0;
        waitpid(children[i], &status, 0);
        ASSERT_TRUE(WIFEXITED(status)) << signals[i];
        EXPECT_EQ(WEXITSTATUS(status), 130) << signals[i];
        EXPECT_TRUE(
            read(folder_ / log)
                .ends_with(
                    "nacre: interrupted during precomputation: nothing was rendered, nothing was "
                    "written\n"))
            << read(folder_ / log);
        std::filesystem::remove(folder_ / log);
    }
    EXPECT_EQ(written(), std::vector<std::string>{"cube.obj"});
}

TEST_F(Interrupt, ATimeoutEndsPrecomputation) {
    std::string words;
    for (const std::string& w : long_precomputation) words += w + " ";
    const auto start = std::chrono::steady_clock::now();
    const Outcome r = nacre(words + "--timeout 0.5 --quiet");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err,
              "nacre: timeout during precomputation: nothing was rendered, nothing was written\n");
    EXPECT_EQ(written(), std::vector<std::string>{"cube.obj"});
}

TEST_F(Interrupt, AHangupSavesWhatThereIsBesideWhatWasSavedBefore) {
    std::ofstream(folder_ / "long.partial.exr") << "of before";
    const pid_t child =
        start({"render", "quick.xml", "-o", "long.exr", "--spp", "100000000"}, "log");
    wait_for("log", "%");
    ASSERT_EQ(kill(child, SIGHUP), 0);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_EQ(read(folder_ / "long.partial.exr"), "of before");
    EXPECT_EQ(read_image(folder_ / "long.partial-2.exr").metadata.at("nacre.complete"), "no");
}

/// Marble's densest band, blue: sigma_t' = 3.0071 mm^-1; 2 / sqrt(3) 6e6 mm^2 of it are 6.26e7
/// points, and the root of 6.26e7 / 1.25e7 is 2.24.
TEST_F(Interrupt, AdviceOnTheSpacingIsInItsUnit) {
    const Outcome r = nacre("render cube.obj --technique two_pass --height-mm 1000 -o o.exr");
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(
        r.err,
        "nacre: spacing = 1 transport mean free paths takes 6.26e+07 surface points; with points "
        "= elimination the limit is 12500000: set spacing to at least 2.24, or to 7.09, which "
        "takes a tenth of the time and memory\n");
    const Outcome large = nacre("render cube.obj --technique two_pass --height-mm 1e6 -o o.exr");
    EXPECT_EQ(large.code, 2);
    EXPECT_EQ(
        large.err,
        "nacre: spacing = 1 transport mean free paths takes 6.26e+13 surface points; with points "
        "= elimination the limit is 12500000: spacing would have to be 2240, and 100 is the "
        "most: the object is too large for its medium; make it smaller by a factor of 22.5, "
        "or choose another technique\n");
}

TEST_F(Interrupt, WhatATechniqueDoesNotHaveIsRefused) {
    const std::pair<const char*, const char*> cases[] = {
        {"--technique random_walk --profile dipole",
         "random_walk: unknown parameter 'profile'; known are: exit_fresnel, free_path"},
        {"--technique volpath --profile dipole",
         "volpath: it has no parameter 'profile', nor any other"},
        {"--technique volpath --set spacing=2",
         "volpath: it has no parameter 'spacing', nor any other"},
        {"--technique brdf --set error=0.1",
         "brdf: unknown parameter 'error'; known are: profile, exit_fresnel"},
        {"--technique two_pass --set spacing=nan",
         "two_pass: spacing = nan is out of range: must lie within [0.01, 100]"},
        {"--technique two_pass --set spacing=1.2.3",
         "two_pass: spacing = '1.2.3' must be a number within [0.01, 100]"},
        {"--technique two_pass --set irradiance_samples=4294967297",
         "two_pass: irradiance_samples = 4294967297 is out of range: must lie within [1, 65536]"},
    };
    for (const auto& [options, message] : cases) {
        const Outcome r = nacre(fmt::format("render cube.obj {}", options));
        EXPECT_EQ(r.code, 2) << options;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << options;
    }
}

/// A line every five seconds, also where nothing is drawn.
TEST_F(Interrupt, LongSlabsTellHowFarTheyAre) {
    const pid_t child = start({"slab", "--layer", "tau=1e5 albedo=1", "--method", "mc"}, "log");
    wait_for("log", "photons: ");
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_NE(read(folder_ / "log").find("photons: "), std::string::npos);
}

}  // namespace
}  // namespace nacre
