#include "nacre/image/image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <fstream>

#include "nacre/image/formats.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  fmt::format("nacre_image_{}_{}", getpid(),
                              testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    std::string bytes(const fs::path& file) const {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    /// The error of reading `name`, without the folder.
    std::string read_error(const std::string& name) const {
        try {
            read_image(folder_ / name);
        } catch (const InputError& e) {
            std::string text = e.what();
            const std::string prefix = folder_.string() + "/";
            while (text.find(prefix) != text.npos) text.erase(text.find(prefix), prefix.size());
            return text;
        }
        return "no error";
    }
    int file_count() const {
        return static_cast<int>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    fs::path folder_;
};

Image noise_image(int width, int height, std::vector<std::string> channels, float low, float high) {
    Image image(width, height, std::move(channels));
    Random random(7);
    for (float& v : image.data) v = low + (high - low) * random.next();
    return image;
}

TEST_F(ImageFiles, ExrKeepsEveryBitChannelAndAttribute) {
    Image image = noise_image(37, 19, {"R", "G", "B", "Y", "variance.R"}, -5.f, 1e6f);
    image.at(3, 4, 1) = std::numeric_limits<float>::infinity();
    image.metadata = {{"nacre.command", "nacre render a.xml"}, {"note", "two\nlines"}};
    write_image(image, folder_ / "a.exr");
    const Image back = read_image(folder_ / "a.exr");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 19);
    EXPECT_EQ(back.channels, image.channels);
    EXPECT_EQ(back.data, image.data);
    EXPECT_EQ(back.metadata, image.metadata);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(ImageFiles, PfmKeepsEveryBit) {
    for (const auto& channels : {std::vector<std::string>{"R", "G", "B"}, {"Y"}}) {
        const Image image = noise_image(5, 9, channels, -1.f, 1.f);
        write_image(image, folder_ / "a.pfm");
        const Image back = read_image(folder_ / "a.pfm");
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.data, image.data);
    }
}

TEST_F(ImageFiles, PfmOfEitherByteOrderStartsAtTheBottomAndIsScaled) {
    // 1 x 2 grey, big endian, scale 2: the first value, 1.0, is the lower pixel.
    const std::string data("\x3f\x80\x00\x00\x40\x40\x00\x00", 8);
    const Image image = read_image(file("a.pfm", "Pf\n1 2\n2.0\n" + data));
    EXPECT_EQ(image.at(0, 1, 0), 2.f);
    EXPECT_EQ(image.at(0, 0, 0), 6.f);
}

TEST_F(ImageFiles, HdrKeepsEightBitsOfTheLargestChannel) {
    for (int width : {3, 40}) {  // plain and run-length encoded rows
        Image image = noise_image(width, 7, {"R", "G", "B"}, 0.f, 300.f);
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, 2, c) = 0.25f;  // runs
        image.at(1, 1, 0) = image.at(1, 1, 1) = image.at(1, 1, 2) = -1.f;
        write_image(image, folder_ / "a.hdr");
        const Image back = read_image(folder_ / "a.hdr");
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < width; ++x) {
                const Vec3f a = image.rgb(x, y), b = back.rgb(x, y);
                const float step = std::max({a.x, a.y, a.z, 0.f}) / 128.f;
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::max(0.f, a[c]), b[c], step);
            }
        EXPECT_EQ(back.rgb(0, 2), Vec3f(0.25f, 0.25f, 0.25f));
    }
}

