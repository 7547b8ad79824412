// nacre diff as its users meet it.
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using nlohmann::json;
using test::CommandLine;
using test::Outcome;

Image grey(int width, int height, float value) {
    Image r(width, height);
    for (float& v : r.data) v = value;
    return r;
}

/// Pictures in files a.exr and b.exr.
class Diff : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        write_image(grey(32, 16, 0.5f), folder_ / "a.exr");
        write_image(grey(32, 16, 0.25f), folder_ / "b.exr");
        write_image(grey(16, 16, 0.25f), folder_ / "small.exr");
        write_image(grey(32, 16, 0.f), folder_ / "black.exr");
    }
};

}  // namespace

TEST_F(Diff, WrongCommandLinesAreAnsweredExactlyAndWriteNothing) {
    const auto files = written();
    const std::pair<const char*, const char*> cases[] = {
        {"diff a.exr", "reference is required; see 'nacre help diff'"},
        {"diff a.exr missing.exr", "missing.exr: no such file"},
        {"diff missing.exr a.exr", "missing.exr: no such file"},
        {"diff a.exr small.exr --error-map e.exr",
         "small.exr: has 16 x 16 pixels, but a.exr has 32 x 16; compare pictures of one size"},
        {"diff a.exr b.exr --mask small.exr",
         "small.exr: has 16 x 16 pixels, but a.exr has 32 x 16; compare pictures of one size"},
        {"diff a.exr b.exr --mask black.exr",
         "the mask leaves no pixel; its green must be above 0.5 where a pixel counts"},
        {"diff a.exr b.exr --mask no.exr", "no.exr: no such file"},
        {"diff a.exr b.exr --ppd 0", "--ppd: '0' is not a number from 1 to 10000"},
        {"diff a.exr b.exr --error-map no/e.png",
         "no/e.png: the folder no does not exist; make it first"},
        {"diff a.exr b.exr --error-mop e.png",
         "unknown option '--error-mop'; did you mean '--error-map'?"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
        EXPECT_EQ(r.out, "") << arguments;
        EXPECT_EQ(written(), files) << arguments;
    }
}

TEST_F(Diff, EqualPicturesDifferByNothing) {
    const Outcome r = nacre("diff a.exr a.exr --json");
    EXPECT_EQ(r.code, 0) << r.err;
    const json j = json::parse(r.out);
    for (const char* name : {"bias", "mse", "rel_mse", "mape", "smape"})
        EXPECT_EQ(j[name]["value"], 0.) << name;
    EXPECT_EQ(j["flip"]["mean"], 0.);
    EXPECT_EQ(j["flip_hdr"]["mean"], 0.);
    EXPECT_EQ(j["picture"]["variance"], false);
    EXPECT_FALSE(j["mse"].contains("noise"));
}

TEST_F(Diff, NumbersOfEvenPictures) {
    const Outcome r = nacre("diff a.exr b.exr --json --error-map e.exr");
    EXPECT_EQ(r.code, 0) << r.err;
    const json j = json::parse(r.out);
    EXPECT_EQ(j["pixels"], 512);
    EXPECT_EQ(j["reference"]["mean"], (std::vector<double>{0.25, 0.25, 0.25}));
    EXPECT_NEAR(double(j["bias"]["value"]), 0.25, 1e-15);
    EXPECT_NEAR(double(j["bias"]["channels"][2]["value"]), 0.25, 1e-15);
    EXPECT_NEAR(double(j["mse"]["value"]), 0.0625, 1e-15);
    EXPECT_NEAR(double(j["rel_mse"]["value"]), 0.0625 / 0.0725, 1e-12);
    EXPECT_NEAR(double(j["rel_mse"]["trimmed"]), 0.0625 / 0.0725, 1e-12);
    EXPECT_NEAR(double(j["mape"]["value"]), 0.25 / 0.26, 1e-12);
    EXPECT_NEAR(double(j["smape"]["value"]), 0.25 / 0.76, 1e-12);
    EXPECT_EQ(j["blocks"]["count"], 2 * 3);
    EXPECT_NEAR(double(j["blocks"]["rms"]), 1., 1e-12);
    EXPECT_NEAR(double(j["percentiles"][0]["value"]), std::sqrt(0.0625 / 0.0725), 1e-12);

    const Image map = read_image(folder_ / "e.exr");
    EXPECT_NEAR(map.rgb(5, 5).y, 0.25f / 0.26f, 1e-6f);
    EXPECT_NEAR(map.at(5, 5, map.channel("squared.G")), 0.0625f / 0.0725f, 1e-6f);
    EXPECT_NEAR(map.at(5, 5, map.channel("flip")), double(j["flip"]["mean"]), 1e-5);
    EXPECT_NEAR(map.at(5, 5, map.channel("flip_hdr")), double(j["flip_hdr"]["mean"]), 1e-5);

    EXPECT_EQ(nacre("diff a.exr b.exr --error-map e.png").code, 0);
    const Image png = read_image(folder_ / "e.png", {.raw = true});
    EXPECT_NEAR(png.rgb(5, 5).x, double(j["flip"]["mean"]), 1. / 255.);
}

TEST_F(Diff, TheMaskDecidesWhatCounts) {
    Image half = grey(32, 16, 0.f), spoiled = grey(32, 16, 0.25f);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) half.at(x, y, 1) = 1.f;
    spoiled.at(20, 3, 0) = 9.f;
    write_image(half, folder_ / "half.exr");
    write_image(spoiled, folder_ / "spoiled.exr");
    const json j = json::parse(nacre("diff spoiled.exr b.exr --mask half.exr --json").out);
    EXPECT_EQ(j["pixels"], 256);
    EXPECT_EQ(j["mse"]["value"], 0.);
}

