// The command line as its users meet it: exit codes, exact messages, what is written and what is
// not.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "nacre/image/image.h"
#include "nacre/optics/media.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using test::CommandLine;
using test::Outcome;
using test::quick_scene;

TEST_F(CommandLine, WrongCommandLinesAreAnsweredExactlyAndWriteNothing) {
    const std::pair<const char*, const char*> cases[] = {
        {"rendr", "unknown verb 'rendr'; did you mean 'render'?"},
        {"render", "scene is required; see 'nacre help render'"},
        {"render quick.xml --sppp 4", "unknown option '--sppp'; did you mean '--spp'?"},
        {"render quick.xml other.xml", "unexpected argument 'other.xml'; see 'nacre help'"},
        {"render quick.xml --spp four", "--spp: 'four' is not a whole number from 1 to 1073741824"},
        {"render quick.xml --spp 0", "--spp: '0' is not a whole number from 1 to 1073741824"},
        {"render quick.xml -t 0", "--threads: '0' is not a whole number from 1 to 65536"},
        {"render quick.xml --timeout -1",
         "--timeout: '-1' is not a time above 0 to 1e+09 s, such as 90, 60s, 5m or 1h30m"},
        {"render quick.xml --size 64",
         "--size: '64' is not a size; write WIDTHxHEIGHT in pixels, from 1 to 65536 each, such as "
         "640x480"},
        {"render quick.xml --size 0x64",
         "--size: '0x64' is not a size; write WIDTHxHEIGHT in pixels, from 1 to 65536 each, such "
         "as "
         "640x480"},
        {"render quick.xml --crop 1,2,3",
         "--crop: '1,2,3' is not a window; write x,y,width,height in pixels"},
        {"render quick.xml --crop 20,0,10,10",
         "the crop window 20,0 10x10 leaves the film of 24 x 16 pixels"},
        {"render quick.xml --mode cmyk", "--mode: unknown mode 'cmyk'; known are: rgb, spectral"},
        {"render quick.xml -D spp", "-D: 'spp' is not of the form name=value"},
        {"render quick.xml --integrator bdpt",
         "unknown integrator 'bdpt'; known are: ray, path, volpath, legacy"},
        {"render quick.xml --material marble",
         "quick.xml: --material is for bare meshes; a scene says itself what its shapes are"},
        {"render flat.obj -D a=1", "flat.obj: -D is for scene files; a mesh has no names to set"},
        {"render flat.obj --height-mm 0", "--height-mm: '0' is not a number from 1e-09 to 1e+09"},
        {"render photo.png", "photo.png: is an image; render takes a scene or a mesh"},
        {"render quick.xml -o a.tiff",
         "a.tiff: '.tiff' is not an image format that nacre writes; known are .exr, .pfm, .hdr, "
         ".png"},
        {"render quick.xml -o no/a.exr", "no/a.exr: the folder no does not exist; make it first"},
        {"image missing.exr -o a.png", "missing.exr: no such file"},
        {"image quick.xml -o a.png",
         "quick.xml: '.xml' is not an image format that nacre reads; known are .exr, .pfm, .hdr, "
         ".png, .jpg"},
        {"image a.exr", "--output is required; see 'nacre help image'"},
        {"info missing.png", "missing.png: no such file"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
        EXPECT_EQ(r.out, "") << arguments;
        EXPECT_EQ(written(), std::vector<std::string>{}) << arguments;
    }
}

TEST_F(CommandLine, ErrorsOfASceneNameFileAndLine) {
    std::string scene = quick_scene;
    scene.replace(scene.find("diffuse"), 7, "difuse!");
    std::ofstream(folder_ / "quick.xml") << scene;
    const Outcome r = nacre("render quick.xml");
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.err,
              "nacre: quick.xml:16:26: unknown bsdf type 'difuse!'; did you mean 'diffuse'?\n");
    EXPECT_TRUE(written().empty());
}

