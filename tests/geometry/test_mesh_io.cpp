#include "nacre/geometry/mesh_io.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"
#include "tests/geometry/files.h"

namespace nacre {
namespace {

using namespace test;

TEST(MeshReaders, EveryFormatGivesTheSameTetrahedron) {
    for (const auto& [name, bytes] : tetrahedron_files()) {
        MeshOptions options;
        options.shape_index = name.ends_with(".serialized") ? 1 : 0;
        const auto mesh = parse_mesh(bytes, name, options);
        SCOPED_TRACE(name);
        const MeshReport report = inspect(*mesh);
        ASSERT_EQ(mesh->triangles.size(), 4u);
        ASSERT_EQ(mesh->positions.size(), 4u);
        EXPECT_GT(mesh->positions.capacity(), mesh->positions.size());
        EXPECT_TRUE(report.solid());
        EXPECT_NEAR(report.volume, 1 / 6., 1e-7);
        EXPECT_NEAR(report.area, 1.5 + std::sqrt(3.) / 2, 1e-6);
        EXPECT_EQ(mesh->name, name);
        EXPECT_EQ(mesh->dropped_triangles, 0u);
        if (!name.ends_with("STL") && !name.ends_with("stl")) {
            for (int i = 0; i < 4; ++i) {
                EXPECT_EQ(mesh->triangles[i],
                          (Mesh::Triangle{kTetrahedronFaces[i][0], kTetrahedronFaces[i][1],
                                          kTetrahedronFaces[i][2]}));
                EXPECT_EQ(mesh->positions[i],
                          (Point3f{kTetrahedron[i][0], kTetrahedron[i][1], kTetrahedron[i][2]}));
            }
        }
        if (name.ends_with("ply") || name.ends_with(".serialized")) {
            ASSERT_EQ(mesh->uvs.size(), 4u);
            EXPECT_EQ(mesh->uvs[1], (Vec2f{1, 0}));
            EXPECT_EQ(mesh->uvs[2], (Vec2f{0, 1}));
        }
    }
}

TEST(MeshReaders, SerializedPicksTheShape) {
    EXPECT_EQ(parse_mesh(tetrahedron_serialized(3, false), "a.serialized")->triangles.size(), 1u);
    EXPECT_EQ(parse_mesh(tetrahedron_serialized(4, true), "a.serialized")->triangles.size(), 1u);
}

TEST(MeshReaders, ReadsFromDisk) {
    const auto folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_mesh_io_{}", getpid());
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "t.bin", std::ios::binary) << tetrahedron_buffer();
    std::ofstream(folder / "t.gltf", std::ios::binary) << tetrahedron_gltf_json(
        R"("uri":"t.bin",)", "", R"(,"images":[{"uri":"absent.png"},{"uri":"absent.jpg"}])");
    std::ofstream(folder / "t.ply", std::ios::binary) << tetrahedron_ply(PlyFormat::BigEndian);
    EXPECT_EQ(load_mesh(folder / "t.gltf")->triangles.size(), 4u);
    EXPECT_EQ(load_mesh(folder / "t.ply")->triangles.size(), 4u);
    std::filesystem::remove_all(folder);
}

TEST(Obj, MergesTriplesCountsBackwardsAndJoinsLines) {
    const auto mesh = parse_mesh(
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n"
        "vt 0 0\r\nvt 1 0\r\nvt 1 1\r\nvt 0 0.25\r\nvn 0 0 2\r\n"
        "f 1/1/1 2/2/1 \\\r\n 3/3/1 4/4/1\r\n"
        "f -4/-4/-1 -2/-1/-1 -1/-1/-1\n"  // position 3 with another vt: one vertex more
        "f 1 2 3",                        // no normal, no vt, and no newline at the end
        "a.OBJ");
    EXPECT_EQ(mesh->triangles.size(), 4u);
    ASSERT_EQ(mesh->positions.size(), 4u + 1 + 3);
    EXPECT_EQ(mesh->triangles[0], (Mesh::Triangle{0, 1, 2}));
    EXPECT_EQ(mesh->triangles[1], (Mesh::Triangle{0, 2, 3}));
    EXPECT_EQ(mesh->triangles[2], (Mesh::Triangle{0, 4, 3}));
    EXPECT_EQ(mesh->positions[4], (Point3f{1, 1, 0}));
    // v points up in OBJ pictures, down in ours; given normals are made unit, missing ones made.
    EXPECT_EQ(mesh->uvs[3], (Vec2f{0, 0.75f}));
    for (const Vec3f& n : mesh->normals) EXPECT_EQ(n, (Vec3f{0, 0, 1}));
    MeshOptions keep;
    keep.flip_tex_coords = false;
    EXPECT_EQ(
        parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nf 1/1 2/1 3/1\n", "a.obj", keep)->uvs[0],
        (Vec2f{0, 0.25f}));
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
    EXPECT_EQ(parse_mesh("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj")->triangles.size(), 1u);
}

TEST(Obj, TexturedFacesAfterPlainOnes) {
    const auto mesh = parse_mesh(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5 0.5\nf 1 2 3\nf 1/1 2/1 4/1\n", "a.obj");
    EXPECT_EQ(mesh->positions.size(), 6u);
    EXPECT_EQ(mesh->triangles[1], (Mesh::Triangle{3, 4, 5}));
    EXPECT_EQ(mesh->uvs[4], (Vec2f{0.5f, 0.5f}));
}

TEST(Ply, StripsQuadsAndIndexTypes) {
    const auto strip = parse_mesh(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2",
        "a.ply");
    EXPECT_EQ(strip->triangles,
              (std::vector<Mesh::Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {0, 1, 2}}));
    const char* types[] = {"char", "uchar", "short", "ushort", "int", "uint"};
    for (const char* type : types) {
        std::string s = fmt::format(
            "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty short x\nproperty char "
            "y\nproperty int z\nproperty double nx\nproperty double ny\nproperty double nz\n"
            "property float texture_u\nproperty float texture_v\nelement face 1\nproperty list {0} "
            "{0} vertex_index\nend_header\n",
            type);
        for (int i = 0; i < 4; ++i) {
            put(s, static_cast<std::int16_t>(300 * (i == 1 || i == 2)), true);
            put(s, static_cast<std::int8_t>(-(i >= 2)), true);
            put(s, std::int32_t{0}, true);
            for (const double n : {0., 0., -4.}) put(s, n, true);
            put(s, 0.5f, true), put(s, 0.25f, true);
        }
        for (const int v : {4, 0, 1, 2, 3}) {
            const std::string_view t = type;
            if (t.ends_with("char")) put(s, static_cast<std::int8_t>(v));
            if (t.ends_with("short")) put(s, static_cast<std::int16_t>(v), true);
            if (t.ends_with("int")) put(s, static_cast<std::int32_t>(v), true);
        }
        const auto quad = parse_mesh(s, "a.ply");
        EXPECT_EQ(quad->triangles, (std::vector<Mesh::Triangle>{{0, 1, 2}, {0, 2, 3}})) << type;
        EXPECT_EQ(quad->positions[2], (Point3f{300, -1, 0}));
        EXPECT_EQ(quad->normals[2], (Vec3f{0, 0, -1}));
        EXPECT_EQ(quad->uvs[2], (Vec2f{0.5f, 0.25f}));
    }
}

TEST(Off, ColoursNormalsAndTextureCoordinates) {
    const auto mesh = parse_mesh(
        "STCNOFF 4 1 0\n0 0 0 0 0 3 1 0 0 1 0.1 0.2\n1 0 0 0 0 1 255 0 0 0 0.3 0.4 # end\n"
        "1 1 0 0 0 1 1 0 0 1 0 0\n0 1 0 0 0 1 1 0 0 1 0 0\n4 0 1 2 3 255 0 0\n",
        "a.off");
    EXPECT_EQ(mesh->triangles, (std::vector<Mesh::Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(mesh->normals[0], (Vec3f{0, 0, 1}));
    EXPECT_EQ(mesh->uvs[1], (Vec2f{0.3f, 0.4f}));
    EXPECT_EQ(
        parse_mesh("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n", "a.off")
            ->triangles.size(),
        1u);
}

TEST(Stl, BinaryFileThatBeginsLikeText) {
    std::string s = tetrahedron_stl(true);
    s.replace(0, 6, "solid ");
    EXPECT_EQ(parse_mesh(s, "a.stl")->triangles.size(), 4u);
    EXPECT_EQ(parse_mesh(tetrahedron_stl(true) + "more", "a.stl")->triangles.size(), 4u);
}

TEST(Gltf, NodesMapTheirMeshes) {
    const auto moved =
        parse_mesh(tetrahedron_gltf(R"(,"translation":[1,2,3],"rotation":[0,0,0.7071067811865476,)"
                                    R"(0.7071067811865476],"scale":[2,2,-2])"),
                   "a.gltf");
    EXPECT_NEAR(length(moved->positions[1] - Point3f{1, 4, 3}), 0, 1e-6);
    EXPECT_NEAR(length(moved->positions[3] - Point3f{1, 2, 1}), 0, 1e-6);
    EXPECT_NEAR(inspect(*moved).volume, 8 / 6., 1e-6);  // mirrored, and still outside out
    const auto column_major =
        parse_mesh(tetrahedron_gltf(R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1])"), "a.gltf");
    EXPECT_EQ(column_major->positions[0], (Point3f{5, 6, 7}));
}

TEST(Gltf, StripsAndFans) {
    // The indices 0 2 1 0 1 3 0 3 2 1 2 3 as a strip and as a fan, less those that coincide.
    const auto strip = parse_mesh(tetrahedron_gltf("", "", R"(,"mode":5)"), "a.gltf");
    EXPECT_EQ(strip->triangles.size() + strip->dropped_triangles, 10u);
    EXPECT_EQ(strip->triangles[0], (Mesh::Triangle{0, 2, 1}));
    // glTF 2.0, 3.7.2.1: triangle 1 is vertices 1, 3, 2 of the strip, whose start is free.
    EXPECT_EQ(strip->triangles[1], (Mesh::Triangle{1, 2, 0}));
    const auto fan = parse_mesh(tetrahedron_gltf("", "", R"(,"mode":6)"), "a.gltf");
    EXPECT_EQ(fan->triangles.size() + fan->dropped_triangles, 10u);
    EXPECT_EQ(fan->triangles[1], (Mesh::Triangle{0, 1, 3}));
}

TEST(MeshReaders, TransformKeepsTheOutsideOutside) {
    const std::string obj =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 1 1 1\nvn -1 0 0\n"
        "f 1//2 3//2 2//2\nf 1//2 2//2 4//2\nf 1//2 4//2 3//2\nf 2//1 3//1 4//1\n";
    MeshOptions options;
    options.to_world = Transform::translate({10, 0, 0}) * Transform::scale({-2, 1, 3});
    const auto mesh = parse_mesh(obj, "a.obj", options);
    const MeshReport report = inspect(*mesh);
    EXPECT_TRUE(report.solid());
    EXPECT_NEAR(report.volume, 1, 1e-5);
    // Normals by the inverse transpose: (1,1,1) -> (-1/2, 1, 1/3), made unit.
    const Vec3f expected = normalize(Vec3f{-0.5f, 1, 1 / 3.f});
    const std::uint32_t corner = mesh->triangles[3][0];
    EXPECT_LT(length(mesh->normals[corner] - expected), 1e-6f);
}

TEST(MeshReaders, TrianglesWithoutAreaAreCounted) {
    // Twice the same index, twice the same place, a face of two corners; a merely flat one stays.
    const auto mesh = parse_mesh(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 2 4 3\nf 1 2\nf 1 2 5\n",
        "a.obj");
    EXPECT_EQ(mesh->triangles.size(), 2u);
    EXPECT_EQ(mesh->dropped_triangles, 3u);
    EXPECT_EQ(inspect(*mesh).degenerate_triangles, 4u);
}

// Counts, closedness and parts as the data set's own list states them.
TEST(MeshReaders, PublishedMeshes) {
    const std::filesystem::path folder = NACRE_SHARED_DIR "/data/mesh";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder << "; not tested";
    struct Known {
        const char* file;
        std::size_t vertices, triangles, boundary, components;
    };
    for (const Known& k :
         {Known{"armadillo_86k.obj", 43243, 86482, 0, 1}, Known{"bunny_7k.off", 3485, 6966, 0, 1},
          Known{"fertility_9k.off", 4494, 9000, 0, 1}, Known{"lucy_33k.obj", 16723, 33446, 0, 1},
          Known{"maxplanck_10k.obj", 5272, 10540, 0, 1},
          Known{"nefertiti_100k.obj", 49971, 99938, 0, 1}, Known{"spot_6k.obj", 2930, 5856, 0, 1},
          Known{"teapot_6k.obj", 3241, 6320, 160, 3}}) {
        const auto mesh = load_mesh(folder / k.file);
        const MeshReport report = inspect(*mesh);
        SCOPED_TRACE(k.file);
        EXPECT_EQ(report.vertices, k.vertices);
        EXPECT_EQ(report.triangles, k.triangles);
        EXPECT_EQ(report.boundary_edges, k.boundary);
        EXPECT_EQ(report.components, k.components);
        EXPECT_EQ(report.solid(), k.boundary == 0);
    }
    const auto obj = load_mesh(folder / "stanford_bunny_69k.obj");
    const auto ply = load_mesh(folder / "mitsuba_bunny.ply");
    for (const auto& mesh : {obj, ply}) {
        EXPECT_EQ(mesh->positions.size(), 35947u);
        EXPECT_EQ(mesh->triangles.size(), 69451u);
        EXPECT_EQ(inspect(*mesh).boundary_edges, 223u);
    }
    // The same scan in two files, text and binary.
    EXPECT_NEAR(inspect(*obj).volume, inspect(*ply).volume, 1e-8);
    // Genus 4: V - E + F = 2 - 2 * 4 with E = 3 F / 2.
    EXPECT_EQ(4494 - 9000 * 3 / 2 + 9000, 2 - 2 * 4);
}

TEST(MeshReaders, PublishedGltfAndSerialized) {
    const std::filesystem::path folder = NACRE_SHARED_DIR "/data";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder << "; not tested";
    const auto cube = load_mesh(folder / "gltf/TransmissionVolumetric.gltf");
    EXPECT_NEAR(inspect(*cube).volume, 8, 1e-4);
    EXPECT_TRUE(inspect(*cube).solid());
    EXPECT_EQ(load_mesh(folder / "gltf/shaderball.glb")->triangles.size(), 70808u + 17456u);
    for (const int shape : {0, 1, 2}) {
        MeshOptions options;
        options.shape_index = shape;
        EXPECT_GT(load_mesh(folder / "scene/mitsuba_sss/meshes/matpreview.serialized", options)
                      ->triangles.size(),
                  100u);
    }
}

}  // namespace
}  // namespace nacre