TEST_F(Diff, TwoRendersOfOneSceneDifferByNoiseAlone) {
    // Lit by a ball from above: in even light the sphere would have no noise.
    std::string scene = test::quick_scene;
    const auto replace = [&](const std::string& from, const std::string& to) {
        scene.replace(scene.find(from), from.size(), to);
    };
    replace(R"(<integrator type="path"/>)",
            R"(<integrator type="moment"><integrator type="path"/></integrator>)");
    replace(R"(<emitter type="constant"><rgb name="radiance" value="0.5, 0.5, 0.5"/></emitter>)",
            R"(<shape type="sphere">
                   <transform name="to_world"><translate value="0, 3, 1"/></transform>
                   <emitter type="area"><rgb name="radiance" value="3, 2, 1"/></emitter>
               </shape>)");
    std::ofstream(folder_ / "moment.xml") << scene;
    for (const char* how : {"p.exr --seed 1", "t.exr --seed 2"}) {
        const Outcome r = nacre(fmt::format("render moment.xml --spp 64 --quiet -o {}", how));
        ASSERT_EQ(r.code, 0) << r.err;
    }
    const json j = json::parse(nacre("diff p.exr t.exr --json").out);
    EXPECT_EQ(j["picture"]["variance"], true);
    EXPECT_EQ(j["reference"]["variance"], true);
    const double mse = j["mse"]["value"], error = j["mse"]["standard_error"];
    EXPECT_GT(mse, 0.);
    // 5 sigma, and noise explains what there is to explain.
    EXPECT_NEAR(double(j["mse"]["corrected"]), 0., 5. * error);
    EXPECT_LT(error, 0.5 * mse);
    EXPECT_NEAR(double(j["bias"]["value"]), 0., 5. * double(j["bias"]["standard_error"]));
    EXPECT_NE(nacre("diff p.exr t.exr").out.find("without noise"), std::string::npos);
}

TEST_F(Diff, PlainOutputNamesEveryMetric) {
    const Outcome r = nacre("diff a.exr b.exr");
    EXPECT_EQ(r.code, 0) << r.err;
    for (const char* name : {"bias", "MSE", "relMSE", "MAPE", "SMAPE", "16 x 16 blocks", "99 %",
                             "FLIP, 67.02 pixels a degree", "HDR-FLIP, exposures: 1 from"})
        EXPECT_NE(r.out.find(name), std::string::npos) << name << "\n" << r.out;
    EXPECT_EQ(r.out.find("without noise"), std::string::npos);
}

}  // namespace nacre
