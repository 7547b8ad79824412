// Films that are kept, gone on with and merged; renders to a noise.
#include <cmath>
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using test::Outcome;
namespace fs = std::filesystem;

class KeptFilms : public test::CommandLine {
  protected:
    /// The quick scene with a lamp, which makes noise.
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        std::string text = test::quick_scene;
        text.insert(text.rfind("</scene>"),
                    "<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"1\" z=\"1\"/><float "
                    "name=\"radius\" value=\"0.3\"/><emitter type=\"area\"><rgb name=\"radiance\" "
                    "value=\"5, 2, 1\"/></emitter></shape>\n");
        std::ofstream(folder_ / "lit.xml") << text;
    }
    std::vector<float> pixels(const char* file) const { return read_image(folder_ / file).data; }
    std::string note(const char* file, const char* name) const {
        return read_image(folder_ / file).metadata.at(std::string("nacre.") + name);
    }
    void expect_refused(const std::string& arguments, const std::string& message) const {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
    }
};

/// A machine that goes down takes no more with it than what came after the last checkpoint.
TEST_F(KeptFilms, AreGoneOnWithAfterAKill) {
    const std::string arguments = "render lit.xml --spp 3000 --checkpoint 0.05 --quiet";
    ASSERT_EQ(nacre(arguments + " -o whole.png").code, 0);
    EXPECT_EQ(note("whole.film.exr", "complete"), "yes");

    const pid_t child = start({"render", "lit.xml", "--spp", "3000", "--checkpoint", "50e-3", "-o",
                               "a.exr", "--quiet", "-t", "1"},
                              "log");
    for (int i = 0; i < 5000 && !fs::exists(folder_ / "a.film.exr"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was done before it was killed";
    ASSERT_EQ(note("a.film.exr", "complete"), "no");
    EXPECT_FALSE(fs::exists(folder_ / "a.exr"));

    const Outcome rest = nacre(arguments + " -t 3 -o a.exr --resume --json");
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_EQ(rest.err, "");
    EXPECT_TRUE(nlohmann::json::parse(rest.out)["complete"]);
    EXPECT_EQ(pixels("a.film.exr"), pixels("whole.film.exr"));
    EXPECT_EQ(note("a.film.exr", "parts"), "0 3000 0 0 24 16");
}

TEST_F(KeptFilms, GoOnToMoreSamples) {
    ASSERT_EQ(nacre("render lit.xml --spp 7 -o a.exr --film-state --quiet").code, 0);
    ASSERT_EQ(nacre("render lit.xml --spp 30 -o b.exr --resume a.film.exr --quiet").code, 0);
    ASSERT_EQ(nacre("render lit.xml --spp 30 -o whole.exr --quiet").code, 0);
    EXPECT_EQ(pixels("b.exr"), pixels("whole.exr"));
    // It did go on: each sample was drawn once.
    EXPECT_EQ(note("b.exr", "rays"), note("whole.exr", "rays"));
    EXPECT_EQ(note("a.film.exr", "samples"), "7");
    EXPECT_EQ(note("b.film.exr", "samples"), "30");
    // One that is there is named before it is replaced.
    EXPECT_EQ(
        nacre("render lit.xml -o a.exr --checkpoint 1h --quiet").err,
        "nacre: a.film.exr of an earlier render will be replaced; --resume goes on with it\n");
    // And where there is none, a job's first run is like its others.
    EXPECT_EQ(nacre("render lit.xml -o c.exr --checkpoint 1h --resume --quiet").err,
              "nacre: c.film.exr is not there yet: the render begins anew\n");
    EXPECT_TRUE(fs::exists(folder_ / "c.film.exr"));
}

TEST_F(KeptFilms, AreKeptWhenTheRenderIsStopped) {
    const Outcome r = nacre("render lit.xml --spp 1e9 -o a.exr --timeout 0.2s --film-state");
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find("nacre: kept a.film.exr, with which --resume goes on\n"),
              std::string::npos)
        << r.err;
    EXPECT_EQ(note("a.film.exr", "complete"), "no");
    EXPECT_EQ(pixels("a.exr"), [&] {
        const Image film = read_image(folder_ / "a.film.exr");
        std::vector<float> rgb;
        for (int y = 0; y < film.height; ++y)
            for (int x = 0; x < film.width; ++x)
                for (int c = 0; c < 3; ++c) rgb.push_back(film.at(x, y, c));
        return rgb;
    }());
}

TEST_F(KeptFilms, OfOtherPicturesAreRefusedWithWhatDiffers) {
    ASSERT_EQ(nacre("render lit.xml -D spp=8 -o a.exr --film-state --quiet").code, 0);
    const std::string before = read(folder_ / "a.film.exr");
    std::string text = read(folder_ / "lit.xml");
    text.replace(text.find("0.5, 0.5"), 3, "0.6");
    std::ofstream(folder_ / "lamp.xml") << text;
    text.replace(text.find("\"sphere\""), 8, "\"cube\"");
    std::ofstream(folder_ / "cube.xml") << text;
    const std::string cannot = "a.film.exr: cannot be gone on with: ",
                      other = cannot + "it shows another picture; what differs: ";
    const std::pair<const char*, std::string> cases[] = {
        {"lamp.xml", other + "emitter"},
        {"cube.xml", other + "emitter; mesh; shape"},
        {"lit.xml --integrator volpath", other + "integrator type (path there, volpath here)"},
        {"lit.xml --no-guided-exits", other + "guided_exits (true there, false here)"},
        {"lit.xml --mode spectral", other + "mode (rgb there, spectral here)"},
        {"lit.xml --size 20x16",
         other + "film (24x16 pixels of radiance, box filter there, 20x16 pixels of radiance, box "
                 "filter here)"},
        {"lit.xml --seed 3",
         cannot + "its seed is 0, not 3; give --seed 0, or render the other seed by itself and "
                  "merge both"},
        {"lit.xml --crop 1,2,3,4",
         cannot + "its part of the film is 0,0,24,16, not 1,2,3,4; give the same --crop"},
        {"lit.xml --spp 5",
         cannot + "it has 8 samples a pixel already, more than the 5 that are asked for; ask for "
                  "more by --spp"},
    };
    for (const auto& [arguments, message] : cases)
        expect_refused(fmt::format("render {} -o a.exr --checkpoint 1s --resume", arguments),
                       message);
    EXPECT_EQ(read(folder_ / "a.film.exr"), before);
    // Strata are as many as samples.
    text = read(folder_ / "lit.xml");
    text.replace(text.find("independent"), 11, "stratified");
    std::ofstream(folder_ / "strata.xml") << text;
    ASSERT_EQ(nacre("render strata.xml --spp 8 -o s.exr --film-state --quiet").code, 0);
    expect_refused("render strata.xml --spp 16 -o s.exr --resume",
                   "s.film.exr: cannot be gone on with: it shows another picture; what differs: "
                   "samples of the stratified sampler (8 there, 16 here)");
    expect_refused("render strata.xml --noise 1% -o s.exr",
                   "--noise: the sampler 'stratified' has to know how many samples there will be; "
                   "give the most by --spp, or choose 'independent'");
}

TEST_F(KeptFilms, ThatAreNotThereOrDamagedAreRefused) {
    expect_refused("render lit.xml -o a.exr --resume",
                   "a.film.exr: is not there to go on with; --checkpoint or --film-state keep it. "
                   "Leave out --resume to begin anew");
    expect_refused("render lit.xml -o a.film.exr --film-state",
                   "a.film.exr: is what the film's state is called; name the picture otherwise, by "
                   "-o");
    ASSERT_EQ(nacre("render lit.xml -o a.exr --film-state --quiet").code, 0);
    // A lamp of that name would be overwritten.
    std::string text = read(folder_ / "lit.xml");
    text.replace(text.find("<rgb name=\"radiance\" value=\"0.5, 0.5, 0.5\"/>"), 44,
                 "<string name=\"filename\" value=\"a.film.exr\"/>");
    text.replace(text.find("\"constant\""), 10, "\"envmap\"");
    std::ofstream(folder_ / "env.xml") << text;
    expect_refused("render env.xml -o a.exr --film-state",
                   "a.film.exr: is read as well: it would be overwritten; name another output by "
                   "-o");
    expect_refused("render lit.xml -o b.exr --resume a.exr",
                   "a.exr: is not the state of a render: it holds no nacre.film");
    expect_refused("merge a.exr -o b.exr",
                   "a.exr: is a picture; its film's state is a.film.exr: merge that");
    const std::string whole = read(folder_ / "a.film.exr"),
                      half = whole.substr(0, whole.size() / 2);
    std::ofstream(folder_ / "a.film.exr") << half;
    for (const char* arguments :
         {"render lit.xml -o a.exr --checkpoint 1s --resume", "merge a.film.exr -o b.exr"}) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2);
        EXPECT_TRUE(r.err.starts_with("nacre: a.film.exr: is not the state of a render: it "))
            << r.err;
    }
    EXPECT_EQ(read(folder_ / "a.film.exr"), half);
}

