// What readers say about wrong files: the whole message, since that is all a user sees.
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "tests/geometry/files.h"

namespace nacre {
namespace {

using namespace test;

std::string message(const std::string& bytes, const std::string& name, int shape_index = 0) {
    MeshOptions options;
    options.shape_index = shape_index;
    try {
        parse_mesh(bytes, name, options);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::logic_error("test text lacks " + what);
    return text.replace(at, what.size(), by);
}

struct Case {
    std::string name, bytes, expected;
};

void check(const std::vector<Case>& cases) {
    for (const Case& c : cases) EXPECT_EQ(message(c.bytes, c.name), c.name + c.expected);
}

TEST(MeshErrors, Files) {
    const auto load = [](const std::filesystem::path& path) {
        try {
            load_mesh(path);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(load("/nowhere/bunny.ply"),
              "/nowhere/bunny.ply: cannot be opened (No such file or directory); check the path");
    EXPECT_EQ(load("/"), "/: is a folder; give the mesh file inside it");
    const auto empty =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_empty_{}.obj", getpid());
    std::ofstream{empty};
    EXPECT_EQ(load(empty), empty.string() + ": is empty; export the mesh again");
    std::filesystem::remove(empty);
    check({{"a.fbx", "x",
            ": unknown mesh format '.fbx'; nacre reads .glb, .gltf, .obj, .off, .ply, .serialized "
            "and .stl"},
           {"mesh", "x",
            ": unknown mesh format ''; nacre reads .glb, .gltf, .obj, .off, .ply, .serialized and "
            ".stl"}});
}

TEST(MeshErrors, Obj) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    check({
        {"a.obj", "# nothing\n",
         ": has no triangles; nacre renders surfaces, not points, lines or empty files"},
        {"a.obj", three + "f 1 2 4\n", ":4: face names vertex 4, but the file has 3 vertices"},
        {"a.obj", three + "\nf 1/2 2/1 3/1\nvt 0 0\n",
         ":5: face names texture coordinate 2, but the file has 1 texture coordinates"},
        {"a.obj", three + "f 1//1 2//1 3//1\n",
         ":4: face names normal 1, but the file has 0 normals"},
        {"a.obj", three + "f 1 2 -4\n",
         ":4: face 1 (counted from 1) has index -4, but 3 are defined before it"},
        {"a.obj", three + "f 1 2 2000000000\n",
         ":4: face 1 (counted from 1) has index 2000000000, but 3 are defined before it"},
        {"a.obj", three + "f 0 1 2\n", ":4: face names vertex 0; OBJ counts vertices from 1"},
        {"a.obj", three + "f 1 2 x\n", ":4: 'x' is not a corner; write v, v/vt, v//vn or v/vt/vn"},
        {"a.obj", "v 0 0\n", ":1: 'v' with 2 numbers; it needs 3"},
        {"a.obj", "v 0 nan 0\n", ":1: 'nan' is not a finite number"},
        {"a.obj", three + "v 1 1e60 1\nf 1 2 4\n",
         ": vertex 3 (counted from 0) lies at (1, inf, 1); coordinates must be finite and below "
         "1e18"},
        {"a.obj", three + "f 1 1 2\nf 2 3 3\n",
         ": has no area: two corners coincide in each of its 2 triangles; check the export scale"},
    });
}

TEST(MeshErrors, Ply) {
    const std::string text = tetrahedron_ply(PlyFormat::Text);
    const std::string binary = tetrahedron_ply(PlyFormat::LittleEndian);
    check({
        {"a.ply", "solid", ": is not a PLY file: it does not begin with 'ply'"},
        {"a.ply", "ply\nformat ascii 1.0\n",
         ": is truncated: no 'end_header' in its 21 bytes; export it again"},
        {"a.ply", "ply\nelement vertex 1\nend_header\n",
         ": has no 'format' line in its header; is it a PLY file of version 1.0?"},
        {"a.ply", replaced(text, "ascii", "ascii2"),
         ":2: unknown format 'ascii2'; PLY knows ascii, binary_little_endian and "
         "binary_big_endian"},
        {"a.ply", replaced(text, "double x", "half x"),
         ":9: unknown property type 'half'; PLY knows char, uchar, short, ushort, int, uint, float "
         "and double"},
        {"a.ply", replaced(text, "list ushort uint", "list float uint"),
         ":18: the length of a list cannot be a floating-point number"},
        {"a.ply", replaced(text, "property double x", "property double a"),
         ": has vertices without x, y and z; export them with positions"},
        {"a.ply", replaced(text, "element vertex 4", "element vertex many"),
         ":8: 'many' stands where the number of elements should be an integer"},
        {"a.ply", replaced(text, "element vertex 4", "element vertex -4"),
         ":8: element 'vertex' occurs -4 times; a count cannot be negative"},
        {"a.ply", replaced(text, "element vertex", "element corner"),
         ": has no element 'vertex'; export the mesh with its vertices"},
        {"a.ply", replaced(text, "obj_info", "object"), ":4: unknown header keyword 'object'"},
        {"a.ply", replaced(binary, "element vertex 4", "element vertex 4000000000"),
         fmt::format(": is truncated: its header promises 4000000000 of element 'vertex', which "
                     "take 26 bytes each or more, but {} bytes are left; export it again",
                     binary.size() - binary.find("end_header") - 11 - 6)},
        {"a.ply", binary.substr(0, binary.size() - 1),
         ": is truncated in face 3 of 4 (counted from 0); export it again"},
        {"a.ply", replaced(text, "5 3 0 2 1", "5 3 0 2 4"),
         ":26: face 0 names vertex 4, but vertices run from 0 to 3"},
        {"a.ply", replaced(text, "5 3 0 2 1", "5 3 0 2 -1"),
         ":26: face 0 names vertex -1, but vertices run from 0 to 3"},
        {"a.ply", replaced(text, "5 3 0 2 1", "5 -3 0 2 1"), ":26: face 0 has a list of -3 items"},
        {"a.ply", replaced(text, "\n1 9 0", "\n1 9 zero"),
         ":23: 'zero' stands where a property should be a number"},
        {"a.ply", replaced(text, "\n1 9 0", "\n1 9 nan"),
         ": vertex 1 (counted from 0) lies at (1, nan, 0); coordinates must be finite and below "
         "1e18"},
    });
}

TEST(MeshErrors, Off) {
    const std::string good = tetrahedron_off();
    check({
        {"a.off", "# only a comment\n", ": is empty; an OFF file begins with 'OFF'"},
        {"a.off", "3 1 0\n", ":1: begins with '3'; an OFF file begins with 'OFF'"},
        {"a.off", "4OFF\n1 1 1\n",
         ":1: '4OFF' has coordinates in other than three dimensions; save it as plain OFF"},
        {"a.off", "OFF BINARY\n", ":1: binary OFF is not read; save it as text, or as PLY"},
        {"a.off", replaced(good, "4 4 6", "-4 4 6"),
         ":3: -4 vertices and 4 faces cannot be; check the header"},
        {"a.off", replaced(good, "4 4 6", "9000 4 6"),
         fmt::format(": is truncated: its header promises 9000 vertices and 4 faces, but only {} "
                     "bytes follow; export it again",
                     good.size() - good.find("4 4 6") - 6 + 2)},
        {"a.off", good.substr(0, good.size() - 8), ": is truncated: 3 of 4 faces; export it again"},
        {"a.off", replaced(good, "3 0 2 1", "3 0 2 4"),
         ":9: face 0 names vertex 4, but vertices run from 0 to 3"},
        {"a.off", replaced(good, "3 0 2 1", "3 0 2"),
         ":9: a vertex index is missing; the line is too short"},
        {"a.off", replaced(good, "0 1 0", "0 one 0"),
         ":7: 'one' stands where a coordinate should be a number"},
    });
}

TEST(MeshErrors, Stl) {
    const std::string text = tetrahedron_stl(false), binary = tetrahedron_stl(true);
    std::string infinite = binary;
    const float inf = std::numeric_limits<float>::infinity();
    std::memcpy(infinite.data() + 84 + 50 + 12, &inf, 4);
    check({
        {"a.stl", "stl?",
         ": is neither text STL, which begins with 'solid', nor binary STL, whose header alone "
         "takes 84 bytes: it has 4"},
        {"a.stl", binary.substr(0, 200),
         ": is truncated: its header promises 4 triangles (284 bytes), but it has 200 bytes; "
         "export it again"},
        {"a.stl", text.substr(0, text.rfind("endfacet")),
         ":29: the file ends where 'endfacet' should stand; export it again"},
        {"a.stl", replaced(text, "outer", "inner"),
         ":3: 'inner' stands where 'outer' should; is this an STL file?"},
        {"a.stl", replaced(text, "vertex 0 1 0", "vertex 0 1 y"),
         ":5: 'y' stands where a coordinate should be a number"},
        {"a.stl", infinite,
         ": triangle 1 (counted from 0) has a corner at (inf, 0, 0); coordinates must be finite"},
        {"a.stl", "solid nothing\nendsolid\n",
         ": has no triangles; nacre renders surfaces, not points, lines or empty files"},
    });
}

TEST(MeshErrors, Serialized) {
    const std::string good = tetrahedron_serialized(4, false);
    std::string version = good, table = good, count = good;
    version[2] = 5;
    table[table.size() - 4 - 16] = 100;  // offset of the first mesh
    table[table.size() - 4 - 15] = 100;
    count[count.size() - 1] = 1;
    check({
        {"a.serialized", "12345678",
         ": is not a Mitsuba .serialized file: it does not begin with 1c 04"},
        {"a.serialized", version, ": has version 5 of the format; nacre reads 3 and 4"},
        {"a.serialized", count,
         ": is truncated: its last bytes promise 16777218 meshes; export it again"},
        {"a.serialized", table,
         fmt::format(": has mesh 0 at bytes 25700 to {} of {}; the table of offsets at its end is "
                     "damaged, export it again",
                     good.find(std::string("\x1c\x04\x04\0", 4), 1), good.size() - 20)},
    });
    EXPECT_EQ(message(good, "a.serialized", 2),
              "a.serialized: has no mesh 2; shape_index runs from 0 to 1");
    EXPECT_EQ(message(good, "a.serialized", -1),
              "a.serialized: has no mesh -1; shape_index runs from 0 to 1");
    // A stream that ends early, and one that promises what cannot have been packed.
    const auto single = [](const std::string& raw) {
        std::string file;
        put(file, std::uint16_t{0x041c}), put(file, std::uint16_t{3});
        file += packed(raw);
        put(file, std::uint32_t{0}), put(file, std::uint32_t{1});
        return file;
    };
    std::string raw;
    put(raw, std::uint32_t{0x1000}), put(raw, std::uint64_t{4}), put(raw, std::uint64_t{1});
    EXPECT_EQ(message(single(raw), "a.serialized"),
              "a.serialized: is truncated or damaged: the compressed data end before 48 more bytes "
              "of positions; export it again");
    raw[10] = 1;
    EXPECT_EQ(message(single(raw), "a.serialized"),
              fmt::format("a.serialized: promises {} vertices and 1 triangles in {} compressed "
                          "bytes; it is damaged, export it again",
                          (1ull << 48) + 4, packed(raw).size()));
    raw[10] = 0;
    for (int i = 0; i < 12; ++i) put(raw, 1.f);
    for (const std::uint32_t v : {0u, 1u, 4u}) put(raw, v);
    EXPECT_EQ(message(single(raw), "a.serialized"),
              "a.serialized: face 0 names vertex 4, but the mesh has 4 vertices (counted from 0)");
}

TEST(MeshErrors, Gltf) {
    const std::string good = tetrahedron_gltf();
    check({
        {"a.gltf", replaced(good, "\"count\":4", "\"count\":5"),
         ": accessor 0 (POSITION) wants 5 elements of 12 bytes, but its buffer view holds 48 bytes "
         "of a buffer of 72; export it again"},
        {"a.gltf", replaced(good, "\"count\":12", "\"count\":11"),
         ": has a primitive of 11 corners, which is not a multiple of three; export it again"},
        {"a.gltf", replaced(good, "\"count\":4", "\"count\":3"),
         ": corner 5 of a primitive names vertex 3, but it has 3 vertices (counted from 0)"},
        {"a.gltf", replaced(good, "VEC3", "VEC2"),
         ": accessor 0 (POSITION) has 2 components of 4 bytes; it needs 3"},
        {"a.gltf", replaced(good, "\"POSITION\":0", "\"POSITION\":7"),
         ": names accessor 7, but there are 2"},
        {"a.gltf", replaced(good, "\"POSITION\"", "\"COLOR_0\""),
         ": has a primitive without POSITION; export it with positions"},
        {"a.gltf", replaced(good, "\"mesh\":0", "\"mesh\":3"), ": names mesh 3, but there are 1"},
        {"a.gltf", tetrahedron_gltf(R"(,"children":[0])"),
         ": node 0 is its own ancestor or a child twice; glTF nodes form a tree"},
        {"a.gltf", tetrahedron_gltf(R"(,"scale":[1,0,1])"),
         ": node 0: transform is singular: it flattens space; give every axis a scale other than "
         "zero"},
        {"a.gltf", tetrahedron_gltf("", R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
         ": needs KHR_draco_mesh_compression; export it without compression"},
        {"a.gltf", tetrahedron_gltf("", "", R"(,"mode":1)"),
         ": has no triangles; nacre renders surfaces, not points, lines or empty files"},
    });
    EXPECT_TRUE(message("{", "a.gltf").starts_with("a.gltf: is not valid glTF ("));
    EXPECT_EQ(message(tetrahedron_glb().substr(0, 60), "a.glb"),
              fmt::format("a.glb: is cut off: its header promises {} bytes, but there are 60; copy "
                          "it again",
                          tetrahedron_glb().size()));
}

TEST(MeshErrors, Generators) {
    EXPECT_THROW(make_icosphere(-1), InputError);
    EXPECT_THROW(make_icosphere(10), InputError);
    EXPECT_THROW(make_torus(1, 1, 8, 8), InputError);
    EXPECT_THROW(make_torus(1, 0.5f, 2, 8), InputError);
}

// Damaged files either load or are refused: bytes flipped, cut out, doubled, and numbers made
// extreme.
TEST(MeshErrors, MutatedFilesAreRefusedOrRead) {
    int loaded = 0, refused = 0;
    std::uint64_t seed = 0;
    for (const auto& [name, original] : tetrahedron_files()) {
        ++seed;
        for (std::uint64_t i = 0; i < 3000; ++i) {
            Random random(stream_key(seed, i));
            std::string bytes = original;
            for (int changes = 1 + random.next_bits() % 4; changes > 0 && !bytes.empty();
                 --changes) {
                const std::size_t at = random.next_bits() % bytes.size();
                const std::size_t length = random.next_bits() % 12;
                const auto kind = random.next_bits() % 6;
                if (kind == 0) bytes[at] = static_cast<char>(random.next_bits());
                if (kind == 1) bytes[at] ^= static_cast<char>(1 << random.next_bits() % 8);
                if (kind == 2) bytes.erase(at, length);
                if (kind == 3) bytes.insert(at, bytes.substr(at, length));
                if (kind == 4) bytes.resize(at);
                if (kind == 5)
                    bytes.replace(at, 4, random.next() < 0.5f ? "9999" : "\xff\xff\xff\x7f");
            }
            MeshOptions options;
            options.shape_index = static_cast<int>(i % 2);
            try {
                const auto mesh = parse_mesh(bytes, "/nowhere/" + name, options);
                ++loaded;
                for (const Mesh::Triangle& t : mesh->triangles)
                    for (const std::uint32_t v : t) ASSERT_LT(v, mesh->positions.size());
            } catch (const InputError& e) {
                ++refused;
                ASSERT_TRUE(std::string(e.what()).starts_with("/nowhere/" + name));
            }
        }
    }
    EXPECT_GT(loaded, 1000);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace nacre
