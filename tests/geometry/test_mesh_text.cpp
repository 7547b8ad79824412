// What text (and nearly text) mesh files of many programs hold: empty slots, continued lines, paths
// of Windows, headers of any make, damage.
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"
#include "tests/geometry/solids.h"

namespace nacre {
namespace {

using namespace test;

std::string message(const std::string& bytes) {
    try {
        parse_mesh(bytes, "a.obj");
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

const std::string kSquare =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0.6 0 0.8\n";

TEST(ObjCorners, EmptySlotsAreAbsent) {
    for (const char* face : {"f 1 2 3 4", "f 1// 2// 3// 4//", "f 1/ 2/ 3/ 4/", "f +1 +2 +3 +4"}) {
        const auto mesh = parse_mesh(kSquare + face, "a.obj");
        EXPECT_EQ(mesh->triangles, (std::vector<Mesh::Triangle>{{0, 1, 2}, {0, 2, 3}})) << face;
        EXPECT_TRUE(mesh->normals.empty() && mesh->uvs.empty()) << face;
    }
    for (const char* face :
         {"f 1/1 2/2 3/3 4/4", "f 1/1/ 2/2/ 3/3/ 4/4/", "f -4/-4/ -3/-3/ -2/-2/ -1/-1/"}) {
        const auto mesh = parse_mesh(kSquare + face, "a.obj");
        ASSERT_EQ(mesh->uvs.size(), 4u) << face;
        EXPECT_EQ(mesh->uvs[1], (Vec2f{1, 1})) << face;
        EXPECT_TRUE(mesh->normals.empty()) << face;
    }
    for (const char* face : {"f 1//2 2//2 3//2 4//2", "f 1/1/2 2/2/2 3/3/2 4/4/-1"}) {
        const auto mesh = parse_mesh(kSquare + face, "a.obj");
        ASSERT_EQ(mesh->normals.size(), 4u) << face;
        EXPECT_LT(length(mesh->normals[3] - Vec3f{0.6f, 0, 0.8f}), 1e-6f) << face;
    }
}

TEST(ObjCorners, OthersAreRefused) {
    for (const char* corner : {"//1", "/1", "/", "1/2/3/4", "1///", "1/x", "1.0", "1e0", "--1",
                               "1-", "+-1", "0x1", "1\\2"})
        EXPECT_EQ(
            message(kSquare + "f 1 2 " + corner),
            fmt::format("a.obj:11: '{}' is not a corner; write v, v/vt, v//vn or v/vt/vn", corner));
    EXPECT_EQ(
        message(kSquare + "f 1 2 -99999999999999999999"),
        "a.obj:11: face 1 (counted from 1) has index -99999999999999999999, but 4 are defined "
        "before it");
}

TEST(ObjLines, ContinueBehindABackslash) {
    const auto mesh = parse_mesh(
        "v 0 \\\n0 0\nv 1\\\r\n 0\\\r0\nv 1 1 \\  \n0\nvt \\\n0 \\\n0\nvn 0 0 \\\n1 # \\\n"
        "f 1/1/1 \\ # the rest:\n 2/1/1\\\n3/1/1\n",
        "a.obj");
    ASSERT_EQ(mesh->positions.size(), 3u);
    EXPECT_EQ(mesh->positions[1], (Point3f{1, 0, 0}));
    EXPECT_EQ(mesh->positions[2], (Point3f{1, 1, 0}));
    EXPECT_EQ(mesh->triangles.size(), 1u);
    // At the end of the file, and before a line that holds nothing.
    EXPECT_EQ(parse_mesh(kSquare + "f 1 2 3 \\\n\nf 1 3 4 \\", "a.obj")->triangles.size(), 2u);
}

TEST(ObjLines, NamesAndCommentsEndWithTheirLine) {
    const std::string cube = solid_obj(unit_cube());
    for (const char* line : {"# faces of D:\\work\\", "mtllib C:\\x\\", "usemtl stone\\", "g a\\",
                             "o b\\", "s off\\", "   #\\", "l 1 2 \\", "p 1 \\"}) {
        const std::string all = replace_all(cube, "\nf", fmt::format("\n{}\nf", line));
        const MeshReport report =
            inspect(*parse_mesh(replace_all(all, "\nv", fmt::format("\n{}\nv", line)), "a.obj"));
        EXPECT_TRUE(report.solid()) << line;
        EXPECT_NEAR(report.area, 6, 1e-6) << line;
    }
    const std::string behind = replace_all(cube, "\n", " # D:\\work\\\n");
    EXPECT_NEAR(inspect(*parse_mesh(behind, "a.obj")).area, 6, 1e-6);
    EXPECT_NEAR(inspect(*parse_mesh(replace_all(cube, "\n", "#x\n"), "a.obj")).area, 6, 1e-6);
}

TEST(ObjLines, WhatFollowsTheNumbersIsPassedOver) {
    const auto mesh = parse_mesh(
        "v\t0\v0\f0 0.5 0.5 0.5\nv 1 0 0 1.0\nv 0 1 0 extra\nvt 0.5 0.25 0\nf 1/1 2/1 3/1\n"
        "curv 0 1 1 2\nl 1 2\np 1\nfo 1 2 3\n",
        "a.obj");
    EXPECT_EQ(mesh->triangles.size(), 1u);
    EXPECT_EQ(mesh->uvs[0], (Vec2f{0.5f, 0.75f}));
    EXPECT_EQ(parse_mesh(kSquare + "f 1 2 3\nf\nf 1\nf 1 2\n", "a.obj")->dropped_triangles, 3u);
}

TEST(ObjErrors, WhatWouldBeLeftOut) {
    EXPECT_EQ(message(kSquare + "f 1 2 3\nsurf 0 1 0 1 1 2 3\n"),
              "a.obj:12: free-form surfaces are not read; convert them to polygons before the "
              "export");
    EXPECT_EQ(message(kSquare + "call more.obj\n"),
              "a.obj:11: 'call' takes in another file, which is not done; export the mesh into one "
              "file");
    EXPECT_EQ(message("v 1 2 3\nvt 0.5 1.2.3\n"), "a.obj:2: '1.2.3' is not a finite number");
    EXPECT_EQ(message("vt\n"), "a.obj:1: 'vt' with 0 numbers; it needs 1");
    EXPECT_EQ(message("vn 0 1 nan\n"), "a.obj:1: 'nan' is not a finite number");
}

TEST(OffHeader, CountsBehindTheKeyword) {
    const std::string cube = solid_off(unit_cube());
    for (const char* header :
         {"OFF8 6 0\n", "OFF 8 6 0\n", "OFF\n8 6 12\n", "OFF8\n6 0\n", "COFF8 6\n"})
        EXPECT_NEAR(inspect(*parse_mesh(header + cube.substr(10), "a.off")).area, 6, 1e-6)
            << header;
    const std::pair<const char*, const char*> wrong[] = {
        {"OFFX 8 6 0",
         "'OFFX' is not a header of OFF, which is written [ST][C][N]OFF; save it as "
         "plain OFF"},
        {"NCOFF 8 6 0",
         "'NCOFF' is not a header of OFF, which is written [ST][C][N]OFF; save it as "
         "plain OFF"},
        {"4OFF 8 6 0",
         "'4OFF' has coordinates in other than three dimensions; save it as plain OFF"},
        {"nOFF 8 6 0",
         "'nOFF' has coordinates in other than three dimensions; save it as plain OFF"},
        {"off 8 6 0", "begins with 'off'; an OFF file begins with 'OFF'"},
        {"OFF8.0 6 0", "'8.0' stands where the number of vertices should be an integer"}};
    for (const auto& [header, what] : wrong) {
        try {
            parse_mesh(fmt::format("{}\n{}", header, cube.substr(10)), "a.off");
            ADD_FAILURE() << header;
        } catch (const InputError& e) {
            EXPECT_EQ(e.what(), fmt::format("a.off:1: {}", what));
        }
    }
}

TEST(StlBinary, MayBeginWithSolid) {
    const std::string cube = solid_stl(unit_cube(), true);
    for (const std::string& start :
         {std::string("solid"), std::string("solid \0x", 8), std::string("solid a\nfacet")}) {
        std::string s = cube;
        s.replace(0, start.size(), start);
        for (const std::string& more : {std::string(), std::string("\r\n"), std::string(100, 'x')})
            EXPECT_NEAR(inspect(*parse_mesh(s + more, "a.stl")).area, 6, 1e-6);
        for (const std::size_t size : {83u, 84u, 300u, 683u}) try {
                parse_mesh(s.substr(0, size), "a.stl");
                ADD_FAILURE() << size;
            } catch (const InputError& e) {
                EXPECT_EQ(
                    e.what(),
                    size < 84
                        ? "a.stl: is neither text STL, which begins with 'solid', nor binary STL, "
                          "whose header alone takes 84 bytes: it has 83"
                        : fmt::format("a.stl: is truncated: its header promises 12 triangles (684 "
                                      "bytes), but it has {} bytes; export it again",
                                      size));
            }
    }
    std::string zero = cube;
    zero[80] = 0;
    try {
        parse_mesh(zero, "a.stl");
        ADD_FAILURE();
    } catch (const InputError& e) {
        EXPECT_STREQ(
            e.what(),
            "a.stl: promises 0 triangles in its header, but 600 bytes follow it; export it "
            "again");
    }
}

TEST(StlText, CaseAndNames) {
    std::string s = solid_stl(unit_cube(), false);
    for (const char* word : {"solid", "facet", "normal", "outer", "loop", "vertex", "endloop"}) {
        std::string upper = word;
        for (char& c : upper) c = static_cast<char>(c - 32);
        s = replace_all(s, word, upper);
    }
    EXPECT_NEAR(inspect(*parse_mesh(s, "a.stl")).area, 6, 1e-6);
    s = replace_all(solid_stl(unit_cube(), false), "a part", "facet of \xc3\xa9 D:\\x\\ solid");
    EXPECT_NEAR(inspect(*parse_mesh(s, "a.stl")).area, 6, 1e-6);
}

}  // namespace
}  // namespace nacre
