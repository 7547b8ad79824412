// What is written where: standard output that fails, files beside others, inputs as outputs.
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

class Streams : public test::CommandLine {
  protected:
    /// Runs `nacre arguments` with the shell's redirections; standard error comes back.
    Outcome redirected(const std::string& arguments, const std::string& redirections) const {
        const std::string line = fmt::format("cd '{}' && '{}' {} 2>stderr {}", folder_.string(),
                                             NACRE_BINARY, arguments, redirections);
        const int status = std::system(line.c_str());
        Outcome r{WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read(folder_ / "stderr")};
        fs::remove(folder_ / "stderr");
        return r;
    }
};

TEST_F(Streams, OutputThatIsLostIsAFailureOfEveryVerb) {
    ASSERT_EQ(nacre("render quick.xml -o a.exr --quiet").code, 0);
    for (const char* verb :
         {"--version", "help", "help render", "render --help", "models", "models show ggx",
          "diff a.exr a.exr", "diff a.exr a.exr --json", "info a.exr", "info a.exr --json",
          "info quick.xml", "slab --layer thickness=1 --method ad", "profile dipole --sigma-s 1",
          "eval lambert --wi 0,0,1 --wo 0,0,1", "check lambert --samples 1000",
          "render quick.xml -o b.exr --quiet --json"}) {
        const Outcome full = redirected(verb, ">/dev/full");
        EXPECT_EQ(full.code, 1) << verb;
        EXPECT_NE(full.err.find("No space left on device"), std::string::npos)
            << verb << ": " << full.err;
        const Outcome closed = redirected(verb, ">&-");
        EXPECT_EQ(closed.code, 1) << verb;
        EXPECT_NE(closed.err.find("Bad file descriptor"), std::string::npos)
            << verb << ": " << closed.err;
    }
}

TEST_F(Streams, OnlyStandardOutputMatters) {
    // A reader that has seen enough ends the program without a word.
    EXPECT_EQ(redirected("models", "| head -1 >/dev/null").err, "");
    const std::string messages =
        fmt::format("cd '{}' && '{}' render quick.xml -o a.exr --spp 1 >stdout 2>/dev/full",
                    folder_.string(), NACRE_BINARY);
    EXPECT_EQ(std::system(messages.c_str()), 0);
    const std::string wrong =
        fmt::format("'{}' render none.xml >/dev/null 2>/dev/full", NACRE_BINARY);
    EXPECT_EQ(WEXITSTATUS(std::system(wrong.c_str())), 2);
    // Closed streams do not end up in files.
    const std::string closed =
        fmt::format("cd '{}' && '{}' render quick.xml -o b.exr --spp 1 <&- >&- 2>&-",
                    folder_.string(), NACRE_BINARY);
    EXPECT_EQ(std::system(closed.c_str()), 0);
    EXPECT_EQ(read_image(folder_ / "b.exr").width, 24);
}

TEST_F(Streams, ATableBesideAPlotTakesNoOtherName) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no gnuplot (Debian: gnuplot-nox)";
    std::ofstream(folder_ / "x.csv") << "mine\n";
    ASSERT_EQ(nacre("eval lambert --curve -o x.svg").code, 0);
    ASSERT_EQ(nacre("eval lambert --curve -o x.png").code, 0);
    EXPECT_EQ(written(),
              (std::vector<std::string>{"x.csv", "x.png", "x.png.csv", "x.svg", "x.svg.csv"}));
    EXPECT_EQ(read(folder_ / "x.csv"), "mine\n");
    EXPECT_TRUE(read(folder_ / "x.svg.csv").starts_with("theta_o_deg,theta_i=0,"));
}

TEST_F(Streams, WhatIsReadIsNotOverwritten) {
    ASSERT_EQ(nacre("render quick.xml -o sky.exr --quiet").code, 0);
    std::string scene = test::quick_scene;
    const std::size_t begin = scene.find("<emitter"), end = scene.find("</emitter>") + 10;
    scene.replace(begin, end - begin,
                  R"(<emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>)");
    std::ofstream(folder_ / "sky.xml") << scene;
    fs::create_symlink("sky.exr", folder_ / "link.exr");
    const std::string sky = read(folder_ / "sky.exr");
    const std::pair<const char*, const char*> cases[] = {
        {"render sky.xml", "sky.exr"},  // the output that is not named
        {"render sky.xml -o ./sky.exr", "./sky.exr"},
        {"image sky.exr -o link.exr --exposure 1", "link.exr"},
        {"image sky.exr -o sky.exr", "sky.exr"},
        {"diff sky.exr sky.exr --error-map sky.exr", "sky.exr"},
    };
    for (const auto& [arguments, file] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}: is read as well: it would be overwritten; name "
                                     "another output by -o\n",
                                     file))
            << arguments;
        EXPECT_EQ(read(folder_ / "sky.exr"), sky) << arguments;
    }
    EXPECT_EQ(nacre("render sky.xml -o other.exr --quiet").code, 0);
}

TEST_F(Streams, APlaceThatDoesNotExistIsToldBeforeTheWork) {
    for (const char* arguments :
         {"eval lambert --curve -o no/a.csv", "profile dipole --sigma-s 1 --mc 1e12 -o no/a.csv",
          "slab --layer 'tau=1 albedo=0.9' --radial --photons 1e12 -o no/a.csv"}) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, "nacre: no/a.csv: the folder no does not exist; make it first\n")
            << arguments;
    }
}

}  // namespace
}  // namespace nacre
