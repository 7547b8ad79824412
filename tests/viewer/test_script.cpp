#include "apps/viewer/script.h"
#include "tests/support/error_of.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

using viewer::Quantity;
using viewer::Step;
using viewer::ViewerState;

TEST(ViewerScript, ChangesTheStateLineByLine) {
    const auto scene = ball();
    ViewerState s = scene.state();
    const auto say = [&](const char* line) { return obey(line, scene, s); };
    say("technique Two-Pass");
    EXPECT_EQ(s.technique.technique, "two_pass");
    say("technique translucent_shadow_map");
    say("set taps 35");
    say("set taps 28");
    EXPECT_EQ(s.technique.option("taps"), "28");
    EXPECT_EQ(s.technique.options.size(), 1u);
    say("split volpath 0.25");
    EXPECT_TRUE(s.split);
    EXPECT_EQ(s.beside.technique, "volpath");
    EXPECT_EQ(s.divider, 0.25);
    say("split off");
    EXPECT_FALSE(s.split);
    say("samples 3");
    EXPECT_EQ(s.samples, 3);
    // The key light is the first that has a direction: the sky has none.
    ASSERT_EQ(s.lights.size(), 3u);
    say("light 30 40");
    EXPECT_EQ(s.lights[1], (viewer::LightEdit{30, 40, 1}));
    say("light 3 -20 10");
    EXPECT_EQ(s.lights[2], (viewer::LightEdit{-20, 10, 1}));
    say("brightness 1 2");
    EXPECT_EQ(s.lights[0].brightness, 2);
    say("material skim milk");
    EXPECT_EQ(s.material.kind, viewer::MaterialEdit::Kind::measured);
    say("coefficients 1,2,3 0.1,0.2,0.3 1.5");
    EXPECT_EQ(s.material.sigma_s, (Vec3f{1, 2, 3}));
    EXPECT_EQ(s.material.eta, 1.5f);
    say("artist 0.8,0.6,0.4 2,1,0.5");
    EXPECT_EQ(s.material.kind, viewer::MaterialEdit::Kind::artist);
    say("material scene");
    EXPECT_EQ(s.material.kind, viewer::MaterialEdit::Kind::scene);
    say("deform twist 0.5");
    EXPECT_EQ(s.deformation, (Deformation{Deformation::Kind::twist, 0.5f, 0.f}));
    say("deform none");
    EXPECT_EQ(s.deformation, Deformation{});
    say("animate on");
    EXPECT_TRUE(s.animated);
    say("exposure -1.5");
    EXPECT_EQ(s.display.exposure, -1.5f);
    say("false_color lx 1e-4 0.1");
    EXPECT_EQ(s.display.quantity, Quantity::illuminance);
    EXPECT_EQ(s.display.high, 0.1);
    say("average off");
    EXPECT_FALSE(s.quality.average);
    EXPECT_EQ(say("frame 10").frames, 10);
    EXPECT_EQ(say("screenshot a.png").kind, Step::Kind::screenshot);
    EXPECT_EQ(say("save a.xml").kind, Step::Kind::save);
    EXPECT_EQ(say("").kind, Step::Kind::change);
}

