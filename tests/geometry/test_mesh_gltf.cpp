// What glTF files from other programs hold: the situations of the readers' matrix for this format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"
#include "tests/geometry/files.h"

namespace nacre::test {
namespace {

std::string message(const std::string& bytes, const char* name = "a.gltf") {
    try {
        parse_mesh(bytes, name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

double volume(const std::string& bytes, const char* name = "a.gltf") {
    return inspect(*parse_mesh(bytes, name)).volume;
}

std::string swapped(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

std::string required(const std::string& name) {
    return tetrahedron_gltf("", R"(,"extensionsRequired":[")" + name + R"("])");
}

/// A tetrahedron whose positions are replaced in part: vertex 3 of the base lies at the origin.
std::string sparse_gltf(const std::string& accessor, const std::string& sparse_count = "1",
                        std::uint16_t replaced = 3) {
    std::string data = tetrahedron_buffer();
    const std::string apex = data.substr(36, 12);
    data.replace(36, 12, std::string(12, '\0'));
    put(data, replaced);
    put(data, std::uint16_t{0});
    data += apex;
    std::string json = tetrahedron_gltf_json(R"("uri":"data:application/octet-stream;base64,)" +
                                             base64(data) + "\",");
    json = swapped(json, R"("byteLength":72)", R"("byteLength":88)");
    json = swapped(json, R"("byteLength":24})",
                   R"("byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":2},)"
                   R"({"buffer":0,"byteOffset":76,"byteLength":12})");
    return swapped(json, R"("bufferView":0,"componentType":5126)",
                   accessor + R"("sparse":{"count":)" + sparse_count +
                       R"(,"indices":{"bufferView":2,"componentType":5123},)"
                       R"("values":{"bufferView":3}},"componentType":5126)");
}

TEST(MeshGltf, ExtensionsThatAFileNeedsAreNamed) {
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"})
        EXPECT_EQ(message(required(name)),
                  fmt::format("a.gltf: needs {}; export it without compression", name));
    EXPECT_EQ(message(required("EXT_mesh_gpu_instancing")),
              "a.gltf: needs EXT_mesh_gpu_instancing, which is not read; export every copy as a "
              "node of its own");
    EXPECT_EQ(message(required("ACME_shapes")),
              "a.gltf: needs ACME_shapes, which is not read; export it without");
    for (const char* name : {"KHR_mesh_quantization", "KHR_materials_volume"})
        EXPECT_EQ(message(required(name)), "");
}

TEST(MeshGltf, CompressedFilesAreNotCalledInvalid) {
    // What compressed files lack makes the library fail before it looks at extensions.
    const std::string no_view =
        swapped(required("KHR_draco_mesh_compression"), R"("bufferView":1,"componentType":5123)",
                R"("componentType":5123)");
    EXPECT_EQ(message(no_view),
              "a.gltf: needs KHR_draco_mesh_compression; export it without compression");
    const std::string optional = swapped(
        tetrahedron_gltf("", R"(,"extensionsUsed":["KHR_draco_mesh_compression"])",
                         R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})"),
        R"("bufferView":0,"componentType":5126)", R"("componentType":5126)");
    EXPECT_EQ(message(optional),
              "a.gltf: needs KHR_draco_mesh_compression; export it without compression");
    const std::string fallback =
        tetrahedron_gltf_json(R"("extensions":{"EXT_meshopt_compression":{"fallback":true}},)");
    EXPECT_EQ(message(fallback),
              "a.gltf: needs EXT_meshopt_compression; export it without compression");
    // With the data to fall back on the extension may be ignored.
    EXPECT_EQ(message(tetrahedron_gltf(
                  "", R"(,"extensionsUsed":["KHR_draco_mesh_compression"])",
                  R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})")),
              "");
}

TEST(MeshGltf, InstancesAreNeverLostInSilence) {
    EXPECT_EQ(message(tetrahedron_gltf(
                  R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}})",
                  R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"])")),
              "a.gltf: node 0 is placed many times by EXT_mesh_gpu_instancing, which is not read; "
              "export every copy as a node of its own");
}

TEST(MeshGltf, MarksAndLineEndsDoNotMatter) {
    const std::string good = tetrahedron_gltf();
    const double v = volume(good);
    EXPECT_GT(v, 0);
    EXPECT_EQ(volume("\xef\xbb\xbf" + good), v);
    EXPECT_EQ(volume(swapped(good, R"(,"nodes")", ",\r\n\"nodes\"")), v);
    EXPECT_EQ(volume(tetrahedron_glb(), "a.glb"), v);
    EXPECT_EQ(volume(tetrahedron_glb(), "a.gltf"), v);
}

TEST(MeshGltf, SparseAccessors) {
    const double v = volume(tetrahedron_gltf());
    EXPECT_EQ(volume(sparse_gltf(R"("bufferView":0,)")), v);
    // Without a buffer view everything else is zero: the base is gone, and three faces with it.
    EXPECT_EQ(message(sparse_gltf("")),
              "a.gltf: has no area: two corners coincide in each of its 4 triangles; check the "
              "export scale");
    EXPECT_EQ(message(sparse_gltf(R"("bufferView":0,)", "1", 4)),
              "a.gltf: accessor 0 (POSITION) replaces element 4, but it has 4 (counted from 0); "
              "export it again");
    EXPECT_EQ(message(sparse_gltf(R"("bufferView":0,)", "5")),
              "a.gltf: accessor 0 (POSITION) replaces 5 of its 4 elements; export it again");
    EXPECT_EQ(message(sparse_gltf(R"("bufferView":0,)", "2")),
              "a.gltf: accessor 0 (POSITION) wants 2 elements of 2 bytes, but its buffer view "
              "holds 2 bytes of a buffer of 88; export it again");
    EXPECT_EQ(message(swapped(sparse_gltf(""), R"("count":4)", R"("count":4000000000)")),
              "a.gltf: accessor 0 (POSITION) wants 4000000000 elements that no buffer holds; "
              "export it again");
}

TEST(MeshGltf, MirroredNodesKeepTheirOutside) {
    const double v = volume(tetrahedron_gltf());
    EXPECT_NEAR(volume(tetrahedron_gltf(R"(,"scale":[-1,1,1])")), v, 1e-6 * v);
    EXPECT_NEAR(volume(tetrahedron_gltf(R"(,"scale":[-1,-2,-1])")), 2 * v, 1e-6 * v);
    EXPECT_NEAR(volume(tetrahedron_gltf(R"(,"matrix":[1,0,0,0,0,-2,0,0,0,0,1,0,3,4,5,1])")), 2 * v,
                1e-5 * v);
}

TEST(MeshGltf, CountsThatWrapAreRefused) {
    const std::string good = tetrahedron_gltf();
    // 4 + 2^32 elements; a length and an offset whose sum is a small number in 32 and 64 bits.
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {R"("count":4)", R"("count":4294967300)"},
             {R"("count":12)", R"("count":4294967308)"},
             {R"("byteOffset":48)", R"("byteOffset":4294967344)"},
             {R"("byteLength":48)", R"("byteLength":4294967344)"},
             {R"("byteOffset":48)", R"("byteOffset":18446744073709551615)"},
             {R"("bufferView":1)", R"("bufferView":4294967297)"},
             {R"("indices":1)", R"("indices":4294967297)"},
             {R"("POSITION":0)", R"("POSITION":4294967296)"},
             {R"("mesh":0)", R"("mesh":4294967296)"}})
        EXPECT_NE(message(swapped(good, from, to)), "") << to;
}

