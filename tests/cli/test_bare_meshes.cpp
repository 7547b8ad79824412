// A mesh that nobody prepared, on the command line: what is guessed is said, and options have the
// last word.
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using nlohmann::json;

class BareMeshes : public test::CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        // A pyramid on its base, whose apex is at +z.
        std::ofstream(folder_ / "apex.obj")
            << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 3\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\n"
               "f 3 4 5\nf 4 1 5\n";
        Image sky(8, 5);
        std::ranges::fill(sky.data, 0.5f);
        write_image(sky, folder_ / "sky.exr");
    }
    test::Outcome render(const std::string& options, const std::string& how = "brdf") const {
        return nacre("render apex.obj --size 16x16 --spp 4 -o a.pfm --technique " + how + " " +
                     options);
    }
};

TEST_F(BareMeshes, SayHowTheyStand) {
    const std::string said =
        "nacre:   up is +z, by its shape, and the front -y; --up and --view "
        "change that\n";
    const std::string all = render("").err;
    EXPECT_NE(all.find(said), std::string::npos) << all;
    EXPECT_EQ(render("--quiet").err, "");
    EXPECT_EQ(render("--up z --view front").err.find("up is"), std::string::npos);
    EXPECT_NE(render("--up -x").err.find("nacre:   up is -x and the front +z; "),
              std::string::npos);
    const json summary = json::parse(render("--json --quiet").out);
    EXPECT_EQ(summary["pose"], json::parse(R"({"up": "+z", "up_by_shape": true, "front": "-y",
                                               "front_by_shape": false})"));
    const json info = json::parse(nacre("info apex.obj --json").out);
    EXPECT_EQ(info["up"], "+z");
    EXPECT_EQ(info["front"], "-y");
    EXPECT_FALSE(
        json::parse(nacre("render quick.xml --json --quiet -o b.pfm").out).contains("pose"));
}

/// The corner pixels see what is behind the object, and all of a picture what lights it.
TEST_F(BareMeshes, StandInFrontOfWhatIsAskedFor) {
    const auto corner = [&](const std::string& options, const std::string& how = "brdf") {
        const test::Outcome r = render(options, how);
        EXPECT_EQ(r.code, 0) << r.err;
        const Image image = read_image(folder_ / "a.pfm");
        return Vec3f{image.at(0, 0, 0), image.at(0, 0, 1), image.at(0, 0, 2)};
    };
    EXPECT_EQ(corner("--background 0.25,0.5,0.75"), Vec3f(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(corner("--background none --light 'sphere position=-200,300,300'"), Vec3f());
    EXPECT_EQ(corner("--env 'sky.exr scale=4' --background env"), Vec3f(2, 2, 2));
    EXPECT_EQ(corner("--env sky.exr --background 0,1,0"), Vec3f(0, 1, 0));
    EXPECT_EQ(corner("--background 0,1,0 --camera 'origin=0,50,500'", "volpath"), Vec3f(0, 1, 0));
    // In the light of a white furnace of 0.5 a white floor would be 0.5, and this one is grey.
    const float floor = corner("--env sky.exr --floor --view 0,60").x;
    EXPECT_GT(floor, 0.1f);
    EXPECT_LT(floor, 0.3f);
}

TEST_F(BareMeshes, SettingsAreInTheHelp) {
    const std::string help = nacre("help render").out;
    for (const char* part : {"  --camera: a viewer at a place\n    origin ", "    rotate ",
                             "  --light spot: a cone\n    position ", "\nexit codes: "})
        EXPECT_NE(help.find(part), std::string::npos) << part;
}

TEST_F(BareMeshes, WrongInput) {
    const std::pair<const char*, const char*> cases[] = {
        {"apex.obj --up w", "--up: unknown direction 'w'; known are: x, y, z, -x, -y, -z"},
        {"apex.obj --view frnt", "--view: unknown view 'frnt'; did you mean 'front'?"},
        {"apex.obj --view front --camera origin=0,0,9",
         "give either --view or --camera: both say where the viewer is"},
        {"apex.obj --floor --no-floor", "give either --floor or --no-floor"},
        {"apex.obj --env no.hdr", "--env: cannot find 'no.hdr'"},
        {"apex.obj --light lamp",
         "--light: unknown light 'lamp'; known are: point, spot, directional, sphere, area"},
        {"apex.obj --env sky.exr -o sky.exr",
         "sky.exr: is read as well: it would be overwritten; name another output by -o"},
        {"quick.xml --up z",
         "quick.xml: --up is for bare meshes; a scene says itself what its shapes are"},
        {"quick.xml --env sky.exr",
         "quick.xml: --env is for bare meshes; a scene says itself what is in it"},
        {"quick.xml --no-floor",
         "quick.xml: --no-floor is for bare meshes; a scene says itself what is in it"},
        {"demo --view top", "demo: --view is for bare meshes; a scene says itself what is in it"},
    };
    for (const auto& [arguments, message] : cases) {
        const test::Outcome r = nacre(std::string("render ") + arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
    }
}

}  // namespace
}  // namespace nacre
