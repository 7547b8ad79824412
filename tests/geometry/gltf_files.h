#pragma once
// A square of two triangles as glTF, each triangle with a material of its own.
#include <string>

#include "tests/geometry/files.h"

namespace nacre::test {

/// The unit square at z = 0, normals +z, TEXCOORD_0 = (x, y), TEXCOORD_1 = (y, x). `second` is the
/// material of the triangle below the diagonal, `first` that of the one above, as members of their
/// primitives; `rest` are more top-level members ("materials", ...), each with a comma in front.
inline std::string square_gltf(const std::string& rest,
                               const std::string& first = R"("material":0)",
                               const std::string& second = R"("material":0)",
                               const std::string& node = "") {
    std::string data;
    constexpr float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const auto& c : corners) {
        put(data, c[0]), put(data, c[1]), put(data, 0.f);
    }
    for (int i = 0; i < 4; ++i) put(data, 0.f), put(data, 0.f), put(data, 1.f);
    for (const auto& c : corners) put(data, c[0]), put(data, c[1]);
    for (const auto& c : corners) put(data, c[1]), put(data, c[0]);
    for (const int i : {0, 2, 3, 0, 1, 2}) put(data, static_cast<std::uint16_t>(i));
    const auto primitive = [](int indices, const std::string& more) {
        return R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TEXCOORD_1":3},"indices":)" +
               std::to_string(indices) + (more.empty() ? "" : "," + more) + "}";
    };
    const auto view = [](int offset, int length) {
        return R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
               std::to_string(length) + "}";
    };
    const auto accessor = [](int view_index, int offset, int component, int count,
                             const char* type) {
        return R"({"bufferView":)" + std::to_string(view_index) + R"(,"byteOffset":)" +
               std::to_string(offset) + R"(,"componentType":)" + std::to_string(component) +
               R"(,"count":)" + std::to_string(count) + R"(,"type":")" + type + "\"}";
    };
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
           node + R"(}],"meshes":[{"primitives":[)" + primitive(4, first) + "," +
           primitive(5, second) +
           R"(]}],"buffers":[{"uri":"data:application/octet-stream;base64,)" + base64(data) +
           R"(","byteLength":)" + std::to_string(data.size()) + R"(}],"bufferViews":[)" +
           view(0, 48) + "," + view(48, 48) + "," + view(96, 32) + "," + view(128, 32) + "," +
           view(160, 12) + R"(],"accessors":[)" + accessor(0, 0, 5126, 4, "VEC3") + "," +
           accessor(1, 0, 5126, 4, "VEC3") + "," + accessor(2, 0, 5126, 4, "VEC2") + "," +
           accessor(3, 0, 5126, 4, "VEC2") + "," + accessor(4, 0, 5123, 3, "SCALAR") + "," +
           accessor(4, 6, 5123, 3, "SCALAR") + "]" + rest + "}";
}

}  // namespace nacre::test