TEST_F(CommandLine, HelpAndVersion) {
    EXPECT_EQ(nacre("--version").out.substr(0, 6), "nacre ");
    const Outcome list = nacre("");
    EXPECT_EQ(list.code, 0);
    EXPECT_EQ(list.out, nacre("help").out);
    for (const char* verb : {"render", "demo", "models", "eval", "check", "info", "image"}) {
        EXPECT_NE(list.out.find(fmt::format("\n  {} ", verb)), std::string::npos);
        const Outcome r = nacre(fmt::format("help {}", verb));
        EXPECT_EQ(r.code, 0);
        EXPECT_EQ(r.out, nacre(fmt::format("{} --help", verb)).out);
        EXPECT_NE(r.out.find(fmt::format("nacre {}", verb)), std::string::npos);
    }
    EXPECT_NE(nacre("help render").out.find("--no-guided-exits"), std::string::npos);
    EXPECT_EQ(nacre("help rendr").code, 2);
}

/// A white sphere in a white furnace cannot be seen: every pixel is the light's 0.5.
TEST_F(CommandLine, RendersASceneAndSaysSo) {
    const Outcome r = nacre("render quick.xml --json -Dspp=64 --seed 5 -t 2 --strict");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(written(), std::vector<std::string>{"quick.exr"});
    const json summary = json::parse(r.out);
    EXPECT_EQ(summary["output"], "quick.exr");
    EXPECT_EQ(summary["complete"], true);
    EXPECT_EQ(summary["width"], 24);
    EXPECT_EQ(summary["height"], 16);
    EXPECT_EQ(summary["samples"], 64);
    EXPECT_EQ(summary["seed"], 5);
    EXPECT_EQ(summary["invalid_samples"], 0);
    EXPECT_NEAR(summary["mean"][1].get<double>(), 0.5, 0.01);
    const Image image = read_image(folder_ / "quick.exr");
    EXPECT_EQ(image.width, 24);
    EXPECT_EQ(image.metadata.at("nacre.command"),
              "nacre render quick.xml --json -Dspp=64 --seed 5 -t 2 --strict");
    EXPECT_NE(r.err.find("nacre: wrote quick.exr (24 x 16, "), std::string::npos) << r.err;
}

TEST_F(CommandLine, OptionsReplaceWhatTheSceneSays) {
    const Outcome r = nacre(
        "render quick.xml -o a.exr --size 40x30 --crop 5,6,7,8 --spp 3 --integrator volpath --mode "
        "spectral --variance --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(r.out, "");
    const Image image = read_image(folder_ / "a.exr");
    EXPECT_EQ(image.width, 7);
    EXPECT_EQ(image.height, 8);
    EXPECT_NE(image.channel("variance.R"), -1);
    EXPECT_EQ(image.metadata.at("nacre.samples"), "3");
    EXPECT_EQ(image.metadata.at("nacre.mode"), "spectral");
    EXPECT_EQ(image.metadata.at("nacre.integrator"), "volpath");
    EXPECT_EQ(image.metadata.at("nacre.crop"), "5,6,7,8 of 40x30");
}

TEST_F(CommandLine, ThreadsDoNotChangeABit) {
    // A grey sphere: pixels at its edge depend on where their samples fall.
    std::string grey = quick_scene;
    grey.replace(grey.find("1, 1, 1"), 7, "0.5, 0.5, 0.5");
    std::ofstream(folder_ / "grey.xml") << grey;
    ASSERT_EQ(nacre("render grey.xml -o a.pfm -t 1 --quiet").code, 0);
    ASSERT_EQ(nacre("render grey.xml -o b.pfm -t 5 --quiet").code, 0);
    EXPECT_EQ(read(folder_ / "a.pfm"), read(folder_ / "b.pfm"));
    ASSERT_EQ(nacre("render grey.xml -o c.pfm --seed 1 --quiet").code, 0);
    EXPECT_NE(read(folder_ / "a.pfm"), read(folder_ / "c.pfm"));
}

/// Starts a long render, interrupts it once it has surely begun to draw, and waits for its end.
TEST_F(CommandLine, CtrlCSavesWhatThereIsAndExitsWith130) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        if (chdir(folder_.c_str()) != 0 || !freopen("stderr", "w", stderr)) _exit(99);
        execl(NACRE_BINARY, NACRE_BINARY, "render", "quick.xml", "-o", "long.png", "--spp",
              "100000000", static_cast<char*>(nullptr));
        _exit(98);
    }
    // The first line of progress says that samples are being drawn.
    for (int i = 0; i < 600 && read(folder_ / "stderr").find('%') == std::string::npos; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_EQ(kill(child, SIGINT), 0);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const std::string err = read(folder_ / "stderr");
    EXPECT_NE(err.find("nacre: interrupted with "), std::string::npos) << err;
    fs::remove(folder_ / "stderr");
    EXPECT_EQ(written(), std::vector<std::string>{"long.partial.exr"});
    const Image image = read_image(folder_ / "long.partial.exr");
    EXPECT_EQ(image.metadata.at("nacre.complete"), "no");
    EXPECT_NEAR(image.rgb(12, 8).x, 0.5f, 0.1f);
}

