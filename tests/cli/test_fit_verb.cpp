// nacre fit.
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.h"

namespace nacre {
namespace {

class FitVerb : public test::CommandLine {
  protected:
    /// The scene with this material in place of its own.
    void write_scene(const std::string& file, const std::string& bsdf) const {
        std::string scene = test::quick_scene;
        const std::string old =
            "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1, 1, 1\"/></bsdf>";
        scene.replace(scene.find(old), old.size(), bsdf);
        std::ofstream(folder_ / file) << scene;
    }
};
class LongFitVerb : public FitVerb {};

}  // namespace

TEST_F(FitVerb, ATableTheBestFirst) {
    const test::Outcome r =
        nacre("fit 'ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.15' --model lambert,'ward variant=gmd'");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(r.out.starts_with("ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.15: fitted to ")) << r.out;
    EXPECT_NE(r.out.find("    variant=gmd kd=0.3,0.2,0.1 ks=0.2 alpha=0.15\n"), r.out.npos)
        << r.out;
    EXPECT_LT(r.out.find("\nward variant=gmd "), r.out.find("\nlambert ")) << r.out;
}

TEST_F(FitVerb, Json) {
    const test::Outcome r = nacre(
        "fit 'ward kd=0.3 ks=0.2 alpha=0.15' --model phong,ward --metric cuberoot --lobes 2 "
        "--shape channel --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto all = nlohmann::json::parse(r.out);
    EXPECT_EQ(all["metric"], "cuberoot");
    EXPECT_EQ(all["shape"], "channel");
    EXPECT_GT(all["pairs"]["held_out"].get<int>(), 2000);
    const auto& ward = all["models"][0];
    EXPECT_EQ(ward["model"], "ward");
    EXPECT_EQ(ward["terms"].size(), 6u);
    EXPECT_EQ(ward["terms"][5]["weight"], (std::vector<double>{0., 0., 1.}));
    EXPECT_EQ(ward["terms"][1]["parameters"]["kd"], 0.);
    EXPECT_LT(ward["errors"]["fit"]["cuberoot"].get<double>(), 1e-4);
    EXPECT_LT(ward["errors"]["held_out"]["cuberoot"].get<double>(), 1e-4);
    const auto none = nlohmann::json::parse(
        nacre("fit 'ward kd=0.3' --model lambert --held-out none --json").out);
    EXPECT_FALSE(none["models"][0]["errors"].contains("held_out"));
    EXPECT_GT(none["pairs"]["fit"].get<int>(), 5000);
}

// What is written renders, and like the BRDF that it was fitted to.
TEST_F(FitVerb, Files) {
    const char* target = "ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.3";
    const test::Outcome one =
        nacre(fmt::format("fit '{}' --model 'ward variant=gmd',lambert -o out", target));
    ASSERT_EQ(one.code, 0) << one.err;
    for (const char* file : {"fit.json", "lambert.xml", "lobes-15.svg", "lobes-70.svg.csv"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
    EXPECT_EQ(read(folder_ / "out/ward_variant_gmd.xml"),
              fmt::format("<!-- ward variant=gmd fitted to {} -->\n"
                          "<bsdf type=\"ward\">\n"
                          "    <string name=\"variant\" value=\"gmd\"/>\n"
                          "    <rgb name=\"kd\" value=\"0.3,0.2,0.1\"/>\n"
                          "    <float name=\"ks\" value=\"0.2\"/>\n"
                          "    <float name=\"alpha\" value=\"0.3\"/>\n"
                          "</bsdf>\n",
                          target));
    EXPECT_TRUE(read(folder_ / "out/lobes-45.svg.csv")
                    .starts_with("theta_o_deg,target,ward,lambert\n-89,"));
    ASSERT_EQ(
        nacre(fmt::format("fit '{}' --model ward --shape channel --lobes 2 -o two --quiet", target))
            .code,
        0);
    const std::string sum = read(folder_ / "two/ward.xml");
    EXPECT_NE(sum.find("<bsdf type=\"sumbsdf\">\n    <rgb name=\"weight1\" value=\"1 0 0\"/>"),
              sum.npos)
        << sum;
    write_scene("one.xml", read(folder_ / "out/ward_variant_gmd.xml"));
    write_scene("two.xml", sum);
    for (const char* name : {"one", "two"}) {
        const test::Outcome r = nacre(fmt::format("render {0}.xml -o {0}.exr --spp 256", name));
        ASSERT_EQ(r.code, 0) << r.err;
    }
    const auto diff = nlohmann::json::parse(nacre("diff one.exr two.exr --json").out);
    EXPECT_LT(diff["rel_mse"]["value"].get<double>(), 1e-3) << diff;
}

TEST_F(LongFitVerb, AllModels) {
    const test::Outcome r = nacre("fit 'lambert reflectance=0.4' --lobes 2 --json --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto all = nlohmann::json::parse(r.out);
    EXPECT_GE(all["models"].size(), 16u);
    for (const auto& m : all["models"]) {
        if (m.contains("why"))
            EXPECT_NE(m["why"].get<std::string>().find("it has one lobe"), std::string::npos);
        else
            EXPECT_EQ(m["terms"].size(), 2u) << m["model"];
    }
    const auto one =
        nlohmann::json::parse(nacre("fit 'lambert reflectance=0.4' --json --quiet").out);
    for (const auto& m : one["models"]) {
        ASSERT_TRUE(m.contains("errors")) << m;
        EXPECT_LT(m["errors"]["held_out"]["log"].get<double>(), 0.5) << m["model"];
    }
}

TEST_F(FitVerb, WrongWords) {
    const std::pair<const char*, const char*> cases[] = {
        {"fit", "brdf is required; see 'nacre help fit'"},
        {"fit felt.binary --model ward", "felt.binary: cannot be read; check the name"},
        {"fit lambert --model wrad", "unknown reflectance model 'wrad'; did you mean 'ward'?"},
        {"fit lambert --model ,", "--model: no model is named; see 'nacre models'"},
        {"fit lambert --model ward,ward", "the model 'ward' is given twice"},
        {"fit lambert --model 'ward beta=1'",
         "ward: unknown parameter 'beta'; known are: variant, kd, ks, alpha_u, alpha_v"},
        {"fit lambert --model 'ward alpha=20'",
         "ward: alpha_u = 20 is out of range: must lie within (0, 10]"},
        {"fit lambert --metric rms",
         "--metric: unknown metric 'rms'; known are: cosine, log, cuberoot"},
        {"fit lambert --shape own", "--shape: unknown word 'own'; known are: shared, channel"},
        {"fit lambert --held-out all", "--held-out: unknown word 'all'; known are: half, none"},
        {"fit lambert --lobes 4", "--lobes: '4' is not a whole number from 1 to 3"},
        {"fit lambert --lobes 0", "--lobes: '0' is not a whole number from 1 to 3"},
        {"fit lambert --model lambert --lobes 2",
         "lambert has no diffuse albedo kd apart from its highlight: it has one lobe"},
        {"fit ward --model 'ward ks=0.1 alpha=0.1' --lobes 2",
         "ward: nothing is left to fit in a further lobe; ask for one lobe"},
        {"fit 'lambert reflectance=0' --model ward",
         "lambert reflectance=0: is black; nothing can be fitted to it"},
        {"fit ward alpha=0.3", "unexpected argument 'alpha=0.3'; see 'nacre help'"},
        {"fit ward -o quick.xml/x --model lambert",
         "quick.xml/x: cannot be made: Not a directory; name another folder"},
    };
    for (const auto& [line, message] : cases) {
        const test::Outcome r = nacre(line);
        EXPECT_EQ(r.code, 2) << line;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << line;
        EXPECT_EQ(r.out, "") << line;
    }
}

}  // namespace nacre
