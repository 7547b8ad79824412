// Readers of pictures x what files of others hold: layers, parts, windows, exposures, line ends.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <gtest/gtest.h>

#include <fstream>

#include "nacre/image/image.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// A part of an EXR file: each channel holds one value everywhere.
struct Part {
    std::string name;
    std::vector<std::pair<std::string, float>> channels;
    Imath::Box2i data{{0, 0}, {3, 1}}, display{{0, 0}, {3, 1}};
};

class ImageMatrix : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  fmt::format("nacre_matrix_{}_{}", getpid(),
                              testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void exr(const std::string& name, const std::vector<Part>& parts,
             Imf::Compression compression = Imf::ZIP_COMPRESSION) const {
        std::vector<Imf::Header> headers;
        for (const Part& p : parts) {
            Imf::Header h(p.display, p.data);
            h.compression() = compression;
            h.setName(p.name);
            h.setType(Imf::SCANLINEIMAGE);
            for (const auto& [channel, value] : p.channels)
                h.channels().insert(channel, Imf::Channel(Imf::FLOAT));
            headers.push_back(h);
        }
        Imf::MultiPartOutputFile file((folder_ / name).c_str(), headers.data(),
                                      int(headers.size()));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const Imath::Box2i& d = parts[i].data;
            const int width = d.max.x - d.min.x + 1, height = d.max.y - d.min.y + 1;
            std::vector<std::vector<float>> values;
            Imf::FrameBuffer buffer;
            values.reserve(parts[i].channels.size());
            for (const auto& [channel, value] : parts[i].channels) {
                values.emplace_back(std::size_t(width) * height, value);
                buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, values.back().data(), d));
            }
            Imf::OutputPart out(file, int(i));
            out.setFrameBuffer(buffer);
            out.writePixels(height);
        }
    }
    void file(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    /// "r g b" of the first pixel, or the message without the folder.
    std::string read(const std::string& name) const {
        try {
            const Vec3f c = read_image(folder_ / name).rgb(0, 0);
            return fmt::format("{} {} {}", c.x, c.y, c.z);
        } catch (const InputError& e) {
            std::string text = e.what();
            const std::string prefix = folder_.string() + "/";
            while (text.find(prefix) != text.npos) text.erase(text.find(prefix), prefix.size());
            return text;
        }
    }
    fs::path folder_;
};

using Channels = std::vector<std::pair<std::string, float>>;
const Channels rgb = {{"R", 1.f}, {"G", 2.f}, {"B", 3.f}};

Channels layer(const std::string& prefix, float r) {
    return {
        {prefix + ".R", r}, {prefix + ".G", r + 1}, {prefix + ".B", r + 2}, {prefix + ".A", 1.f}};
}

