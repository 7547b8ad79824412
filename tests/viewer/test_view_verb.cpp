// `nacre view` as it is typed, without a window.
#include <sys/wait.h>

#include "nacre/image/image.h"
#include "nacre/text/whole_file.h"
#include "tests/viewer/device.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

class ViewVerb : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(NACRE_BINARY))
            GTEST_SKIP() << "no program at " << NACRE_BINARY;
        folder_.write("ball.xml", std::string("<scene version='3.0.0'>") + small_sensor +
                                      marble_ball + lamp + "</scene>");
    }
    /// Skips what needs OpenGL where there is none.
    static bool has_device() {
        try {
            const HeadlessContext context;
            return true;
        } catch (const std::runtime_error&) {
            return false;
        }
    }
    /// Runs `nacre arguments` in the test's folder; its exit code.
    int nacre(const std::string& arguments) {
        const int status =
            std::system(fmt::format("cd '{}' && '{}' {} >out 2>err", folder_.file("").string(),
                                    NACRE_BINARY, arguments)
                            .c_str());
        err_ = read_whole_file(folder_.file("err")).value_or("");
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    SceneFolder folder_;
    std::string err_;
};

TEST_F(ViewVerb, RefusesWhatIsWrongBeforeAnythingIsRendered) {
    folder_.write("moves.txt", "orbit 20 10\nlight 30\n");
    folder_.write("plain.xml", std::string("<scene version='3.0.0'>") + small_sensor +
                                   "<shape type='sphere'/>" + lamp + "</scene>");
    const struct {
        const char *arguments, *message;
    } cases[] = {
        {"view ball.xml --frames 2", "--frames belongs to --screenshot, which is missing"},
        {"view ball.xml --screenshot a.gif",
         "a.gif: '.gif' is not an image format that nacre writes; known are .exr, .pfm, .hdr, "
         ".png"},
        {"view ball.xml --screenshot a.png --light-view 300",
         "a light's picture of 300 pixels has no levels; its width is a power of 2, such as 512"},
        {"view plain.xml --screenshot a.png",
         "nothing in the scene is translucent: no shape has a homogeneous medium inside behind a "
         "dielectric boundary, smooth or equally rough everywhere; 'nacre render' shows it"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(nacre(c.arguments), 2) << c.arguments;
        EXPECT_EQ(err_, fmt::format("nacre: {}\n", c.message));
    }
    if (!has_device()) GTEST_SKIP() << "no OpenGL 4.5: scripts are not tried";
    EXPECT_EQ(nacre("view ball.xml --screenshot a.png --script moves.txt"), 2);
    EXPECT_EQ(err_, "nacre: moves.txt:2: write 'light [NUMBER] AZIMUTH ELEVATION'\n");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("a.png")));
}

TEST_F(ViewVerb, WritesThePictureThatRenderWritesAndOthersByScript) {
    if (!has_device()) GTEST_SKIP() << "no OpenGL 4.5 without a window";
    folder_.write("moves.txt",
                  "# a light from the other side\nlight 100 20\nscreenshot b.exr\n"
                  "light -45 35.264\n");
    ASSERT_EQ(
        nacre("render ball.xml --technique translucent_shadow_map --size 12x9 --spp 1 -o r.exr"), 0)
        << err_;
    ASSERT_EQ(nacre("view ball.xml --size 12x9 --screenshot a.exr"), 0) << err_;
    EXPECT_NE(err_.find("nacre: device: "), std::string::npos);
    EXPECT_NE(err_.find("nacre: translucent_shadow_map: 1 frames\n"), std::string::npos);
    const Image render = read_image(folder_.file("r.exr")),
                view = read_image(folder_.file("a.exr"));
    EXPECT_LT(difference(render, view), 1e-5);
    ASSERT_EQ(nacre("view ball.xml --size 12x9 --light-view 64 --light-points 1 --quiet --script "
                    "moves.txt --screenshot c.exr"),
              0)
        << err_;
    EXPECT_EQ(err_, "");
    EXPECT_GT(difference(read_image(folder_.file("b.exr")), read_image(folder_.file("c.exr"))),
              0.1);
}

}  // namespace
}  // namespace nacre::test
