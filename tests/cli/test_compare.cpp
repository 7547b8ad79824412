// nacre compare, as a user runs it.
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"
#include "tests/compare/experiment_fixture.h"

namespace nacre::test {
namespace {

/// Quick: small pictures, few samples, everything kept in the test's folder.
const std::string quickly =
    " --spp 2 --repeats 2 --reference-error 0.3 --keep kept -o report --quiet";

class CompareVerb : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        std::ofstream(folder_ / "ball.xml") << ball_scene(40);
        std::string flat = ball_scene(40);
        flat.replace(flat.find("type=\"sphere\""), 13, "type=\"rectangle\"");
        std::ofstream(folder_ / "flat.xml") << flat;
    }
    nlohmann::json report() const {
        return nlohmann::json::parse(read(folder_ / "report/report.json"));
    }
};

}  // namespace

TEST_F(CompareVerb, WritesOnePageNumbersAndPictures) {
    const Outcome r =
        nacre("compare ball.xml --techniques volpath,brdf,two_pass:error=1" + quickly);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, fs::canonical(folder_ / "report/index.html").string() + "\n");
    for (const char* file :
         {"reference.exr", "report.json", "pictures/brdf_profile=dipole_2_spp.exr",
          "pictures/two_pass_error=1_2_spp.exr"})
        EXPECT_TRUE(fs::exists(folder_ / "report" / file)) << file;
    const nlohmann::json d = report();
    EXPECT_EQ(d["kind"], "techniques");
    EXPECT_FALSE(d.contains("pictures"));
    ASSERT_EQ(d["rows"].size(), 3u);
    for (const auto& row : d["rows"]) {
        EXPECT_EQ(row["status"], "ok");
        for (const char* key : {"systematic", "bias", "rms", "noise", "flip", "frame", "memory"})
            EXPECT_TRUE(row["values"].contains(key)) << key;
    }
    // What the row says makes the frame that was measured, to the bit.
    std::string command = d["rows"][2]["command"];
    EXPECT_EQ(command.substr(0, command.find(" --seed")),
              "nacre render ball.xml --technique two_pass --set error=1 --spp 2");
    command.erase(0, std::string("nacre ").size());
    ASSERT_EQ(nacre(command + " --quiet").code, 0);
    const Image again = read_image(folder_ / "picture.exr"),
                kept = read_image(folder_ / "report/pictures/two_pass_error=1_2_spp.exr");
    for (int y = 0; y < again.height; ++y)
        for (int x = 0; x < again.width; ++x)
            for (const char* c : {"R", "G", "B"})
                ASSERT_EQ(again.at(x, y, again.channel(c)),
                          kept.at(x, y, kept.channel(std::string("frame.") + c)));
    for (const auto& fact : d["facts"]) EXPECT_TRUE(fact.is_array() && fact.size() == 2) << fact;

    // The page holds its document, and nothing that must be fetched.
    const std::string page = read(folder_ / "report/index.html");
    EXPECT_EQ(page.find("src=\"http"), page.npos);
    EXPECT_EQ(page.find("/*DOCUMENT*/"), page.npos);
    const std::string opening = "id=\"document\">";
    const std::size_t at = page.find(opening) + opening.size();
    ASSERT_GT(at, opening.size());
    const nlohmann::json whole =
        nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
    EXPECT_EQ(whole["pictures"].size(), 4u);
    EXPECT_EQ(whole["rows"], d["rows"]);
}

TEST_F(CompareVerb, ATechniqueThatFailsSaysWhyInItsRowAndInTheExitCode) {
    const Outcome r = nacre("compare flat.xml --techniques brdf,volpath" + quickly);
    EXPECT_EQ(r.code, 1) << r.err;
    const nlohmann::json d = report();
    EXPECT_EQ(d["rows"][0]["status"], "failed");
    EXPECT_EQ(d["rows"][0]["why"],
              "'ball' is flat: it has no inside for light to be scattered in; give it a thickness");
    EXPECT_EQ(d["rows"][1]["status"], "ok");
}