TEST_F(ImageFiles, HdrReadsRunsOfTheOldEncoding) {
    // One pixel of (128, 64, 32) * 2^(129 - 136) = (1, 0.5, 0.25) and two repetitions.
    const std::string pixels("\x80\x40\x20\x81\x01\x01\x01\x02", 8);
    const Image image =
        read_image(file("a.hdr", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n" + pixels));
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.rgb(x, 0), Vec3f(1.f, 0.5f, 0.25f));
}

TEST_F(ImageFiles, PngKeepsEveryCodeThroughAReadAndAWrite) {
    Image image(256, 2, {"R", "G", "B"});
    for (int x = 0; x < 256; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, 0, c) = srgb_decode(static_cast<float>(x) / 255.f);
    write_image(image, folder_ / "a.png");
    const Image codes = read_image(folder_ / "a.png", {.raw = true});
    for (int x = 0; x < 256; ++x) EXPECT_FLOAT_EQ(codes.at(x, 0, 1), static_cast<float>(x) / 255.f);
    write_image(read_image(folder_ / "a.png"), folder_ / "b.png");
    EXPECT_EQ(bytes(folder_ / "a.png"), bytes(folder_ / "b.png"));
}

TEST_F(ImageFiles, PngIsExposedClampedAndKeepsAlpha) {
    Image image(4, 1, {"R", "G", "B", "A"});
    const float values[] = {0.25f, 4.f, -1.f, std::numeric_limits<float>::quiet_NaN()};
    for (int x = 0; x < 4; ++x) {
        for (int c = 0; c < 3; ++c) image.at(x, 0, c) = values[x];
        image.at(x, 0, 3) = 0.2f * static_cast<float>(x);
    }
    write_image(image, folder_ / "a.png", 1.f);
    const Image back = read_image(folder_ / "a.png");
    EXPECT_NEAR(back.at(0, 0, 0), 0.5f, 0.004f);  // 2^1 * 0.25, within a code
    EXPECT_EQ(back.rgb(1, 0), Vec3f(1, 1, 1));
    EXPECT_EQ(back.rgb(2, 0), Vec3f(0, 0, 0));
    EXPECT_EQ(back.rgb(3, 0), Vec3f(0, 0, 0));
    EXPECT_FLOAT_EQ(back.at(3, 0, 3), 153.f / 255.f);
}

TEST_F(ImageFiles, PngOfASmoothGradientKeepsItsMeanBetweenTwoCodes) {
    // 0.4 of the way between codes 100 and 101: noise of half a step makes both appear.
    const float between = srgb_decode(100.4f / 255.f);
    Image image(100, 100);
    std::fill(image.data.begin(), image.data.end(), between);
    write_image(image, folder_ / "a.png");
    const Image back = read_image(folder_ / "a.png", {.raw = true});
    int upper = 0;
    for (float v : back.data) {
        const int code = static_cast<int>(std::lround(v * 255.f));
        ASSERT_TRUE(code == 100 || code == 101);
        upper += code == 101;
    }
    // P(floor(0.4 + 0.25 + 0.5 u) = 1) = 0.3; 30000 draws, 5 sigma = 0.0133.
    EXPECT_NEAR(upper / 30000.0, 0.3, 0.0133);
}

TEST_F(ImageFiles, ExrOfHalfTilesAndOffsetWindows) {
    // Written by the format's own library: half channels, tiles, a data window off the origin.
    using namespace Imf;
    Header header(Imath::Box2i({0, 0}, {99, 99}), Imath::Box2i({10, 20}, {49, 39}));
    header.channels().insert("G", Channel(HALF));
    header.channels().insert("Z", Channel(FLOAT));
    header.setTileDescription(TileDescription(16, 16, ONE_LEVEL));
    const int w = 40, h = 20;
    std::vector<half> green(w * h);
    std::vector<float> depth(w * h);
    for (int i = 0; i < w * h; ++i) {
        green[i] = half(0.5f * static_cast<float>(i % 64));
        depth[i] = static_cast<float>(i);
    }
    {
        TiledOutputFile out((folder_ / "tiled.exr").c_str(), header);
        FrameBuffer buffer;
        const Imath::Box2i window = header.dataWindow();
        buffer.insert("G", Slice::Make(HALF, green.data(), window));
        buffer.insert("Z", Slice::Make(FLOAT, depth.data(), window));
        out.setFrameBuffer(buffer);
        out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    }
    EXPECT_EQ(read_error("tiled.exr"),
              "tiled.exr: has no R, G and B and no single luminance Y; its channels are: G, Z");
    const Image image = read_image(folder_ / "tiled.exr", {.any_channels = true});
    ASSERT_EQ(image.channels, (std::vector<std::string>{"G", "Z"}));
    // The picture is the display window of 100 x 100; the data stand at (10, 20) in it.
    ASSERT_EQ(image.width, 100);
    ASSERT_EQ(image.height, 100);
    EXPECT_EQ(image.data_window, "10, 20 to 49, 39");
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            const bool inside = x >= 10 && x < 10 + w && y >= 20 && y < 20 + h;
            const int i = (y - 20) * w + x - 10;
            ASSERT_EQ(image.at(x, y, 0), inside ? static_cast<float>(green[i]) : 0.f);
            ASSERT_EQ(image.at(x, y, 1), inside ? depth[i] : 0.f);
        }
    EXPECT_EQ(image.channel("Z"), 1);
    EXPECT_EQ(image.channel("R"), -1);
}

