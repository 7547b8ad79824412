// nacre gallery: the shipped scenes, tiny.
#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

class Gallery : public test::CommandLine {};

// 23 tiles of 200 x 150, six in a row: 6 x 4 of them, the last one empty.
TEST_F(Gallery, ComposesTheIlluminationModelsIntoAContactSheet) {
    const Outcome r = nacre("gallery illumination -o out --scale 0.08 --spp 1 --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const Image sheet = read_image(folder_ / "out" / "illumination.png");
    EXPECT_EQ(sheet.width, 6 * 16);
    EXPECT_EQ(sheet.height, 4 * 12);
    const auto light = [&](int column, int row) {
        double sum = 0;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x) sum += sheet.rgb(column * 16 + x, row * 12 + y).y;
        return sum;
    };
    for (int i = 0; i < 23; ++i) EXPECT_GT(light(i % 6, i / 6), 0) << "tile " << i + 1;
    EXPECT_EQ(light(5, 3), 0);
    EXPECT_TRUE(r.out.starts_with("out/illumination.png\n  Illumination model 1."));
    EXPECT_NE(r.out.find("\n  Illumination model 13. Phong 1975:"), std::string::npos);
}

TEST_F(Gallery, RendersEveryPictureWithItsCaption) {
    const Outcome r = nacre("gallery -o out --scale 0.05 --spp 1 --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const std::pair<const char*, const char*> pictures[] = {
        {"cook_torrance_copper", "Cook and Torrance 1982"},
        {"cook_torrance_plastic", "Cook and Torrance 1982"},
        {"he_torrance", "He, Torrance, Sillion, Greenberg 1991"},
        {"illumination", "Illumination model 1."},
        {"lafortune", "Lafortune, Foo, Torrance, Greenberg 1997"},
        {"oren_nayar", "Oren and Nayar 1994"},
        {"phong", "Phong 1975"},
        {"schlick_double", "Schlick 1994"},
        {"schlick_single", "Schlick 1994"},
        {"ward", "Ward 1992"},
    };
    for (const auto& [name, caption] : pictures) {
        EXPECT_TRUE(fs::exists(folder_ / "out" / fmt::format("{}.png", name))) << name;
        EXPECT_NE(r.out.find(fmt::format("out/{}.png\n  {}", name, caption)), std::string::npos)
            << name;
    }
}

// Seen from where the light is, Oren and Nayar's rough ball is flatter than Lambert's: near the rim
// it keeps more of the brightness of its middle. Lambert's keeps the cosine: 0.6 at 0.8 radii.
TEST_F(Gallery, TheMoonOfOrenAndNayarIsFlat) {
    ASSERT_EQ(nacre("gallery oren_nayar -o out --scale 0.25 --spp 16 --quiet").code, 0);
    const Image moon = read_image(folder_ / "out" / "oren_nayar.png");
    ASSERT_EQ(moon.width, 200);
    // Orthographic, 4.6 units wide: centres at -1.15 and 1.15 of radius 1.
    const auto at = [&](double x) {
        return moon.rgb(static_cast<int>((x / 4.6 + 0.5) * moon.width), moon.height / 2).y;
    };
    EXPECT_NEAR(at(-1.15 - 0.8) / at(-1.15), 0.6, 0.03);
    EXPECT_GT(at(1.15 + 0.8) / at(1.15), 0.8);
}

// Four samples of five lamps are mostly noise; fifty times as many say what is true. The filter
// must take away more than half of the squared error, in a picture and in the tiles of a sheet.
TEST_F(Gallery, TakesTheNoiseOut) {
    const auto pictures = [&](const char* options) {
        EXPECT_EQ(nacre(fmt::format("gallery lafortune illumination -o out --scale 0.05 --scenes "
                                    "scenes --quiet {}",
                                    options))
                      .code,
                  0);
        return std::pair(read_image(folder_ / "out" / "lafortune.png"),
                         read_image(folder_ / "out" / "illumination.png"));
    };
    const fs::path scene = fs::path(NACRE_SOURCE_DIR) / "gallery" / "lafortune.xml";
    fs::create_directories(folder_ / "scenes" / "illumination");
    fs::copy(scene, folder_ / "scenes" / "lafortune.xml");
    for (const char* tile : {"01_a.xml", "02_b.xml"})
        fs::copy(scene, folder_ / "scenes" / "illumination" / tile);
    const auto truth = pictures("--spp 200"), noisy = pictures("--spp 4"),
               clean = pictures("--spp 4 --denoise");
    const auto error = [](const Image& picture, const Image& true_one) {
        double sum = 0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const double d = picture.rgb(x, y).y - true_one.rgb(x, y).y;
                sum += d * d;
            }
        return sum;
    };
    ASSERT_EQ(clean.second.width, 2 * clean.first.width);
    EXPECT_LT(error(clean.first, truth.first), 0.5 * error(noisy.first, truth.first));
    EXPECT_LT(error(clean.second, truth.second), 0.5 * error(noisy.second, truth.second));
}

TEST_F(Gallery, AnswersWrongCommandLinesExactlyAndWritesNothing) {
    const std::pair<const char*, const char*> cases[] = {
        {"gallery phnog -o out --scenes scenes",
         "no picture 'phnog' in the gallery; did you mean 'phong'?"},
        {"gallery vase -o out --scenes scenes",
         "no picture 'vase' in the gallery; known are: phong"},
        {"gallery -o out --scenes nowhere",
         "no gallery at 'nowhere'; give the folder gallery of the source tree: --scenes"},
        {"gallery -o out --scenes empty", "'empty' holds no scenes"},
        {"gallery -o out --scale 0", "--scale: '0' is not a number above 0 to 16"},
        {"gallery -o out --scenes scenes --spp 1 --denoise",
         "--denoise: 1 sample a pixel does not tell noise from picture; take at least 2 (--spp), "
         "better 16"},
        {"gallery", "--output is required; see 'nacre help gallery'"},
    };
    fs::create_directories(folder_ / "scenes");
    fs::create_directories(folder_ / "empty");
    fs::copy(folder_ / "quick.xml", folder_ / "scenes" / "phong.xml");
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
        EXPECT_FALSE(fs::exists(folder_ / "out")) << arguments;
    }
}

}  // namespace
}  // namespace nacre