TEST_F(CompareVerb, WhatWasMeasuredIsKept) {
    const std::string command =
        "compare ball.xml --techniques brdf --spp 2 --repeats 2 "
        "--reference-error 0.3 --keep kept -o report";
    ASSERT_EQ(nacre(command).code, 0);
    const nlohmann::json first = report();
    const Outcome again = nacre(command);
    EXPECT_NE(again.err.find("kept from before"), std::string::npos) << again.err;
    EXPECT_EQ(report()["rows"][0]["values"], first["rows"][0]["values"]);
}

/// A reference that was cut short, or holds something else, is made anew with a word, once.
TEST_F(CompareVerb, ADamagedReferenceIsSetAside) {
    const std::string command = "compare ball.xml --techniques brdf" + quickly;
    ASSERT_EQ(nacre(command).code, 0);
    const fs::path file = fs::directory_iterator(folder_ / "kept")->path();
    const std::string whole = read(file);
    const auto damaged = [&](const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        const Outcome r = nacre(command);
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.err.find("nacre: warning: the kept reference is damaged ("), 0u) << r.err;
        EXPECT_TRUE(
            r.err.ends_with("kept/" + file.filename().string() + ".damaged and made anew\n"))
            << r.err;
        EXPECT_EQ(read(file.string() + ".damaged"), bytes);
        EXPECT_EQ(nacre(command).err, "");
    };
    damaged(whole.substr(0, whole.size() / 2));
    damaged("garbage");
    damaged("");
    std::string other = whole;  // a count that is none
    const std::size_t at = other.find("nacre.rounds");
    ASSERT_NE(at, std::string::npos);
    other[other.find('1', at)] = 'x';
    damaged(other);
}

/// Interrupted once a technique is being rendered: the report has what is finished, and the same
/// command goes on with the rest.
TEST_F(CompareVerb, CtrlCKeepsWhatIsFinished) {
    std::ofstream(folder_ / "empty");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        if (chdir(folder_.c_str()) != 0 || !freopen("stderr", "w", stderr) ||
            !freopen("empty", "w", stdout))
            _exit(99);
        execl(NACRE_BINARY, NACRE_BINARY, "compare", "ball.xml", "--techniques",
              "brdf,surface:profile=dipole", "--spp", "4000", "--repeats", "2", "--reference-error",
              "0.3", "--keep", "kept", "-o", "report", static_cast<char*>(nullptr));
        _exit(98);
    }
    for (int i = 0; i < 2400 && read(folder_ / "stderr").find("[3/3]") == std::string::npos; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_EQ(kill(child, SIGINT), 0);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130) << read(folder_ / "stderr");
    EXPECT_NE(read(folder_ / "stderr").find("the same command goes on"), std::string::npos);
    const nlohmann::json d = report();
    EXPECT_EQ(d["rows"][0]["status"], "ok");
    EXPECT_EQ(d["rows"][1]["status"], "missing");
    EXPECT_TRUE(fs::exists(folder_ / "report/pictures/brdf_profile=dipole_4000_spp.exr"));
}