TEST(ViewerScript, SaysWhatIsWrongWithWhichLine) {
    const auto scene = ball();
    const SceneFolder folder;
    const struct {
        const char *line, *message;
    } cases[] = {
        {"ligth 30 40", "unknown command 'ligth'; did you mean 'light'?"},
        {"technique", "write 'technique NAME'"},
        {"technique two pass", "write 'technique NAME'"},
        {"technique two_pas", "unknown technique 'two_pas'; did you mean 'two_pass'?"},
        {"set taps", "write 'set NAME VALUE'"},
        {"set taps 3", "translucent_shadow_map: taps = 3 is out of range: must lie within [7, 70]"},
        {"split nothing at all", "write 'split TECHNIQUE|off [DIVIDER]'"},
        {"split volpath 2",
         "'2' is not a number from 0 to 1; write 'split TECHNIQUE|off [DIVIDER]'"},
        {"samples 0", "'0' is not a whole number from 1 to 16777216; write 'samples NUMBER'"},
        {"orbit 20", "write 'orbit RIGHT UP'"},
        {"orbit 20 up", "'up' is not a number from -180 to 180; write 'orbit RIGHT UP'"},
        {"zoom 0", "'0' is not a number from 0.001 to 1000; write 'zoom FACTOR'"},
        {"light 30", "write 'light [NUMBER] AZIMUTH ELEVATION'"},
        {"light 7 30 40",
         "'7' is not a whole number from 1 to 3; write 'light [NUMBER] AZIMUTH ELEVATION'"},
        {"light 1 30 40", "light 1 (sky) comes from everywhere and cannot be turned"},
        {"brightness -1",
         "'-1' is not a number from 0 to 1e+09; write 'brightness [NUMBER] FACTOR'"},
        {"material marbel", "unknown measured medium 'marbel'; did you mean 'Marble'?"},
        {"coefficients 1,2 0,0,0", "write 'coefficients SIGMA_S SIGMA_A [ETA]'"},
        {"artist 1,2,0 1,1,1",
         "'2' is not a number from 0 to 1; write 'artist COLOUR RADIUS [ETA]'"},
        {"artist 1,0.5,0 1,0,1", "the radius (1, 0, 1) must lie within (0, 1e6)"},
        {"deform squash", "'squash' is not one of none, twist, bend, breathe"},
        {"animate maybe", "'maybe' is not one of off, on"},
        {"exposure bright", "'bright' is not a number from -100 to 100; write 'exposure STOPS'"},
        {"false_color cd 10", "write 'false_color off|cd|lx [LOW HIGH]'"},
        {"false_color cd 10 5", "the scale ends at 5, which is not above its beginning at 10"},
        {"light_view 300",
         "a light's picture of 300 pixels has no levels; its width is a power of 2, such as 512"},
        {"frame 0", "'0' is not a whole number from 1 to 1000000; write 'frame NUMBER'"},
        {"save scene.txt", "'scene.txt' is not the name of a scene file, .xml"},
    };
    for (const auto& c : cases) {
        const auto file = folder.write(
            "moves.txt", fmt::format("# moves\n\norbit 20 10 # to the right\n{}\n", c.line));
        EXPECT_EQ(error_of([&] { viewer::read_script(file, scene); }),
                  fmt::format("{}:4: {}", file.string(), c.message));
    }
    EXPECT_EQ(error_of([&] { viewer::read_script(folder.file("none.txt"), scene); }),
              folder.file("none.txt").string() + ": cannot be read");
}

TEST(ViewerScript, IsTriedInOrderSoThatOptionsAreThoseOfTheirTechnique) {
    const auto scene = ball();
    const SceneFolder folder;
    const auto file = folder.write("moves.txt", "technique two_pass\nset taps 21\n");
    EXPECT_NE(error_of([&] { viewer::read_script(file, scene); }).find(":2: "), std::string::npos);
    const auto good =
        folder.write("moves.txt", "technique translucent_shadow_map\r\nset taps 21\r\n");
    EXPECT_EQ(viewer::read_script(good, scene).size(), 2u);
}

TEST(ViewerScript, HasAllItsCommandsInTheDocs) {
    std::ifstream in(NACRE_SOURCE_DIR "/docs/viewer.md");
    const std::string docs{std::istreambuf_iterator<char>(in), {}};
    for (const std::string_view name : viewer::command_names())
        EXPECT_NE(docs.find(fmt::format("`{}", name)), std::string::npos) << name;
}

TEST(FalseColors, GrowLighter) {
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
        const Vec3f c = viewer::false_color(float(i) / 100);
        const double light =
            0.2126 * std::pow(c.x, 2.2) + 0.7152 * std::pow(c.y, 2.2) + 0.0722 * std::pow(c.z, 2.2);
        EXPECT_GT(light, last);
        last = light;
    }
    EXPECT_EQ(viewer::false_color(-1), viewer::false_color(0));
    EXPECT_EQ(viewer::false_color(2), (Vec3f{1, 1, 1}));
}

}  // namespace
}  // namespace nacre::test