TEST(MeshGltf, ContainersThatDoNotFit) {
    const std::string good = tetrahedron_glb();
    for (std::size_t n = 4; n < good.size(); ++n)
        EXPECT_NE(message(good.substr(0, n), "a.glb"), "") << n;
    std::string version = good, chunk = good;
    version[4] = 1;
    EXPECT_EQ(message(version, "a.glb"), "a.glb: is glTF of version 1; nacre reads 2.0");
    chunk[15] = '\x7f';
    EXPECT_TRUE(message(chunk, "a.glb").starts_with("a.glb: is damaged: its first chunk is not "))
        << message(chunk, "a.glb");
}

TEST(MeshGltf, MaterialsAreListedWithEveryProperty) {
    const std::string file = tetrahedron_gltf(
        "",
        R"(,"extensionsUsed":["KHR_materials_volume"],"materials":[{"name":"wax",)"
        R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"metallicFactor":0},)"
        R"("alphaMode":"MASK","doubleSided":true,"emissiveFactor":[1,0,0],)"
        R"("extensions":{"KHR_materials_volume":{"attenuationDistance":2,)"
        R"("attenuationColor":[1,0.5,0.5]}}},{}])",
        R"(,"material":0)");
    const GltfObject summary = parse_gltf_object(file, "a.gltf");
    ASSERT_EQ(summary.materials.size(), 2u);
    EXPECT_EQ(summary.extensions_used, std::vector<std::string>{"KHR_materials_volume"});
    EXPECT_EQ(summary.materials[0].name, "wax");
    EXPECT_TRUE(summary.materials[0].used);
    EXPECT_EQ(summary.materials[0].properties,
              (std::vector<std::string>{
                  "baseColorFactor 1, 0.5, 0.25, 1", "metallicFactor 0", "roughnessFactor 1",
                  "emissiveFactor 1, 0, 0", "alphaMode MASK at 0.5", "doubleSided",
                  "KHR_materials_volume: attenuationColor 1, 0.5, 0.5; attenuationDistance 2"}));
    EXPECT_EQ(summary.materials[1].name, "material 1");
    EXPECT_FALSE(summary.materials[1].used);
}

}  // namespace
}  // namespace nacre::test
