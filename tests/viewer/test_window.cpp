// The window itself, under Xvfb, with a pointer that xdotool moves. Skipped where they are not
// installed, or no OpenGL 4.5 is.
#include <sys/wait.h>

#include "nacre/image/image.h"
#include "nacre/text/whole_file.h"
#include "tests/viewer/device.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

class ViewerWindow : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* program : {"xvfb-run", "xauth", "xdotool"})
            if (std::system(fmt::format("command -v {} >/dev/null", program).c_str()) != 0)
                GTEST_SKIP() << program << " is not installed (Debian: xvfb, xauth, xdotool)";
        try {
            const HeadlessContext context;
        } catch (const std::runtime_error& error) {
            GTEST_SKIP() << error.what();
        }
        folder_.write("ball.xml", std::string("<scene version='3.0.0'>") + small_sensor +
                                      marble_ball + lamp + "</scene>");
    }
    /// Runs a script of the shell in the test's folder; what it prints.
    std::string shell(const std::string& script) {
        folder_.write("script.sh", script);
        const std::string line =
            fmt::format("cd '{}' && {} script.sh >out 2>&1", folder_.file("").string(),
                        "timeout 120 xvfb-run -a -s '-screen 0 1280x800x24' bash");
        code_ = std::system(line.c_str());
        return read_whole_file(folder_.file("out")).value_or("");
    }

    SceneFolder folder_;
    int code_ = -1;
};

TEST_F(ViewerWindow, OpensAndThePointerChangesTheTechnique) {
    // The pointer goes down the panel and clicks until the title names another technique.
    const std::string out = shell(fmt::format(R"(
'{}' view ball.xml --size 300x500 --light-view 64 --light-points 1 &
for i in $(seq 300); do window=$(xdotool search --name 'nacre: ball' | head -1); [ -n "$window" ] && break; sleep 0.2; done
wait_for() {{ for i in $(seq 300); do xdotool getwindowname $window | grep -q -- "$1" && return 0; sleep 0.1; done; return 1; }}
wait_for ' - ' || exit 3
first=$(xdotool getwindowname $window)
xdotool mousemove --window $window 500 250 key --window $window s
for i in $(seq 200); do [ -e ball-1.png ] && break; sleep 0.1; done
for y in $(seq 80 8 400); do
    xdotool mousemove --window $window 60 $y; sleep 0.15
    xdotool mousedown 1; sleep 0.15; xdotool mouseup 1; sleep 0.15
    now=$(xdotool getwindowname $window)
    [ "$now" != "$first" ] && break
done
echo "first: $first"
echo "now: $now"
xdotool mousemove --window $window 500 250
for n in $(seq 40); do
    xdotool key --window $window s; sleep 0.3
    [ -e ball-4.png ] && break
done
xdotool key --window $window Escape
wait %1
echo "exit $?"
)",
                                              NACRE_BINARY));
    const auto named = [&](const std::string& what) {
        const std::string begin = what + ": nacre: ball.xml - ";
        const std::size_t at = out.find(begin);
        if (at == out.npos) return std::string();
        return out.substr(at + begin.size(), out.find('\n', at) - at - begin.size());
    };
    ASSERT_NE(named("first"), "") << out;
    ASSERT_NE(named("now"), "") << out;
    EXPECT_NE(named("first"), named("now")) << out;
    EXPECT_NE(out.find("exit 0\n"), std::string::npos) << out;
    ASSERT_TRUE(std::filesystem::exists(folder_.file("ball-1.png"))) << out;
    ASSERT_TRUE(std::filesystem::exists(folder_.file("ball-4.png"))) << out;
    const Image before = read_image(folder_.file("ball-1.png")),
                after = read_image(folder_.file("ball-4.png"));
    EXPECT_GT(difference(before, after), 0.05);
}

TEST(ViewerWithoutAWindow, SaysWhatIsMissingAndHowToGoOn) {
    if (!std::filesystem::exists(NACRE_BINARY)) GTEST_SKIP() << "no program at " << NACRE_BINARY;
    const SceneFolder folder;
    folder.write("ball.xml", std::string("<scene version='3.0.0'>") + small_sensor + marble_ball +
                                 lamp + "</scene>");
    const int status = std::system(
        fmt::format("cd '{}' && env -u DISPLAY -u WAYLAND_DISPLAY '{}' view ball.xml 2>err",
                    folder.file("").string(), NACRE_BINARY)
            .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    const std::string err = read_whole_file(folder.file("err")).value_or("");
    EXPECT_TRUE(err.starts_with("nacre: no window can be opened: ")) << err;
    EXPECT_NE(err.find("; without a window, 'nacre view SCENE --screenshot out.png' makes pictures "
                       "of the same\n"),
              std::string::npos)
        << err;
}

}  // namespace
}  // namespace nacre::test
