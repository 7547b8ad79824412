// What the page is given: pictures that it can decode, a document that cannot break out of its
// script, and the same numbers in a file.
#include "nacre/report/report.h"

#include <zlib.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/report/suite.h"
#include "tests/compare/experiment_fixture.h"

namespace nacre::test {
namespace {

using nlohmann::ordered_json;

std::vector<unsigned char> unpacked(const ordered_json& picture, std::size_t size) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned bits = 0;
    int have = 0;
    for (const char c : picture["data"].get<std::string>()) {
        if (c == '=') break;
        bits = bits << 6 | unsigned(digits.find(c));
        if ((have += 6) >= 8) bytes.push_back(static_cast<unsigned char>(bits >> (have -= 8)));
    }
    std::vector<unsigned char> out(size);
    uLongf n = uLong(size);
    EXPECT_EQ(uncompress(out.data(), &n, bytes.data(), uLong(bytes.size())), Z_OK);
    EXPECT_EQ(n, size);
    return out;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

/// Radiance's shared exponent (Ward 1991): value = mantissa 2^(E - 136).
TEST(ReportPictures, KeepColoursWithinHalfAStep) {
    Image image(40, 3);
    Random random(1);
    for (float& v : image.data) v = std::exp2(24.f * random.next() - 12.f);
    image.at(0, 0, 0) = 0.f, image.at(0, 0, 1) = 0.f, image.at(0, 0, 2) = 0.f;
    image.at(1, 0, 0) = -3.f;
    image.at(2, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(3, 0, 2) = 0.9999999f;  // rounds up to the next power of two
    const ordered_json picture = rgbe_picture(image);
    EXPECT_EQ(picture["width"], 40);
    EXPECT_EQ(picture["height"], 3);
    EXPECT_EQ(picture["encoding"], "rgbe");
    const std::size_t n = 120;
    const auto bytes = unpacked(picture, 4 * n);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 40; ++x) {
            const std::size_t i = std::size_t(y) * 40 + x;
            float most = 0.f;
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::isnan(image.at(x, y, c)) ? 0.f : image.at(x, y, c));
            for (int c = 0; c < 3; ++c) {
                const float v = image.at(x, y, c);
                const float expected = v > 0.f ? v : 0.f;
                const float found =
                    std::ldexp(float(bytes[c * n + i]), int(bytes[3 * n + i]) - 136);
                EXPECT_NEAR(found, expected, most / 256.f * 1.01f) << x << " " << y << " " << c;
            }
        }
}

TEST(ReportPictures, MapsAreBytes) {
    Image map(3, 1, {"Y"});
    map.data = {0.f, 0.5f, 7.f};
    EXPECT_EQ(unpacked(byte_map(map), 3), (std::vector<unsigned char>{0, 128, 255}));
}

TEST(ReportPictures, ShrinkingKeepsTheMean) {
    Image image(100, 50);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 100; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(x + c);
    const Image small = shrunk(image, 20);
    EXPECT_EQ(small.width, 20);
    EXPECT_EQ(small.height, 10);
    for (int x = 0; x < 20; ++x) EXPECT_NEAR(small.at(x, 4, 1), 5 * x + 2 + 1, 1e-4);
    EXPECT_EQ(shrunk(image, 100).data, image.data);
}

TEST_F(ExperimentTest, ADocumentStaysInItsScript) {
    const ordered_json document{{"format", 1},
                                {"kind", "techniques"},
                                {"title", "</title> & \"more\""},
                                {"command", "</script><script>alert(1)</script>"},
                                {"pictures", {{"a", 1}}},
                                {"rows", ordered_json::array()}};
    write_report(document, folder_ / "r");
    const std::string page = text_of(folder_ / "r/index.html");
    EXPECT_NE(page.find("<title>&lt;/title> &amp; &quot;more&quot;</title>"), page.npos);
    EXPECT_EQ(page.find("<script>alert"), page.npos);
    const std::string opening = "id=\"document\">";
    const std::size_t at = page.find(opening) + opening.size();
    const ordered_json there =
        ordered_json::parse(page.substr(at, page.find("</script>", at) - at));
    EXPECT_EQ(there, document);
    ordered_json numbers = document;
    numbers.erase("pictures");
    EXPECT_EQ(ordered_json::parse(text_of(folder_ / "r/report.json")), numbers);
    for (const char* mark : {"/*STYLE*/", "/*SCRIPT*/", "/*DOCUMENT*/", "<!--TITLE-->"})
        EXPECT_EQ(page.find(mark), page.npos) << mark;
    write("file", "");
    EXPECT_THROW(write_report(document, folder_ / "file" / "below"), InputError);
}

TEST(SuiteReport, HasAMatrixAndOneRowATechnique) {
    SuiteResult a, b;
    a.which = {"ball", "high", "homogeneous", "front"};
    b.which = {"slab", "low", "veined", "back"};
    a.picture = b.picture = Image(4, 4);
    const auto cell = [](const char* id, const char* why, double systematic) {
        SuiteCell c;
        c.id = id;
        c.why = why;
        c.systematic = systematic;
        return c;
    };
    a.cells = {cell("brdf profile=dipole", "", 0.03), cell("two_pass", "no", 0)};
    b.cells = {cell("brdf profile=dipole", "", 0.04), cell("two_pass", "never", 0)};
    const ordered_json d = describe_suite({a, b}, 3, 10, 20, {}, {"title", "", "", "cmd", "0"});
    for (const auto& fact : d["facts"]) EXPECT_TRUE(fact.is_array() && fact.size() == 2) << fact;
    EXPECT_EQ(d["warnings"].size(), 1u);  // two of three
    ASSERT_EQ(d["rows"].size(), 2u);
    EXPECT_EQ(d["rows"][0]["name"], "brdf");
    EXPECT_EQ(d["rows"][0]["setting"], "profile=dipole");
    EXPECT_NEAR(d["rows"][0]["values"]["systematic"].get<double>(), 3.5, 1e-9);  // median
    EXPECT_NEAR(d["rows"][0]["values"]["rms"].get<double>(), 100 * std::sqrt(0.00125), 1e-9);
    EXPECT_NEAR(d["rows"][0]["values"]["worst"].get<double>(), 4, 1e-9);
    EXPECT_EQ(d["rows"][1]["status"], "failed");
    EXPECT_EQ(d["matrix"]["cases"][1]["cells"]["two_pass"]["why"], "never");
    EXPECT_NEAR(d["matrix"]["cases"][1]["cells"]["brdf profile=dipole"]["systematic"].get<double>(),
                4, 1e-9);
    EXPECT_EQ(d["matrix"]["cases"][1]["labels"][0], "flat: slab");
    EXPECT_GT(d["printed"]["rows"].size(), 8u);
    for (const auto& row : d["printed"]["rows"])
        EXPECT_EQ(row.size(), d["printed"]["columns"].size());
}

}  // namespace nacre::test