/// Files of at most 8 kB: the state, which is larger, cannot be written, the picture can.
TEST_F(KeptFilms, ThatTheDiskDoesNotHoldDoNotEndTheRender) {
    ASSERT_EQ(nacre("render lit.xml -o a.png --film-state --quiet").code, 0);
    const std::string before = read(folder_ / "a.film.exr");
    ASSERT_GT(before.size(), 8192u);
    std::ofstream(folder_ / "a.sh")
        << "trap '' XFSZ\nulimit -f 8\nexec '" << NACRE_BINARY << "' \"$@\"\n";
    program_ = "/bin/bash";
    const Outcome r =
        nacre("a.sh render lit.xml --spp 2000 -o a.png --resume --checkpoint 0.05s --quiet");
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err,
              "nacre: warning: a.film.exr: cannot be written: File too large; the render goes on, "
              "and what was kept before stays\n"
              "nacre: a.film.exr: cannot be written: File too large\n");
    EXPECT_EQ(read(folder_ / "a.film.exr"), before);
    EXPECT_TRUE(fs::exists(folder_ / "a.png"));
    EXPECT_EQ(written(), (std::vector<std::string>{"a.film.exr", "a.png", "a.sh", "lit.xml"}));
}

TEST_F(KeptFilms, OfSeedsAndWindowsAreMergedAndMergedAgain) {
    for (const char* seed : {"1", "2", "3"})
        ASSERT_EQ(nacre(fmt::format("render lit.xml --spp 6 --seed {0} -o s{0}.exr --film-state "
                                    "--quiet",
                                    seed))
                      .code,
                  0);
    EXPECT_EQ(nacre("merge s1.film.exr s2.film.exr -o two.film.exr --quiet").err, "");
    const Outcome r = nacre("merge two.film.exr s3.film.exr -o all.exr");
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(
        r.err.starts_with("nacre: wrote all.exr\nnacre: kept all.film.exr: 3 renders, up "
                          "to 18 samples a pixel\nnacre: noise "))
        << r.err;
    const Image all = read_image(folder_ / "all.exr"), a = read_image(folder_ / "s1.exr"),
                b = read_image(folder_ / "s2.exr"), c = read_image(folder_ / "s3.exr");
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x)
            ASSERT_NEAR(all.at(x, y, 1), (a.at(x, y, 1) + b.at(x, y, 1) + c.at(x, y, 1)) / 3, 1e-6);
    expect_refused("merge all.film.exr s2.film.exr -o b.exr",
                   "all.film.exr and s2.film.exr both have samples of seed 2 in the same pixels, "
                   "which would count twice; render one of them with another --seed");
    expect_refused("render lit.xml --seed 1 --spp 99 -o all.exr --resume",
                   "all.film.exr: cannot be gone on with: it was merged of 3 renders; render "
                   "another --seed and merge that with it");
    expect_refused("merge s1.film.exr s2.film.exr -o s1.exr",
                   "s1.film.exr: is read as well: it would be overwritten; name another output by "
                   "-o");
    // The whole knows its noise, and says what it is.
    EXPECT_NE(nacre("diff all.film.exr s1.exr").out.find("variance known"), std::string::npos);
    const auto info = nlohmann::json::parse(nacre("info all.film.exr --json").out);
    EXPECT_EQ(info["kind"], "film state");
    EXPECT_EQ(info["film"]["complete"], true);
    EXPECT_EQ(info["film"]["samples"], 18);
    EXPECT_EQ(info["film"]["renders"][2],
              nlohmann::json({{"seed", 3}, {"samples", 6}, {"window", {0, 0, 24, 16}}}));
    EXPECT_EQ(info["film"]["of"]["integrator type"], "path");

    // Windows of one seed are the bits of the whole.
    for (const char* crop : {"0,0,24,5", "0,5,10,11", "10,5,14,11"})
        ASSERT_EQ(nacre(fmt::format("render lit.xml --spp 6 --seed 1 --crop {0} -o c{0}.exr "
                                    "--film-state --quiet",
                                    crop))
                      .code,
                  0);
    ASSERT_EQ(nacre("merge c*.film.exr -o tiles.exr --quiet").err, "");
    EXPECT_EQ(pixels("tiles.film.exr"), pixels("s1.film.exr"));
    EXPECT_EQ(nacre("merge c0,0*.film.exr c10*.film.exr -o hole.exr --quiet").err,
              "nacre: warning: 110 pixels have no samples: no state has their part of the film\n");
    ASSERT_EQ(nacre("render lit.xml --spp 6 --integrator volpath -o v.exr --film-state").code, 0);
    expect_refused("merge s1.film.exr v.film.exr -o b.exr",
                   "s1.film.exr and v.film.exr show different pictures; what differs: integrator "
                   "type (path there, volpath here)");
}