Channels operator+(Channels a, const Channels& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST_F(ImageMatrix, ExrLayers) {
    const Channels depth = {{"Z", 9.f}}, alpha = {{"A", 0.5f}};
    exr("plain.exr", {{"p", rgb + alpha + depth}});
    exr("lower.exr", {{"p", {{"r", 1.f}, {"g", 2.f}, {"b", 3.f}, {"a", 0.5f}}}});
    exr("plain_and_layer.exr", {{"p", rgb + layer("diffuse", 7.f)}});
    exr("blender.exr",
        {{"p", layer("ViewLayer.Combined", 4.f) + Channels{{"ViewLayer.Depth.Z", 9.f}}}});
    exr("two.exr", {{"p", layer("beauty", 4.f) + layer("diffuse", 7.f)}});
    exr("grey.exr", {{"p", {{"Y", 5.f}, {"A", 1.f}}}});
    exr("grey_layer.exr", {{"p", {{"light.Y", 5.f}, {"Z", 9.f}}}});
    exr("chroma.exr", {{"p", {{"Y", 5.f}, {"RY", 0.f}, {"BY", 0.f}}}});
    exr("depth.exr", {{"p", depth}});
    exr("alpha.exr", {{"p", alpha}});
    exr("no_blue.exr", {{"p", {{"R", 1.f}, {"G", 2.f}}}});
    exr("normals.exr", {{"p", {{"N.X", 1.f}, {"N.Y", 2.f}, {"N.Z", 3.f}}}});
    exr("take#1.exr", {{"p", rgb}});
    const std::string none = "has no R, G and B and no single luminance Y; its channels are: ";
    const std::pair<const char*, std::string> cases[] = {
        {"plain.exr", "1 2 3"},
        {"lower.exr", "1 2 3"},
        {"lower.exr#beauty",
         "lower.exr: has no layers but one picture, R, G and B or Y by themselves: leave out "
         "'#beauty'"},
        {"plain_and_layer.exr", "1 2 3"},
        {"plain_and_layer.exr#diffuse", "7 8 9"},
        {"blender.exr", "4 5 6"},
        {"blender.exr#ViewLayer.Combined", "4 5 6"},
        {"two.exr",
         "two.exr: holds several pictures: beauty, diffuse; name one behind the file, as in "
         "file.exr#beauty"},
        {"two.exr#beauty", "4 5 6"},
        {"two.exr#diffuse", "7 8 9"},
        {"two.exr#specular", "two.exr: has no layer 'specular'; it has: beauty, diffuse"},
        {"two.exr#", "two.exr: no layer is named behind '#'"},
        {"grey.exr", "5 5 5"},
        {"grey_layer.exr", "5 5 5"},
        {"chroma.exr", "chroma.exr: " + none + "BY, RY, Y"},
        {"depth.exr", "depth.exr: " + none + "Z"},
        {"alpha.exr", "alpha.exr: " + none + "A"},
        {"no_blue.exr", "no_blue.exr: " + none + "G, R"},
        {"take#1.exr", "1 2 3"},
    };
    for (const auto& [name, expected] : cases) EXPECT_EQ(read(name), expected) << name;
    const Image image = read_image(folder_ / "two.exr#diffuse");
    EXPECT_EQ(image.channels[3], "A");
    EXPECT_EQ(image.layers, (std::vector<std::string>{"beauty", "diffuse"}));
    EXPECT_GE(image.channel("beauty.R"), 0) << "the rest of the part is kept";
}

TEST_F(ImageMatrix, ExrParts) {
    const Channels depth = {{"Z", 9.f}};
    exr("depth_first.exr", {{"depth", depth}, {"rgba", rgb}});
    exr("stereo.exr", {{"left", rgb}, {"right", {{"R", 4.f}, {"G", 5.f}, {"B", 6.f}}}});
    exr("layered.exr", {{"a", layer("sun", 1.f)}, {"b", layer("sky", 4.f)}});
    const std::pair<const char*, const char*> cases[] = {
        {"depth_first.exr", "1 2 3"},
        {"depth_first.exr#rgba", "1 2 3"},
        {"stereo.exr",
         "stereo.exr: holds several pictures: left, right; name one behind the file, as in "
         "file.exr#left"},
        {"stereo.exr#right", "4 5 6"},
        {"stereo.exr#1", "4 5 6"},
        {"layered.exr#b.sky", "4 5 6"},
    };
    for (const auto& [name, expected] : cases) EXPECT_EQ(read(name), expected) << name;
}

TEST_F(ImageMatrix, ExrWindows) {
    const Imath::Box2i display{{0, 0}, {7, 5}};
    exr("part.exr", {{"p", rgb, {{2, 1}, {4, 3}}, display}});
    exr("over.exr", {{"p", rgb, {{-3, -3}, {20, 20}}, display}});
    exr("corner.exr", {{"p", rgb, {{-3, -3}, {1, 0}}, display}});
    exr("elsewhere.exr", {{"p", rgb, {{10, 10}, {12, 12}}, display}});
    const auto lit = [&](const char* name) {
        const Image image = read_image(folder_ / name);
        EXPECT_EQ(image.width, 8);
        EXPECT_EQ(image.height, 6);
        std::string rows;
        for (int y = 0; y < 6; ++y) {
            for (int x = 0; x < 8; ++x) rows += image.rgb(x, y) == Vec3f(1, 2, 3) ? '#' : '.';
            rows += ' ';
        }
        return rows;
    };
    EXPECT_EQ(lit("part.exr"), "........ ..###... ..###... ..###... ........ ........ ");
    EXPECT_EQ(lit("over.exr"), "######## ######## ######## ######## ######## ######## ");
    EXPECT_EQ(lit("corner.exr"), "##...... ........ ........ ........ ........ ........ ");
    EXPECT_EQ(read("elsewhere.exr"),
              "elsewhere.exr: shows nothing: its data window (10, 10 to 12, 12) lies outside its "
              "display window (0, 0 to 7, 5)");
}

TEST_F(ImageMatrix, ExrCompressions) {
    for (const auto c : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                         Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
                         Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
        exr("a.exr", {{"p", rgb}}, c);
        EXPECT_EQ(read("a.exr"), "1 2 3") << c;
    }
}

TEST_F(ImageMatrix, Hdr) {
    // One pixel of (128, 64, 32) * 2^(129 - 136) = (1, 0.5, 0.25).
    const auto hdr = [&](const std::string& lines) {
        file("a.hdr",
             "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
        return read("a.hdr");
    };
    EXPECT_EQ(hdr(""), "1 0.5 0.25");
    EXPECT_EQ(hdr("EXPOSURE=2\n"), "0.5 0.25 0.125");
    EXPECT_EQ(hdr("EXPOSURE= 2.0\nEXPOSURE=4\n"), "0.125 0.0625 0.03125");
    EXPECT_EQ(hdr("COLORCORR=1 2 0.5\n"), "1 0.25 0.5");
    EXPECT_EQ(hdr("# EXPOSURE=2\nSOFTWARE=x\n"), "1 0.5 0.25");
    EXPECT_EQ(hdr("EXPOSURE=0\n"),
              "a.hdr: has the line 'EXPOSURE=0'; 1 positive number belongs there");
    EXPECT_EQ(hdr("EXPOSURE=1.2.3\n"),
              "a.hdr: has the line 'EXPOSURE=1.2.3'; 1 positive number belongs there");
    EXPECT_EQ(hdr("COLORCORR=1 2\n"),
              "a.hdr: has the line 'COLORCORR=1 2'; 3 positive numbers belong there");
}

TEST_F(ImageMatrix, Pfm) {
    // One grey pixel of 1, little-endian; one whose first byte is a line feed.
    const std::string one("\x00\x00\x80\x3f", 4), line_feed("\x0a\x00\x80\x3f", 4);
    const auto pfm = [&](const std::string& bytes) {
        file("a.pfm", bytes);
        return read("a.pfm");
    };
    EXPECT_EQ(pfm("Pf\n1 1\n-1.0\n" + one), "1 1 1");
    EXPECT_EQ(pfm("Pf\r\n1 1\r\n-1.0\r\n" + one), "1 1 1");
    EXPECT_EQ(pfm("Pf\r1 1\r-1.0\r" + one), "1 1 1");
    EXPECT_EQ(pfm("Pf 1 1 -1 " + one), "1 1 1");
    EXPECT_EQ(pfm("Pf\r1 1\r-1.0\r" + line_feed), pfm("Pf\n1 1\n-1.0\n" + line_feed));
    EXPECT_EQ(pfm("Pf\r\n1 1\r\n-1.0\r\n" + one.substr(1)),
              "a.pfm: its header promises 1 x 1 pixels, but the file is too short for that");
    for (const char* word : {"1.2.3", "nan", "inf", "0x1", "1e", "-"})
        EXPECT_EQ(pfm(fmt::format("Pf\n1 1\n{}\n", word) + one),
                  fmt::format("a.pfm: has '{}' for its scale, which is not a number", word));
    EXPECT_EQ(pfm("Pf\n1.5 1\n-1\n" + one), "a.pfm: has a size that is not a whole number");
    EXPECT_EQ(pfm("Pf\n4294967297 1\n-1\n" + one),
              "a.pfm: its size of 4294967297 x 1 with 1 channels is more than nacre reads (2^30 "
              "values)");
}

TEST_F(ImageMatrix, OnlyExrHasLayers) {
    file("a.pfm", "Pf\n1 1\n-1.0\n" + std::string("\x00\x00\x80\x3f", 4));
    EXPECT_EQ(read("a.pfm#diffuse"), "a.pfm: only EXR has layers, such as 'diffuse'");
    EXPECT_EQ(read("b.exr#diffuse"), "b.exr: no such file");
}

}  // namespace
}  // namespace nacre