TEST_F(ImageFiles, WhatIsNotAnImageIsAnsweredExactly) {
    file("empty.exr", "");
    file("text.exr", "hello");
    file("scene.xyz", "hello");
    write_image(Image(8, 8), folder_ / "ok.exr");
    write_image(Image(8, 8), folder_ / "ok.png");
    fs::copy(folder_ / "ok.exr", folder_ / "renamed.png");
    fs::create_directory(folder_ / "folder.png");
    file("size.pfm", "PF\n1000 1000\n-1.0\n123456789012");
    file("zero.pfm", "PF\n0 4\n-1.0\n");
    file("negative.pfm", "PF\n-3 4\n-1.0\n");
    file("word.pfm", "PF\nthree 4\n-1.0\n");
    file("scale.pfm", "PF\n1 1\n0\n123456789012");
    file("half.pfm", "PF\n2");
    file("format.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234");
    file("turned.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+X 1 -Y 1\n1234");
    file("endless.hdr", "#?RADIANCE");
    file("short.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n1234");
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
    file("run.hdr", header + std::string("\2\2\0\10\xff\1\1\1", 8));
    file("zero_run.hdr", header + std::string("\2\2\0\10\0\0\0\0", 8));
    file("lie.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 15000 +X 15000\n1234");
    file("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n1234");
    const std::string png = bytes(folder_ / "ok.png");
    file("cut.png", png.substr(0, png.size() - 12));
    file("cut.jpg", "\xff\xd8\xff\xe0");

    const std::pair<const char*, const char*> cases[] = {
        {"missing.exr", "missing.exr: no such file"},
        {"folder.png", "folder.png: is a folder, not an image"},
        {"empty.exr", "empty.exr: the file is empty"},
        {"text.exr", "text.exr: is not an image of the format EXR: it does not begin like one"},
        {"scene.xyz",
         "scene.xyz: '.xyz' is not an image format that nacre reads; known are .exr, .pfm, .hdr, "
         ".png, .jpg"},
        {"renamed.png", "renamed.png: holds EXR data behind the extension of PNG; rename it"},
        {"size.pfm",
         "size.pfm: its header promises 1000 x 1000 pixels, but the file is too short for that"},
        {"zero.pfm", "zero.pfm: its size is 0 x 4; both sides must be positive"},
        {"negative.pfm", "negative.pfm: its size is -3 x 4; both sides must be positive"},
        {"word.pfm", "word.pfm: has 'three' for its width, which is not a number"},
        {"scale.pfm", "scale.pfm: has a scale of 0; its sign must tell the byte order"},
        {"half.pfm", "half.pfm: has a header that does not end"},
        {"format.hdr", "format.hdr: is not of the format 32-bit_rle_rgbe; convert it to RGBE"},
        {"turned.hdr",
         "turned.hdr: has the size '+X 1 -Y 1'; nacre reads rows from the top left, '-Y height +X "
         "width'"},
        {"endless.hdr", "endless.hdr: has a header that does not end"},
        {"short.hdr", "short.hdr: is truncated: pixels are missing; copy it again"},
        {"run.hdr", "run.hdr: is damaged: a run of pixels leaves its row; copy it again"},
        {"zero_run.hdr", "zero_run.hdr: is damaged: a run of pixels leaves its row; copy it again"},
        {"huge.hdr",
         "huge.hdr: its size of 30000 x 30000 with 3 channels is more than nacre reads (2^30 "
         "values)"},
        {"lie.hdr",
         "lie.hdr: its header promises 15000 x 15000 pixels, but the file is too short for that"},
        {"cut.png", "cut.png: is truncated: it has no end marker; copy it again"},
        {"cut.jpg", "cut.jpg: is truncated: it has no end marker; copy it again"},
    };
    for (const auto& [name, message] : cases) EXPECT_EQ(read_error(name), message);
}