/// Two lights that a float holds each but not together: the lit side of the sphere is infinite.
// A plate of half a cell: rendered, counted, and refused if strict.
TEST_F(CommandLine, PartsThinnerThanTheDiffusionGridAreFatalIfStrict) {
    std::ofstream(folder_ / "plate.xml")
        << "<scene version=\"3.0.0\"><integrator type=\"path\"/>"
           "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"0,0,4\" "
           "target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor><emitter type=\"constant\"/>"
           "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"1\" y=\"1\" z=\"0.02\"/>"
           "</transform><bsdf type=\"dielectric\"/><medium type=\"homogeneous\" "
           "name=\"interior\"><float name=\"sigma_s\" value=\"5\"/><float name=\"sigma_a\" "
           "value=\"0.1\"/></medium></shape></scene>";
    const std::string command =
        "render plate.xml --technique diffusion_grid --set cells=24 --size 4x4 --spp 1 -o a.exr "
        "--quiet";
    const Outcome strict = nacre(command + " --strict");
    EXPECT_EQ(strict.code, 1);
    EXPECT_EQ(strict.err,
              "nacre: 1e+02 % of the surface is of parts thinner than two cells of the diffusion "
              "grid; --strict: a.exr was not written; set cells to more\n");
    EXPECT_EQ(std::ranges::count(written(), "a.exr"), 0);
    EXPECT_EQ(nacre(command).code, 0);
    EXPECT_EQ(
        nacre("render plate.xml --technique diffusion_grid --set cells=160 --size 4x4 --spp 1 "
              "-o b.exr --quiet --strict")
            .code,
        0);
}

TEST_F(CommandLine, InvalidSamplesAreReportedAndFatalIfStrict) {
    std::string scene = quick_scene;
    scene.replace(scene.find("0.5, 0.5, 0.5"), 13, "3.4e38, 0, 0");
    scene.insert(scene.find("    <shape"),
                 "<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, -1\"/>"
                 "<rgb name=\"irradiance\" value=\"3.4e38, 0, 0\"/></emitter>\n");
    std::ofstream(folder_ / "quick.xml") << scene;
    const Outcome strict = nacre("render quick.xml -o a.exr --strict --quiet");
    EXPECT_EQ(strict.code, 1);
    EXPECT_TRUE(written().empty());
    EXPECT_NE(strict.err.find(" invalid samples (not finite or negative), the first at pixel ("),
              std::string::npos)
        << strict.err;
    EXPECT_NE(strict.err.find("; --strict: a.exr was not written\n"), std::string::npos);
    const Outcome lax = nacre("render quick.xml -o a.exr --quiet --json");
    EXPECT_EQ(lax.code, 0);
    EXPECT_TRUE(lax.err.starts_with("nacre: warning: ")) << lax.err;
    const Image image = read_image(folder_ / "a.exr");
    EXPECT_EQ(json::parse(lax.out)["invalid_samples"],
              std::stoi(image.metadata.at("nacre.invalid")));
    EXPECT_TRUE(image.metadata.at("nacre.invalid_samples").starts_with("pixel ("));
}

