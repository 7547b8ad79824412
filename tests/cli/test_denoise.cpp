// --denoise and --aovs, as users type them.
#include <nlohmann/json.hpp>

#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre::test {
namespace {

using nlohmann::json;
/// A sphere under a lamp: a picture with noise.
class Denoised : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        std::string scene = quick_scene;
        const std::string sky = "<emitter type=\"constant\">";
        scene.insert(scene.find(sky), R"(<shape type="rectangle"><transform name="to_world">
            <scale value="2"/><lookat origin="0, 6, 3" target="0, 0, 0" up="0, 0, 1"/>
            </transform><emitter type="area"><rgb name="radiance" value="5, 5, 5"/></emitter>
            </shape>)");
        std::ofstream(folder_ / "quick.xml") << scene;
    }
};
using LongDenoised = Denoised;

std::vector<float> plane(const Image& image, const std::string& channel) {
    const int c = image.channel(channel);
    std::vector<float> values;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) values.push_back(image.at(x, y, c));
    return values;
}

TEST_F(Denoised, KeepsThePictureAsItWasAndChangesNoBitOfIt) {
    const Outcome r = nacre("render quick.xml --spp 16 --denoise --variance --json -o d.exr");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.err.find("nacre: wrote d.exr (denoised, 24 x 16, "), std::string::npos) << r.err;
    EXPECT_EQ(json::parse(r.out)["denoised"], true);
    ASSERT_EQ(nacre("render quick.xml --spp 16 --variance --quiet -o p.exr").code, 0);
    const Image clean = read_image(folder_ / "d.exr"), plain = read_image(folder_ / "p.exr");
    EXPECT_EQ(clean.metadata.at("nacre.denoised"), "nfor");
    EXPECT_FALSE(plain.metadata.contains("nacre.denoised"));
    for (const std::string c : {"R", "G", "B"}) {
        EXPECT_EQ(plane(clean, "noisy." + c), plane(plain, c));
        EXPECT_EQ(plane(clean, "variance.noisy." + c), plane(plain, "variance." + c));
        EXPECT_NE(plane(clean, c), plane(plain, c));
        // The noise of the samples is not that of the clean picture.
        EXPECT_EQ(clean.channel("variance." + c), -1);
    }
    EXPECT_EQ(read_image(folder_ / "d.exr#noisy").data, plain.data);
}

TEST_F(Denoised, APngIsTheCleanPicture) {
    ASSERT_EQ(nacre("render quick.xml --spp 16 --denoise --quiet -o d.exr").code, 0);
    ASSERT_EQ(nacre("image d.exr -o expected.png").code, 0);
    ASSERT_EQ(nacre("render quick.xml --spp 16 --denoise --quiet -o d.png").code, 0);
    EXPECT_EQ(read(folder_ / "d.png"), read(folder_ / "expected.png"));
}

TEST_F(Denoised, SameBitsForAnyNumberOfThreads) {
    ASSERT_EQ(nacre("render quick.xml --spp 8 --denoise --aovs --quiet -t 1 -o a.exr").code, 0);
    ASSERT_EQ(nacre("render quick.xml --spp 8 --denoise --aovs --quiet -t 3 -o b.exr").code, 0);
    ImageReadOptions any;
    any.any_channels = true;
    EXPECT_EQ(read_image(folder_ / "a.exr", any).data, read_image(folder_ / "b.exr", any).data);
}

TEST_F(Denoised, AovsAreLayersBesideAnUnchangedPicture) {
    ASSERT_EQ(nacre("render quick.xml --spp 4 --aovs --quiet -o a.exr").code, 0);
    ASSERT_EQ(nacre("render quick.xml --spp 4 --quiet -o p.exr").code, 0);
    const Image image = read_image(folder_ / "a.exr"), plain = read_image(folder_ / "p.exr");
    for (const std::string c : {"R", "G", "B"}) EXPECT_EQ(plane(image, c), plane(plain, c));
    // The middle of a white sphere of radius 1 seen from 5 away, and the sky of 0.5 at the corner.
    EXPECT_FLOAT_EQ(image.at(12, 8, image.channel("albedo.R")), 1.f);
    EXPECT_NEAR(image.at(12, 8, image.channel("normal.Z")), 1.f, 0.02f);
    EXPECT_NEAR(image.at(12, 8, image.channel("depth.Z")), 4.f, 0.02f);
    EXPECT_EQ(image.at(0, 0, image.channel("albedo.R")), 0.5f);
    EXPECT_EQ(image.at(0, 0, image.channel("depth.Z")), 0.f);
}

TEST_F(Denoised, WhatCannotBeIsRefusedBeforeRendering) {
    const struct {
        const char *arguments, *message;
    } cases[] = {
        {"--aovs -o a.png",
         "nacre: --aovs: a.png has no layers for albedo, normal and depth; write an .exr (-o)\n"},
        {"--denoise --spp 1 -o a.png",
         "nacre: --denoise: 1 sample a pixel does not tell noise from picture; take at least 2 "
         "(--spp), better 16\n"},
        {"--denoise -o a.png --checkpoint 60s --resume",
         "nacre: --denoise compares two halves of the samples of one run, which a kept film does "
         "not hold; leave out --resume\n"}};
    for (const auto& c : cases) {
        const Outcome r = nacre(std::string("render quick.xml ") + c.arguments);
        EXPECT_EQ(r.code, 2);
        EXPECT_EQ(r.err, c.message);
        EXPECT_TRUE(written().empty());
    }
}

TEST_F(LongDenoised, TheDemoSaysThatItIs) {
    const Outcome clean = nacre("demo --size 12x16 --spp 2 -o a.png"),
                  plain = nacre("demo --size 12x16 --spp 2 --no-denoise -o b.png");
    EXPECT_NE(clean.err.find("a.png (denoised, 12 x 16, "), std::string::npos) << clean.err;
    EXPECT_NE(plain.err.find("b.png (12 x 16, "), std::string::npos) << plain.err;
}

}  // namespace
}  // namespace nacre::test
