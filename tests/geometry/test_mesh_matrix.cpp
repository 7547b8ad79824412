// Readers x situations (docs/mesh-formats.md has the table): every cell is the right mesh, by area
// and volume, or the whole message of a refusal.
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"
#include "tests/geometry/solids.h"

namespace nacre {
namespace {

using namespace test;

enum Reader { Obj, PlyText, PlyBinary, Off, StlText, StlBinary, Serialized, ReaderCount };
const char* const kNames[] = {"a.obj", "a.ply", "b.ply", "a.off", "a.stl", "b.stl", "a.serialized"};

std::string bytes_of(int reader, const Solid& s) {
    switch (reader) {
        case Obj:
            return solid_obj(s);
        case PlyText:
            return solid_ply(s, false);
        case PlyBinary:
            return solid_ply(s, true);
        case Off:
            return solid_off(s);
        case StlText:
            return solid_stl(s, false);
        case StlBinary:
            return solid_stl(s, true);
        default:
            return solid_serialized(s);
    }
}
bool is_text(int reader) {
    return reader == Obj || reader == PlyText || reader == Off || reader == StlText;
}

std::string outcome(const std::string& bytes, const std::string& name) {
    try {
        const auto mesh = parse_mesh(bytes, name);
        const MeshReport r = inspect(*mesh);
        return fmt::format("{} {:.5g} {:.5g}", r.solid() ? "solid" : "open", r.area, r.volume);
    } catch (const InputError& e) {
        return e.what();
    }
}

const std::string kCube = "solid 6 1", kL = "solid 14 3";

// Expected outcomes, reader by reader; the messages without the file's name.
void check(const char* situation, const std::function<std::string(int)>& bytes,
           const std::map<int, std::string>& expected) {
    for (const auto& [reader, what] : expected) {
        const bool read = what.starts_with("solid") || what.starts_with("open");
        EXPECT_EQ(outcome(bytes(reader), kNames[reader]), read ? what : kNames[reader] + what)
            << situation;
    }
}

std::map<int, std::string> all(const std::string& what, bool text_only = false) {
    std::map<int, std::string> expected;
    for (int r = 0; r < ReaderCount; ++r)
        if (!text_only || is_text(r)) expected[r] = what;
    return expected;
}

TEST(MeshMatrix, PlainAndMarked) {
    check(
        "plain", [](int r) { return bytes_of(r, unit_cube()); }, all(kCube));
    auto marked = all(kCube, true);
    marked[PlyBinary] = kCube;
    check(
        "byte order mark",
        [](int r) { return fmt::format("\xef\xbb\xbf{}", bytes_of(r, unit_cube())); }, marked);
    check("UTF-16",
          [](int r) {
              std::string wide = "\xff\xfe";
              for (const char c : bytes_of(r, unit_cube())) wide += {c, '\0'};
              return wide;
          },
          {{Obj, ": is text in UTF-16, which is not read; save it as UTF-8 or ASCII"},
           {Off, ": is text in UTF-16, which is not read; save it as UTF-8 or ASCII"},
           {PlyText, ": is not a PLY file: it does not begin with 'ply'"}});
}

TEST(MeshMatrix, LineEnds) {
    for (const char* end : {"\r", "\r\n", "\r\r\n", "\n\n"})
        check(
            "line ends", [&](int r) { return replace_all(bytes_of(r, unit_cube()), "\n", end); },
            all(kCube, true));
    check(
        "mixed line ends",
        [](int r) {
            std::string mixed;
            int i = 0;
            for (const char c : bytes_of(r, unit_cube())) {
                if (c != '\n') {
                    mixed += c;
                    continue;
                }
                // PLY's first line says where header lines end.
                const int end = i++ % 3;
                if (end != 0) mixed += '\r';
                if (end != 2 || r == PlyText) mixed += '\n';
            }
            return mixed;
        },
        all(kCube, true));
    // The header of a binary file: what looks like a line end behind it belongs to the body.
    for (const char* end : {"\r", "\r\n"}) {
        std::string s = solid_ply(unit_cube(), true);
        const std::size_t body = s.find("end_header\n") + 11;
        std::string data = s.substr(body);
        Solid other = unit_cube();
        EXPECT_EQ(outcome(replace_all(s.substr(0, body), "\n", end) + data, "b.ply"), kCube);
        // An element whose first byte is LF.
        s = replace_all(s, "element vertex", "element tag 1\nproperty uchar a\nelement vertex");
        const std::size_t behind = s.find("end_header\n") + 11;
        EXPECT_EQ(
            outcome(replace_all(s.substr(0, behind), "\n", end) + "\n" + s.substr(behind), "b.ply"),
            kCube);
    }
}

TEST(MeshMatrix, Comments) {
    check("comments on lines of their own",
          [](int r) {
              std::string s = bytes_of(r, unit_cube());
              if (r == PlyText || r == PlyBinary)
                  return replace_all(s, "element", "comment element vertex 3 \\\nelement");
              return fmt::format("# D:\\work\\\n{}", replace_all(s, "\n", "\n# D:\\work\\\n"));
          },
          {{Obj, kCube}, {PlyText, kCube}, {PlyBinary, kCube}, {Off, kCube}, {StlText, kCube}});
    check("comments behind words",
          [](int r) { return replace_all(bytes_of(r, unit_cube()), "\n", " # D:\\work\\\n"); },
          {{Obj, kCube}, {Off, kCube}, {StlText, kCube}});
}

TEST(MeshMatrix, NegativeIndices) {
    EXPECT_EQ(outcome(solid_obj(unit_cube(), true), "a.obj"), kCube);
    const auto negative = [](int r) {
        Solid s = unit_cube();
        s.faces[0][0] = static_cast<std::uint32_t>(-1);
        return replace_all(bytes_of(r, s), "4294967295", "-1");
    };
    const std::string message = "face 0 names vertex -1, but vertices run from 0 to 7";
    check("negative indices", negative,
          {{PlyText, ":18: " + message},
           {PlyBinary, ": " + message},
           {Off, ":11: " + message},
           {Serialized,
            ": face 0 names vertex 4294967295, but the mesh has 8 vertices (counted "
            "from 0)"}});
}

TEST(MeshMatrix, IndicesDoNotWrap) {
    for (const char* index : {"4294967297", "9223372036854775809", "18446744073709551618"}) {
        Solid s = unit_cube();
        const std::string obj = replace_all(solid_obj(s), "f 5 6", fmt::format("f 5 {}", index));
        EXPECT_EQ(outcome(obj, "a.obj"),
                  fmt::format("a.obj:10: face 2 (counted from 1) has index {}, but 8 are defined "
                              "before it",
                              index));
        EXPECT_EQ(
            outcome(replace_all(solid_off(s), "4 4 5", fmt::format("4 4 {}", index)), "a.off"),
            index[0] == '4' ? "a.off:12: face 1 names vertex 4294967297, but vertices run "
                              "from 0 to 7"
                            : fmt::format("a.off:12: '{}' stands where a vertex index should "
                                          "be an integer",
                                          index));
        EXPECT_TRUE(outcome(replace_all(solid_ply(s, false), "4 4 5", fmt::format("4 4 {}", index)),
                            "a.ply")
                        .starts_with("a.ply:19: face 1 names vertex "));
    }
    // Counts of the header.
    const std::string many = "18446744073709551624";
    EXPECT_EQ(
        outcome(replace_all(solid_ply(unit_cube(), false), "vertex 8", "vertex " + many), "a.ply"),
        "a.ply:3: '" + many + "' stands where the number of elements should be an integer");
    EXPECT_EQ(outcome(replace_all(solid_off(unit_cube()), "8 6 0", many + " 6 0"), "a.off"),
              "a.off:2: '" + many + "' stands where the number of vertices should be an integer");
}

TEST(MeshMatrix, ConcavePolygons) {
    check("concave", [](int r) { return bytes_of(r, prism(l_shape(), 2)); },
          {{Obj, kL}, {PlyText, kL}, {PlyBinary, kL}, {Off, kL}});
}

TEST(MeshMatrix, MissingNormals) {
    // Given as zero, or as what is no number, they are computed like those that are absent.
    Solid cube = unit_cube();
    EXPECT_EQ(outcome(fmt::format("vn 0 0 0\n{}",
                                  replace_all(solid_obj(cube), "f 1 4 3 2", "f 1//1 4//1 3 2")),
                      "a.obj"),
              kCube);
    EXPECT_EQ(outcome(solid_serialized(cube, true), "a.serialized"), kCube);
    std::string off = fmt::format("N{}", solid_off(cube)), ply = solid_ply(cube, false);
    for (const auto& p : cube.positions) {
        const std::string line = fmt::format("\n{} {} {}", p[0], p[1], p[2]);
        const std::string end = "\n";
        off = replace_all(off, line + end, line + " 0 0 0\n");
        ply = replace_all(ply, line + end, line + " nan -nan(ind) 1.#IND\n");
    }
    ply =
        replace_all(ply, "property float z\n",
                    "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n");
    EXPECT_EQ(outcome(off, "a.off"), kCube);
    EXPECT_EQ(outcome(ply, "a.ply"), kCube);
    for (const int r : {StlText, StlBinary})
        EXPECT_EQ(outcome(bytes_of(r, cube), kNames[r]), kCube);
}

TEST(MeshMatrix, NumbersThatAreNotFinite) {
    for (const char* word : {"nan", "NaN", "-nan(ind)", "1.#IND", "1.#QNAN", "inf", "-Infinity"}) {
        const auto with = [&](int r) {
            std::string s = bytes_of(r, unit_cube());
            const std::size_t at = s.find("1 0 0\n");
            return s.replace(at, 1, word);
        };
        const std::string_view w = word;
        const std::string shown = w == "inf"         ? "inf"
                                  : w == "-Infinity" ? "-inf"
                                  : w[0] == '-'      ? "-nan"
                                                     : "nan";
        const std::string message = ": vertex 1 (counted from 0) lies at (" + shown +
                                    ", 0, 0); coordinates must be finite and below 1e18";
        check("not finite", with,
              {{Obj, fmt::format(":2: '{}' is not a finite number", word)},
               {PlyText, message},
               {Off, message},
               {StlText, ":13: triangle 1 (counted from 0) has a corner at (" + shown +
                             ", 0, 0); coordinates must be finite"}});
    }
    Solid s = unit_cube();
    s.positions[1][0] = -std::numeric_limits<float>::infinity();
    const std::string message =
        ": vertex 1 (counted from 0) lies at (-inf, 0, 0); coordinates must be finite and below "
        "1e18";
    check("not finite", [&](int r) { return bytes_of(r, s); },
          {{PlyBinary, message},
           {Serialized, message},
           {StlBinary,
            ": triangle 1 (counted from 0) has a corner at (-inf, 0, 0); coordinates "
            "must be finite"}});
}

TEST(MeshMatrix, NumbersAreWholeWords) {
    for (const char* word : {"1e", "-", ".", "1e+", "1.0+01", "1.2.3", "1e5e5", "0x10", "1,5"}) {
        const auto with = [&](int r) {
            std::string s = bytes_of(r, unit_cube());
            const std::size_t at = s.find("1 0 0\n");
            return s.replace(at, 1, word);
        };
        check("prefixes", with,
              {{Obj, fmt::format(":2: '{}' is not a finite number", word)},
               {PlyText, fmt::format(":11: '{}' stands where a property should be a number", word)},
               {Off, fmt::format(":4: '{}' stands where a coordinate should be a number", word)},
               {StlText,
                fmt::format(":13: '{}' stands where a coordinate should be a number", word)}});
    }
    check("other spellings",
          [](int r) {
              std::string s = bytes_of(r, unit_cube());
              const std::size_t at = s.find("1 0 0\n");
              return s.replace(at, 5, "+1.0 -1e-50 .0e-999");
          },
          {{Obj, kCube}, {PlyText, kCube}, {Off, kCube}});
}

TEST(MeshMatrix, Overflow) {
    const auto with = [](int r) {
        std::string s = bytes_of(r, unit_cube());
        const std::size_t at = s.find("1 0 0\n");
        return s.replace(at, 1, "1e60");
    };
    const std::string message =
        ": vertex 1 (counted from 0) lies at (inf, 0, 0); coordinates must be finite and below "
        "1e18";
    check("overflow", with,
          {{Obj, message},
           {PlyText, message},
           {Off, message},
           {StlText,
            ":13: triangle 1 (counted from 0) has a corner at (inf, 0, 0); coordinates must "
            "be finite"}});
}

TEST(MeshMatrix, Truncated) {
    const auto cut = [](int r) {
        const std::string s = bytes_of(r, unit_cube());
        return s.substr(0, s.size() - 9);
    };
    check("truncated", cut,
          {{Obj, "open 5 0.83333"},  // a last face without corners: OBJ states no numbers of faces
           {PlyText, ": is truncated in face 5 of 6 (counted from 0); export it again"},
           {PlyBinary, ": is truncated in face 5 of 6 (counted from 0); export it again"},
           {Off, ":16: a vertex index is missing; the line is too short"},
           {StlText, ":86: 'endsoli' stands where 'facet' should; is this an STL file?"},
           {StlBinary,
            ": is truncated: its header promises 12 triangles (684 bytes), but it has "
            "675 bytes; export it again"}});
    const std::string text = solid_stl(unit_cube(), false);
    EXPECT_EQ(outcome(text.substr(0, text.rfind("endfacet")), "a.stl"),
              "a.stl:84: the file ends where 'endfacet' should stand; export it again");
    EXPECT_TRUE(outcome(cut(Serialized), "a.serialized").find("export it again") !=
                std::string::npos);
    EXPECT_EQ(outcome(solid_stl(unit_cube(), true) + "\r\n", "b.stl"), kCube);
}

TEST(MeshMatrix, Compressed) {
    const std::pair<std::string, const char*> packers[] = {{"\x1f\x8b\x08", "gzip"},
                                                           {"PK\x03\x04", "zip"},
                                                           {"\x28\xb5\x2f\xfd", "zstd"},
                                                           {"BZh9", "bzip2"}};
    for (const auto& [start, name] : packers)
        check(
            "compressed", [&](int) { return start + "rest"; },
            all(fmt::format(": is compressed with {}; unpack it first", name)));
}

TEST(MeshMatrix, Parts) {
    // Two cubes in one file: all parts are read; .serialized has shape_index.
    Solid two = unit_cube();
    const Solid one = two;
    for (auto p : one.positions) two.positions.push_back({p[0] + 3, p[1], p[2]});
    for (auto f : one.faces) {
        for (auto& i : f) i += 8;
        two.faces.push_back(f);
    }
    check(
        "parts", [&](int r) { return bytes_of(r, two); }, all("solid 12 2"));
    Solid shifted = one;
    for (auto& p : shifted.positions) p[0] += 3;
    EXPECT_EQ(outcome(solid_stl(one, false) + solid_stl(shifted, false), "a.stl"), "solid 12 2");
    EXPECT_EQ(outcome(fmt::format("o one\\\n{}g two\\\nusemtl C:\\a\\\n{}", solid_obj(one, true),
                                  solid_obj(shifted, true)),
                      "a.obj"),
              "solid 12 2");
    MeshOptions second;
    second.shape_index = 1;
    EXPECT_EQ(
        parse_mesh(tetrahedron_serialized(4, false), "a.serialized", second)->triangles.size(), 4u);
}

}  // namespace
}  // namespace nacre