TEST_F(CommandLine, ATimeoutSavesWhatThereIs) {
    const Outcome r = nacre("render quick.xml -o a.exr --spp 100000000 --timeout 0.5 --json");
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find("nacre: timeout with "), std::string::npos) << r.err;
    const json summary = json::parse(r.out);
    EXPECT_EQ(summary["complete"], false);
    EXPECT_GE(summary["fewest_samples"], 1);
    EXPECT_LE(summary["most_samples"].get<int>(), summary["fewest_samples"].get<int>() + 16);
    EXPECT_EQ(written(), std::vector<std::string>{"a.exr"});
}

TEST_F(CommandLine, ModelsListsEveryMeasuredMedium) {
    const json all = json::parse(nacre("models --json").out);
    EXPECT_EQ(all["medium"].size(), measured_media().size());
    EXPECT_EQ(all["medium"].size(), 47u);
    for (const char* name : {"diffuse", "dielectric", "null"})
        EXPECT_NE(std::find(all["bsdf"].begin(), all["bsdf"].end(), name), all["bsdf"].end());
    for (const char* name : {"ray", "path", "volpath"})
        EXPECT_NE(std::find(all["integrator"].begin(), all["integrator"].end(), name),
                  all["integrator"].end());
    // Jensen et al. 2001, figure 5: marble.
    const json marble = json::parse(nacre("models show marble --json").out);
    EXPECT_EQ(marble["sigma_s_prime_per_mm"], json({2.19, 2.62, 3.0}));
    EXPECT_EQ(marble["sigma_a_per_mm"], json({0.0021, 0.0041, 0.0071}));
    EXPECT_EQ(marble["eta"], 1.5);
    const Outcome r = nacre("models show marbel");
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(r.err.starts_with("nacre: unknown model 'marbel'; did you mean 'Marble'?"));
}

TEST_F(CommandLine, InfoDescribesImagesMeshesAndScenes) {
    Image image(3, 2);
    image.at(1, 1, 1) = 6.f;
    image.at(2, 1, 2) = std::numeric_limits<float>::infinity();
    image.metadata["note"] = "hello";
    write_image(image, folder_ / "a.exr");
    const json a = json::parse(nacre("info a.exr --json").out);
    EXPECT_EQ(a["width"], 3);
    EXPECT_EQ(a["channels"][1]["name"], "G");
    EXPECT_EQ(a["channels"][1]["max"], 6.0);
    EXPECT_EQ(a["channels"][1]["mean"], 1.0);
    EXPECT_EQ(a["channels"][2]["not_finite"], 1);
    EXPECT_EQ(a["metadata"]["note"], "hello");
    const json mesh = json::parse(nacre("info flat.obj --json").out);
    EXPECT_EQ(mesh["triangles"], 1);
    EXPECT_EQ(mesh["closed"], false);
    EXPECT_EQ(mesh["boundary_edges"], 3);
    const json scene = json::parse(nacre("info quick.xml --json").out);
    EXPECT_EQ(scene["film"]["width"], 24);
    EXPECT_EQ(scene["sampler"]["samples"], 2);
    EXPECT_EQ(scene["lights"], 1);
    EXPECT_NE(nacre("info quick.xml").out.find("integrator: path\n"), std::string::npos);
}

TEST_F(CommandLine, ImageConvertsAndExposes) {
    Image image(2, 1);
    image.data = {0.25f, 0.25f, 0.25f, 2.f, 3.f, 4.f};
    write_image(image, folder_ / "a.exr");
    EXPECT_EQ(nacre("image a.exr -o b.pfm --exposure 2").code, 0);
    EXPECT_EQ(read_image(folder_ / "b.pfm").data, (std::vector<float>{1, 1, 1, 8, 12, 16}));
    EXPECT_EQ(nacre("image a.exr -o b.png --exposure 2").code, 0);
    EXPECT_EQ(read_image(folder_ / "b.png").rgb(0, 0), Vec3f(1, 1, 1));
    EXPECT_EQ(nacre("image a.exr -o b.png --exposure -1").code, 0);
    EXPECT_NEAR(read_image(folder_ / "b.png").rgb(0, 0).x, 0.125f, 0.002f);
}

}  // namespace
}  // namespace nacre