struct Codec {
    const char* name;
    std::function<std::string(const Image&)> encode;
    std::function<Image(const std::string&)> decode;
};
const Codec codecs[] = {
    {"exr", image_formats::encode_exr,
     [](const std::string& b) { return image_formats::decode_exr(b); }},
    {"pfm", image_formats::encode_pfm, image_formats::decode_pfm},
    {"hdr", image_formats::encode_hdr, image_formats::decode_hdr},
    {"png", [](const Image& i) { return image_formats::encode_png(i, 0.f); },
     [](const std::string& b) { return image_formats::decode_ldr(b, false); }},
};

TEST(ImageFormats, AFileCutAnywhereIsAnError) {
    const Image image = noise_image(23, 11, {"R", "G", "B"}, 0.f, 1.f);
    for (const Codec& codec : codecs) {
        const std::string whole = codec.encode(image);
        EXPECT_EQ(codec.decode(whole).width, 23);
        for (std::size_t n = 4; n < whole.size(); n += 1 + whole.size() / 397)
            EXPECT_THROW(codec.decode(whole.substr(0, n)), InputError)
                << codec.name << " cut to " << n << " of " << whole.size() << " bytes";
    }
}

TEST(ImageFormats, DamagedBytesAreAnImageOrAnErrorButNeverACrash) {
    const Image image = noise_image(23, 11, {"R", "G", "B"}, 0.f, 1.f);
    Random random(3);
    for (const Codec& codec : codecs) {
        const std::string whole = codec.encode(image);
        for (int i = 0; i < 1000; ++i) {
            std::string damaged = whole;
            // Half of them in the header, where sizes are.
            const std::size_t range =
                i % 2 ? whole.size() : std::min<std::size_t>(whole.size(), 340);
            for (int k = 0; k < 3; ++k)
                damaged[random.next_bits() % range] = static_cast<char>(random.next_bits());
            try {
                const Image got = codec.decode(damaged);
                EXPECT_EQ(got.data.size(),
                          std::size_t(got.width) * got.height * got.channels.size());
            } catch (const InputError& e) {
                EXPECT_GT(std::string(e.what()).size(), 10u);
            }
        }
    }
}

TEST_F(ImageFiles, WritingFailsBeforeItLeavesAnything) {
    const auto error = [&](const fs::path& path) -> std::string {
        try {
            check_image_output(path);
            return "no error";
        } catch (const InputError& e) {
            return e.what();
        }
    };
    const std::string f = folder_.string();
    EXPECT_EQ(error(folder_ / "a.exr"), "no error");
    EXPECT_EQ(error(folder_ / "a.jpg"),
              f + "/a.jpg: '.jpg' is not an image format that nacre writes; known are .exr, .pfm, "
                  ".hdr, .png");
    EXPECT_EQ(error(folder_ / "no" / "a.exr"),
              f + "/no/a.exr: the folder " + f + "/no does not exist; make it first");
    fs::create_directory(folder_ / "b.exr");
    EXPECT_EQ(error(folder_ / "b.exr"), f + "/b.exr: is a folder; name a file");
    EXPECT_THROW(write_image(Image(2, 2), folder_ / "a.xyz"), InputError);
    EXPECT_THROW(write_image(Image(2, 2), folder_ / "no" / "a.exr"), RunError);
    // The rename fails after all bytes were written: the file beside must go.
    file("b.exr/occupied", "x");
    EXPECT_THROW(write_image(Image(2, 2), folder_ / "b.exr"), RunError);
    EXPECT_EQ(file_count(), 1);
}

TEST(Image, GreyStandsForAllThreeChannels) {
    Image image(1, 1, {"Z", "Y"});
    image.data = {3.f, 2.f};
    EXPECT_EQ(image.rgb(0, 0), Vec3f(2, 2, 2));
    image.channels = {"Z", "W"};
    EXPECT_EQ(image.rgb(0, 0), Vec3f(3, 3, 3));
    EXPECT_THROW(Image(0, 4), InputError);
}

TEST(Image, SharedEnvironmentMapsAreRead) {
    const fs::path env = fs::path(NACRE_SHARED_DIR) / "data" / "env";
    if (!fs::exists(env)) GTEST_SKIP() << "no shared data at " << env;
    const Image hdr = read_image(env / "venice_sunset_1k.hdr");
    EXPECT_EQ(hdr.width, 1024);
    EXPECT_EQ(hdr.height, 512);
    EXPECT_EQ(read_image(env / "mitsuba_envmap.exr").channel("R"), 0);
}

}  // namespace
}  // namespace nacre