TEST_F(CompareVerb, ModelsAreFittedToATarget) {
    const Outcome r = nacre(
        "compare --models 'lambert, ward variant=duer,lambert reflectance=0.5,0.4,0.3' "
        "--fit-to 'ward kd=0.3 ks=0.2 alpha=0.3' -o report --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const nlohmann::json d = report();
    EXPECT_EQ(d["kind"], "models");
    ASSERT_EQ(d["rows"].size(), 3u);
    EXPECT_EQ(d["rows"][1]["id"], "ward variant=duer");
    EXPECT_EQ(d["rows"][2]["id"], "lambert reflectance=0.5,0.4,0.3");
    for (const auto& row : d["rows"]) EXPECT_EQ(row["status"], "ok");
    EXPECT_LT(d["rows"][1]["values"]["error"], d["rows"][0]["values"]["error"]);
    EXPECT_TRUE(fs::exists(folder_ / "report/pictures/ward_variant=duer.exr"));
}

TEST_F(CompareVerb, TheSuiteIsAMatrix) {
    const Outcome r = nacre(
        "compare --suite translucency --cases ball,low,veined,front,side --techniques brdf "
        "--size 64x64 --spp 1 --reference-error 0.5 --keep kept -o report --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const nlohmann::json d = report();
    EXPECT_EQ(d["kind"], "suite");
    ASSERT_EQ(d["matrix"]["cases"].size(), 2u);
    EXPECT_EQ(d["matrix"]["cases"][1]["id"], "ball low veined side");
    EXPECT_TRUE(d["matrix"]["cases"][0]["cells"]["brdf profile=dipole"].contains("systematic"));
    EXPECT_TRUE(fs::exists(folder_ / "report/pictures/ball_low_veined_side/reference.exr"));
}

/// Before anything is rendered.
TEST_F(CompareVerb, AFolderThatCannotBeIsNamedAtOnce) {
    for (const char* what :
         {"compare ball.xml -o ball.xml", "compare ball.xml --keep ball.xml -o r",
          "compare --models lambert --fit-to ggx -o ball.xml",
          "compare --suite translucency -o ball.xml --keep kept"}) {
        const Outcome r = nacre(what);
        EXPECT_EQ(r.code, 2) << what;
        EXPECT_NE(r.err.find("cannot be made: Not a directory; name another folder"),
                  std::string::npos)
            << what << ": " << r.err;
        EXPECT_EQ(r.err.find('%'), std::string::npos) << r.err;
    }
}

TEST_F(CompareVerb, MistakesOnTheCommandLineWriteNothing) {
    const struct {
        const char *arguments, *message;
    } cases[] = {
        {"compare none.xml", "none.xml: cannot be opened"},
        {"compare ball.xml --reference-error 0",
         "--reference-error: '0' is not a share from 0.0001% to 100%; "
         "write 0.5% or 0.005"},
        {"compare ball.xml --spp many",
         "--spp: 'many' is not a number of samples from 1 to 1073741824; write 16, or several as "
         "4,16"},
        {"compare ball.xml --repeats 1", "--repeats: '1' is not a whole number from 2 to 10000"},
        {"compare ball.xml --cases ball", "--cases belongs to --suite, which is missing"},
        {"compare --suite opacity", "--suite: unknown suite 'opacity'; known are: translucency"},
        {"compare --suite translucency --cases cube",
         "the suite has no 'cube'; its words are: ball, sheet, bowl, bust, slab, high, low, "
         "homogeneous, veined, front, side, back"},
        {"compare --suite translucency --spp 4,8",
         "--suite takes one number of samples; give one to --spp"},
        {"compare ball.xml --suite translucency", "--suite brings its own scenes: leave out scene"},
        {"compare ball.xml --peer blendr", "unknown peer 'blendr'"},
        {"compare --models ward", "--models needs --fit-to"},
        {"compare --fit-to ggx", "--fit-to belongs to --models, which is missing"},
        {"compare --models ward --fit-to ggx --spp 4", "--spp has no meaning for --models"},
        {"compare --models wardd --fit-to ggx", "ward"},
        {"compare --models ward,ward --fit-to ggx", "the model 'ward' is given twice"},
        {"compare ball.xml --material marble",
         "ball.xml: --material is for bare meshes; a scene says itself what its shapes are"},
    };
    for (const auto& c : cases) {
        const Outcome r = nacre(std::string(c.arguments) + " --keep kept -o report");
        EXPECT_EQ(r.code, 2) << c.arguments;
        EXPECT_NE(r.err.find(c.message), std::string::npos) << c.arguments << ": " << r.err;
        EXPECT_FALSE(fs::exists(folder_ / "report")) << c.arguments;
        EXPECT_FALSE(fs::exists(folder_ / "kept")) << c.arguments;
    }
}

}  // namespace nacre::test
