// Readers of meshes x what files of others hold: each cell is read as the same unit cube or refused
// with the message that says what, where and how to mend it (docs/mesh-formats.md has the table).
#include <array>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"
#include "tests/geometry/files.h"

namespace nacre {
namespace {

using namespace test;

constexpr float kCube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
constexpr int kSides[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string points(const std::string& before = "") {
    std::string s;
    for (const auto& p : kCube) s += fmt::format("{}{} {} {}\n", before, p[0], p[1], p[2]);
    return s;
}

std::string cube_obj() {
    std::string s = "# cube\n" + points("v ");
    for (const auto& f : kSides)
        s += fmt::format("f {} {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1, f[3] + 1);
    return s;
}

std::string sides() {
    std::string s;
    for (const auto& f : kSides) s += fmt::format("4 {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    return s;
}

std::string cube_off() { return "OFF\n# cube\n8 6 12\n" + points() + sides(); }

std::string ply_header(const char* format) {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment cube\nelement vertex 8\nproperty float x\nproperty float y\n"
        "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n",
        format);
}

std::string cube_ply() { return ply_header("ascii") + points() + sides(); }

std::string cube_body() {
    std::string s;
    for (const auto& p : kCube)
        for (const float x : p) put(s, x);
    for (const auto& f : kSides) {
        put(s, std::uint8_t{4});
        for (const int v : f) put(s, std::int32_t{v});
    }
    return s;
}

std::string cube_binary_ply() { return ply_header("binary_little_endian") + cube_body(); }

std::string cube_stl(bool binary, const std::string& name = "solid cube") {
    std::string s = binary ? (name + std::string(80, ' ')).substr(0, 80) : name + "\n";
    if (binary) put(s, std::uint32_t{12});
    for (const auto& f : kSides)
        for (const std::array<int, 3> t :
             {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
            if (binary)
                for (int i = 0; i < 3; ++i) put(s, 0.f);
            else
                s += "facet normal 0 0 0\nouter loop\n";
            for (const int v : t) {
                if (!binary)
                    s += fmt::format("vertex {} {} {}\n", kCube[v][0], kCube[v][1], kCube[v][2]);
                else
                    for (const float x : kCube[v]) put(s, x);
            }
            if (binary)
                put(s, std::uint16_t{0x8001});
            else
                s += "endloop\nendfacet\n";
        }
    return binary ? s : s + "endsolid cube\n";
}

std::string with(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// The first occurrence only.
std::string once(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    if (at == text.npos) throw std::logic_error("test text lacks " + what);
    return text.replace(at, what.size(), by);
}

struct Cell {
    const char* situation;
    std::string name, bytes;
    std::string expected = "";  ///< empty: read; else the message behind the file's name
};

void check(const std::vector<Cell>& cells) {
    for (const Cell& c : cells) {
        SCOPED_TRACE(c.name + ": " + c.situation);
        std::string message;
        try {
            const auto mesh = parse_mesh(c.bytes, c.name);
            const MeshReport report = inspect(*mesh);
            if (c.expected.empty()) {
                EXPECT_NEAR(report.area, 6, 1e-6);
                EXPECT_NEAR(report.volume, 1, 1e-6);
                EXPECT_TRUE(report.solid());
            }
        } catch (const InputError& e) {
            message = e.what();
        }
        EXPECT_EQ(message, c.expected.empty() ? "" : c.name + c.expected);
    }
}

const std::string bom = "\xef\xbb\xbf";

TEST(MeshMatrix, TextOfAnyKind) {
    const std::pair<const char*, std::string> files[] = {{"a.obj", cube_obj()},
                                                         {"a.off", cube_off()},
                                                         {"a.ply", cube_ply()},
                                                         {"a.stl", cube_stl(false)}};
    for (const auto& [name, text] : files)
        check(
            {{"LF", name, text},
             {"CR LF", name, with(text, "\n", "\r\n")},
             {"CR", name, with(text, "\n", "\r")},
             {"byte order mark", name, bom + text},
             {"byte order mark, CR LF", name, bom + with(text, "\n", "\r\n")},
             {"no end of the last line", name, text.substr(0, text.size() - 1)},
             {"form feeds and tabs", name, with(text, " ", "\t")},
             {"numbers with signs and bare points", name,
              with(text, name == std::string("a.stl") ? "vertex 1 0 0" : "1 0 0\n",
                   name == std::string("a.stl") ? "vertex +1.0 -0. .0e0" : "+1.0 -0. .0e0\n")},
             {"underflow", name,
              with(text, name == std::string("a.stl") ? "vertex 1 0 0" : "1 0 0\n",
                   name == std::string("a.stl") ? "vertex 1 1e-400 1e-50" : "1 1e-400 1e-50\n")}});
}

TEST(MeshMatrix, Obj) {
    const std::string cube = cube_obj();
    const auto vertex = [&](const std::string& by) { return once(cube, "v 1 0 0\n", by + "\n"); };
    const auto face = [&](const std::string& by) { return once(cube, "f 1 4 3 2\n", by + "\n"); };
    std::vector<Cell> cells = {
        {"negative indices", "a.obj", face("f -8 -5 -6 -7")},
        {"comment in a face", "a.obj", face("f 1 4 3 2 # 5 6")},
        {"comment at a word", "a.obj", face("f 1 4 3 2#5 6")},
        {"comment behind numbers", "a.obj", vertex("v 1 0 0 # 1 2 3")},
        {"comment that ends in a backslash", "a.obj", once(cube, "f 1", "# C:\\work\\\nf 1")},
        {"comment behind a face that ends in one", "a.obj", face("f 1 4 3 2 # C:\\work\\")},
        {"mtllib that ends in one", "a.obj", once(cube, "f 1", "mtllib C:\\work\\\nf 1")},
        {"usemtl that ends in one", "a.obj", once(cube, "f 1", "usemtl stone\\\nf 1")},
        {"o and g that end in one", "a.obj", once(cube, "f 1", "o a\\\ng b\\\nf 1")},
        {"continued face", "a.obj", face("f 1 4 \\\n3 \\\n 2")},
        {"continued face, CR LF, blanks", "a.obj", with(face("f 1 4 \\ \n3 2"), "\n", "\r\n")},
        {"continued vertex", "a.obj", vertex("v 1 \\\n0 0")},
        {"v//", "a.obj", face("f 1// 4// 3// 2//")},
        {"v/", "a.obj", face("f 1/ 4/ 3/ 2/")},
        {"v/vt/", "a.obj", "vt 0 0\n" + face("f 1/1/ 4/1/ 3/1/ 2/1/")},
        {"v//vn", "a.obj", "vn 0 0 -1\n" + face("f 1//1 4//1 3//1 2//1")},
        {"colours and w", "a.obj", vertex("v 1 0 0 1.0 0.5 0.25 1")},
        {"lines, points, curves", "a.obj", cube + "l 1 2\np 1\nvp 0.5\ncurv 0 1 1 2\n"},
        {"/v", "a.obj", face("f /1 4 3 2"),
         ":10: '/1' is not a corner; write v, v/vt, v//vn or v/vt/vn"},
        {"four parts", "a.obj", face("f 1/1/1/1 4 3 2"),
         ":10: '1/1/1/1' is not a corner; write v, v/vt, v//vn or v/vt/vn"},
        {"index with a point", "a.obj", face("f 1.5 4 3 2"),
         ":10: '1.5' is not a corner; write v, v/vt, v//vn or v/vt/vn"},
        {"lone sign", "a.obj", face("f - 4 3 2"),
         ":10: '-' is not a corner; write v, v/vt, v//vn or v/vt/vn"},
        {"index of 2^32 + 1", "a.obj", face("f 4294967297 4 3 2"),
         ":10: face 1 (counted from 1) has index 4294967297, but 8 are defined before it"},
        {"index of 2^64 + 1", "a.obj", face("f 18446744073709551617 4 3 2"),
         ":10: face 1 (counted from 1) has index 18446744073709551617, but 8 are defined before "
         "it"},
        {"negative index of 2^32", "a.obj", face("f -4294967296 4 3 2"),
         ":10: face 1 (counted from 1) has index -4294967296, but 8 are defined before it"},
        {"truncated in a vertex", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1",
         ":3: 'v' with 2 numbers; it needs 3"},
        {"truncated before its faces", "a.obj", cube.substr(0, cube.find('f')),
         ": has no triangles; nacre renders surfaces, not points, lines or empty files"},
    };
    for (const char* word :
         {"nan", "NaN", "-nan(ind)", "1.#IND", "1.#QNAN0", "inf", "-Infinity", "1e", "-", ".",
          "1e+", "1.0+01", "1e5e5", "1.2.3", "1,5", "0x10", "1f", "+-1"})
        cells.push_back({"no number", "a.obj", vertex(fmt::format("v 1 {} 0", word)),
                         fmt::format(":3: '{}' is not a finite number", word)});
    cells.push_back({"overflow", "a.obj", vertex("v 1 1e60 0"),
                     ": vertex 1 (counted from 0) lies at (1, inf, 0); coordinates must be finite "
                     "and below 1e18"});
    cells.push_back({"overflow of a double", "a.obj", vertex("v 1 -1e999 0"),
                     ": vertex 1 (counted from 0) lies at (1, -inf, 0); coordinates must be finite "
                     "and below 1e18"});
    check(cells);
}

TEST(MeshMatrix, Off) {
    const std::string cube = cube_off();
    const std::string body = "8 6 12\n" + points() + sides();
    check({
        {"ModelNet's header", "a.off", "OFF" + body},
        {"colours", "a.off", "COFF\n8 6 12\n" + with(points(), "\n", " 255 0 0 255\n") + sides()},
        {"colours, glued header", "a.off",
         "COFF8 6 12\n" + with(points(), "\n", " 255 0 0 255\n") + sides()},
        {"normals", "a.off", "NOFF\n8 6 12\n" + with(points(), "\n", " 0 0 1\n") + sides()},
        {"header in one line", "a.off", "OFF " + body},
        {"comments behind numbers", "a.off", with(cube, "\n1 0 0\n", "\n1 0 0 # corner\n")},
        {"face colours", "a.off", with(cube, "\n4 0 3 2 1\n", "\n4 0 3 2 1 0.5 0.5 0.5\n")},
        {"another word", "a.off", "OFFICE 8 6 12\n" + points() + sides(),
         ":1: begins with 'OFFICE'; an OFF file begins with 'OFF'"},
        {"no number", "a.off", once(cube, "\n1 0 0\n", "\n1.2.3 0 0\n"),
         ":5: '1.2.3' stands where a coordinate should be a number"},
        {"not finite", "a.off", once(cube, "\n1 0 0\n", "\n1 nan 0\n"),
         ": vertex 1 (counted from 0) lies at (1, nan, 0); coordinates must be finite and below "
         "1e18"},
        {"not finite as Windows spells it", "a.off", once(cube, "\n1 0 0\n", "\n1 1.#IND 0\n"),
         ":5: '1.#IND' stands where a coordinate should be a number"},
        {"overflow", "a.off", once(cube, "\n1 0 0\n", "\n1 1e400 0\n"),
         ": vertex 1 (counted from 0) lies at (1, inf, 0); coordinates must be finite and below "
         "1e18"},
        {"negative index", "a.off", once(cube, "4 0 3 2 1", "4 -8 3 2 1"),
         ":12: face 0 names vertex -8, but vertices run from 0 to 7"},
        {"index of 2^32", "a.off", once(cube, "4 0 3 2 1", "4 4294967296 3 2 1"),
         ":12: face 0 names vertex 4294967296, but vertices run from 0 to 7"},
        {"index of 2^64", "a.off", once(cube, "4 0 3 2 1", "4 18446744073709551616 3 2 1"),
         ":12: '18446744073709551616' stands where a vertex index should be an integer"},
        {"truncated", "a.off", cube.substr(0, cube.find("4 0 1 5 4")),
         ": is truncated: 2 of 6 faces; export it again"},
        {"count of 2^64", "a.off", "OFF 18446744073709551616 6 0\n",
         ":1: '18446744073709551616' stands where the number of vertices should be an integer"},
    });
}

TEST(MeshMatrix, Ply) {
    const std::string cube = cube_ply(), binary = cube_binary_ply();
    const std::string header = ply_header("binary_little_endian");
    // A body whose first byte is a line feed: behind a header of CR it is data.
    std::string line_feed = cube_body();
    line_feed[0] = '\n', line_feed[1] = line_feed[2] = line_feed[3] = 0;  // x of 1.4e-44
    check({
        {"binary", "a.ply", binary},
        {"binary, header of CR LF", "a.ply", with(header, "\n", "\r\n") + cube_body()},
        {"binary, header of CR", "a.ply", with(header, "\n", "\r") + cube_body()},
        {"binary, header of CR, data of LF", "a.ply", with(header, "\n", "\r") + line_feed},
        {"binary, byte order mark", "a.ply", bom + binary},
        {"binary, bytes behind it", "a.ply", binary + "more"},
        {"comments anywhere in the header", "a.ply",
         once(cube, "property float y\n", "comment a\nproperty float y\nobj_info b\n")},
        {"binary, truncated", "a.ply", binary.substr(0, binary.size() - 3),
         ": is truncated in face 5 of 6 (counted from 0); export it again"},
        {"truncated", "a.ply", cube.substr(0, cube.size() - 4),
         ": is truncated in face 5 of 6 (counted from 0); export it again"},
        {"truncated header", "a.ply", cube.substr(0, 30),
         ": is truncated: no 'end_header' in its 30 bytes; export it again"},
        {"no number", "a.ply", once(cube, "\n1 0 0\n", "\n1.2.3 0 0\n"),
         ":12: '1.2.3' stands where a property should be a number"},
        {"not finite", "a.ply", once(cube, "\n1 0 0\n", "\n1 -nan(ind) 0\n"),
         ": vertex 1 (counted from 0) lies at (1, -nan, 0); coordinates must be finite and below "
         "1e18"},
        {"overflow", "a.ply", once(cube, "\n1 0 0\n", "\n1 1e60 0\n"),
         ": vertex 1 (counted from 0) lies at (1, inf, 0); coordinates must be finite and below "
         "1e18"},
        {"negative index", "a.ply", once(cube, "4 0 3 2 1", "4 -8 3 2 1"),
         ":19: face 0 names vertex -8, but vertices run from 0 to 7"},
        {"index of 2^32", "a.ply", once(cube, "4 0 3 2 1", "4 4294967296 3 2 1"),
         ":19: face 0 names vertex 4294967296, but vertices run from 0 to 7"},
        {"list of 2^64 items", "a.ply", once(cube, "4 0 3 2 1", "18446744073709551616 0 3 2 1"),
         ": is truncated in face 0 of 6 (counted from 0); export it again"},
    });
}

TEST(MeshMatrix, Stl) {
    const std::string cube = cube_stl(false), binary = cube_stl(true);
    std::string infinite = binary;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(infinite.data() + 84 + 12, &nan, 4);
    check({
        {"binary", "a.stl", binary},
        {"binary that begins with solid, bytes behind it", "a.stl", binary + "xx"},
        {"binary with another header, bytes behind it", "a.stl", cube_stl(true, "STLB") + "xx"},
        {"binary that begins with solid, truncated", "a.stl", binary.substr(0, binary.size() - 10),
         ": is truncated: its header promises 12 triangles (684 bytes), but it has 674 bytes; "
         "export it again"},
        {"binary with another header, truncated", "a.stl", cube_stl(true, "STLB").substr(0, 300),
         ": is truncated: its header promises 12 triangles (684 bytes), but it has 300 bytes; "
         "export it again"},
        {"binary, not finite", "a.stl", infinite,
         ": triangle 0 (counted from 0) has a corner at (nan, 0, 0); coordinates must be finite"},
        {"upper case", "a.stl", with(with(cube, "facet", "FACET"), "vertex", "VERTEX")},
        {"name of several words", "a.stl", once(cube, "solid cube", "solid the cube 1.0")},
        {"no name", "a.stl", once(cube, "solid cube", "solid")},
        {"two solids", "a.stl", once(cube, "facet", "endsolid\nsolid b\nfacet")},
        {"facets' normals of nan", "a.stl", with(cube, "normal 0 0 0", "normal nan nan nan")},
        {"no number", "a.stl", once(cube, "vertex 0 1 0", "vertex 0 1.2.3 0"),
         ":5: '1.2.3' stands where a coordinate should be a number"},
        {"not finite", "a.stl", once(cube, "vertex 0 1 0", "vertex 0 -inf 0"),
         ":5: triangle 0 (counted from 0) has a corner at (0, -inf, 0); coordinates must be "
         "finite"},
        {"overflow", "a.stl", once(cube, "vertex 0 1 0", "vertex 0 1e60 0"),
         ":5: triangle 0 (counted from 0) has a corner at (0, inf, 0); coordinates must be finite"},
        {"truncated in a facet", "a.stl", cube.substr(0, cube.rfind("endloop")),
         ":83: the file ends where 'endloop' should stand; export it again"},
        {"truncated between facets", "a.stl", cube.substr(0, cube.rfind("endsolid")),
         ":85: the file ends where 'endsolid' should stand; export it again"},
    });
}

}  // namespace
}  // namespace nacre
