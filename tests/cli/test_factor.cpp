// nacre factor.
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

class FactorVerb : public test::CommandLine {};

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;

}  // namespace

TEST_F(FactorVerb, ATableOfErrors) {
    const Outcome r = nacre("factor 'phong n=10' -R 8 -J 1,2,4");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(
        r.out.starts_with("phong n=10: 64 x 64 pairs of directions (in_out), 1 band, "
                          "singular value decomposition\n"))
        << r.out;
    for (const char* line : {"\n     1 ", "\n     2 ", "\n     4 "})
        EXPECT_NE(r.out.find(line), r.out.npos) << r.out;
    // What textures cannot hold is said.
    EXPECT_NE(nacre("factor he_torrance -R 4 -J 1").out.find("mirrors without blur"),
              std::string::npos);
    EXPECT_NE(nacre("factor lambert -R 4 -J 1 --param half").out.find("below the horizon"),
              std::string::npos);
}

TEST_F(FactorVerb, Json) {
    const Outcome r =
        nacre("factor lambert 'phong n=10' -R 8 -J 1..3 --json --param half --weighted");
    ASSERT_EQ(r.code, 0) << r.err;
    const json all = json::parse(r.out);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1]["name"], "phong n=10");
    EXPECT_EQ(all[1]["parameters"], "half_difference");
    EXPECT_EQ(all[1]["method"], "least squares, weighted");
    EXPECT_GT(all[1]["below_horizon"].get<int>(), 100);
    ASSERT_EQ(all[1]["errors"].size(), 3u);
    for (int i : {1, 2})
        EXPECT_LE(all[1]["errors"][i]["matrix"].get<double>(),
                  all[1]["errors"][i - 1]["matrix"].get<double>());
    EXPECT_LT(all[0]["errors"][0]["rendered"].get<double>(), 1e-5);
    const json plain = json::parse(nacre("factor 'phong n=10' -R 8 -J 2 --json").out);
    ASSERT_EQ(plain[0]["singular_values"].size(), 1u);
    EXPECT_EQ(plain[0]["singular_values"][0].size(), 2u);
}

TEST_F(FactorVerb, Files) {
    const Outcome r =
        nacre("factor 'ward kd=0.3,0.2,0.1' -R 8 -J 1,2,4 --nonnegative -o out --spheres 1,4");
    ASSERT_EQ(r.code, 0) << r.err;
    for (const char* file : {"g01.exr", "h04.exr", "errors.svg", "errors.svg.csv", "spheres.png"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
    const Image spheres = read_image(folder_ / "out/spheres.png");
    EXPECT_EQ(spheres.width, 2 * 240);
    EXPECT_EQ(spheres.height, 2 * 240);
    EXPECT_TRUE(read(folder_ / "out/errors.svg.csv")
                    .starts_with("J,matrix,largest,weighted,rendered,rendered_log\n1,"));
    // The folder is a BRDF again: what was factored of it with as many terms is what it is.
    const json again = json::parse(nacre("factor out -R 8 -J 4 --json").out);
    EXPECT_LT(again[0]["errors"][0]["matrix"].get<double>(), 1e-5);
    // What is read is not overwritten.
    const std::string before = read(folder_ / "out/g02.exr");
    EXPECT_EQ(
        nacre("factor out -R 8 -J 1 -o ./out").err,
        "nacre: ./out: is read as well: it would be overwritten; name another output by -o\n");
    EXPECT_EQ(read(folder_ / "out/g02.exr"), before);
    const Outcome two = nacre("factor lambert lambert -R 4 -J 1,2 -o both --spheres 2");
    ASSERT_EQ(two.code, 0) << two.err;
    EXPECT_TRUE(fs::exists(folder_ / "both/lambert/g02.exr"));
    EXPECT_TRUE(fs::exists(folder_ / "both/lambert-2/errors.svg"));
    EXPECT_EQ(read_image(folder_ / "both/spheres.png").width, 2 * 240 + 30);
}

TEST_F(FactorVerb, WrongWords) {
    const std::pair<const char*, const char*> cases[] = {
        {"factor lambert -J x", "-J 'x' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8"},
        {"factor lambert -J 4..2",
         "-J '4..2' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8"},
        {"factor lambert -J 0", "-J '0' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8"},
        {"factor lambert -J 1..",
         "-J '1..' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8"},
        {"factor lambert -J ,", "-J ',' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8"},
        {"factor lambert -R 2 -J 5", "a matrix of 4 x 4 has at most 4 terms, not 5"},
        {"factor lambert --param polar",
         "--param: unknown parameterisation 'polar'; known are: io, half"},
        {"factor lambert --nonnegative --normalised", "give either --nonnegative or --normalised"},
        {"factor lambert --nonnegative --log",
         "logarithms are negative where f is small: they have no non-negative factors"},
        {"factor lambert --normalised", "the normalised decomposition has one term: J = 1"},
        {"factor lambert --spheres 1", "--spheres needs -o"},
        {"factor lambert -J 2 --spheres 1 -o out", "--spheres 1: it is not among -J 2"},
        {"factor lambart", "unknown reflectance model 'lambart'; did you mean 'lambert'?"},
        {"factor ward alpha=0.3",
         "'alpha=0.3' stands alone: write a model and its settings between quotes, 'ward "
         "alpha=0.2'"},
        {"factor -R 8", "brdf is required; see 'nacre help factor'"},
    };
    for (const auto& [line, message] : cases) {
        const Outcome r = nacre(line);
        EXPECT_EQ(r.code, 2) << line;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << line;
    }
    fs::create_directories(folder_ / "empty");
    EXPECT_EQ(nacre("factor empty").err,
              "nacre: empty: is no folder of factors: it has no g01.exr; nacre factor -o writes "
              "one\n");
}

}  // namespace nacre