TEST_F(KeptFilms, EndAtANoise) {
    const Outcome r = nacre("render lit.xml --noise 1% -o a.exr --json --film-state");
    EXPECT_EQ(r.code, 0);
    const auto json = nlohmann::json::parse(r.out);
    const double noise = json["noise"];
    EXPECT_LE(noise, 0.01);
    EXPECT_GT(noise, 0.008);  // not far beyond
    EXPECT_EQ(json["complete"], true);
    EXPECT_EQ(json["samples"], json["fewest_samples"]);
    EXPECT_EQ(json["samples"], json["most_samples"]);
    EXPECT_EQ(note("a.exr", "noise"), fmt::format("{:.6g}", noise));
    EXPECT_NE(r.err.find(fmt::format("nacre: noise {:.3g} % with {} samples a pixel\n", 100 * noise,
                                     json["samples"].get<int>())),
              std::string::npos)
        << r.err;
    // More of it, from there, is what it would have been.
    ASSERT_EQ(nacre("render lit.xml --noise 0.7% -o a.exr --resume --quiet").code, 0);
    ASSERT_EQ(nacre("render lit.xml --noise 0.7% -o whole.exr --quiet").code, 0);
    EXPECT_EQ(pixels("a.exr"), pixels("whole.exr"));
    const Outcome few = nacre("render lit.xml --noise 0.1% --spp 40 -o b.exr --quiet");
    EXPECT_EQ(few.code, 0);
    EXPECT_TRUE(few.err.ends_with(" %, more than the 0.1 % asked for, with 40 samples a pixel\n"))
        << few.err;
}

}  // namespace
}  // namespace nacre
