#pragma once
// Files that the reader tests make themselves: one mesh, a tetrahedron, in every format.
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace nacre::test {

/// Appends the bytes of a value, reversed if asked (big-endian files).
template <class T>
void put(std::string& to, T value, bool reversed = false) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (reversed) std::reverse(raw, raw + sizeof(T));
    to.append(raw, sizeof(T));
}

inline const float kTetrahedron[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::uint32_t kTetrahedronFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline std::string tetrahedron_obj() {
    std::string s = "# a comment\nmtllib nowhere.mtl\no tetra\n";
    for (const auto& p : kTetrahedron) s += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    s += "g sides\nusemtl red\ns off\n";
    for (const auto& f : kTetrahedronFaces)
        s += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    return s;
}

inline std::string tetrahedron_off() {
    std::string s = "OFF\n# a comment\n4 4 6\n\n";
    for (const auto& p : kTetrahedron) s += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    for (const auto& f : kTetrahedronFaces) s += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
    return s;
}

inline std::string tetrahedron_stl(bool binary) {
    std::string s = binary ? std::string(80, 's') : "solid tetra # 1\n";
    if (binary) put(s, std::uint32_t{4});
    for (const auto& f : kTetrahedronFaces) {
        if (binary) {
            for (int i = 0; i < 3; ++i) put(s, 0.f);
            for (const auto v : f)
                for (const float x : kTetrahedron[v]) put(s, x);
            put(s, std::uint16_t{0});
        } else {
            s += " facet normal 0 0 0\n  outer loop\n";
            for (const auto v : f)
                s += fmt::format("   vertex {} {} {}\n", kTetrahedron[v][0], kTetrahedron[v][1],
                                 kTetrahedron[v][2]);
            s += "  endloop\n endfacet\n";
        }
    }
    return binary ? s : s + "endsolid tetra\n";
}

enum class PlyFormat { Text, LittleEndian, BigEndian };

/// A tetrahedron with properties that no mesh needs, between those that it does.
inline std::string tetrahedron_ply(PlyFormat format) {
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string s = fmt::format(
        "ply\nformat {} 1.0\ncomment made by hand\nobj_info none\n"
        "element material 1\nproperty uchar red\nproperty list uchar short tags\n"
        "element vertex 4\nproperty double x\nproperty uchar confidence\nproperty float y\n"
        "property list uchar uint marks\nproperty float32 z\nproperty float s\nproperty float t\n"
        "element face 4\nproperty int group\nproperty list ushort uint vertex_indices\n"
        "property list int8 float32 weights\nend_header\n",
        names[static_cast<int>(format)]);
    const auto number = [&](auto value) {
        if (format == PlyFormat::Text)
            s += fmt::format("{} ", +value);
        else
            put(s, value, format == PlyFormat::BigEndian);
    };
    const auto line = [&] {
        if (format == PlyFormat::Text) s += "\n";
    };
    number(std::uint8_t{200}), number(std::uint8_t{2}), number(std::int16_t{-1});
    number(std::int16_t{7}), line();
    for (const auto& p : kTetrahedron) {
        number(double(p[0])), number(std::uint8_t{9}), number(p[1]), number(std::uint8_t{1});
        number(std::uint32_t{77}), number(p[2]), number(p[0]), number(p[1]), line();
    }
    for (const auto& f : kTetrahedronFaces) {
        number(std::int32_t{5}), number(std::uint16_t{3});
        for (const auto v : f) number(v);
        number(std::int8_t{1}), number(0.5f), line();
    }
    return s;
}

inline std::string packed(const std::string& raw) {
    uLongf size = compressBound(raw.size());
    std::string out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size,
             reinterpret_cast<const Bytef*>(raw.data()), raw.size());
    out.resize(size);
    return out;
}

/// Content of a .serialized file: two meshes, a single triangle and the tetrahedron.
inline std::string tetrahedron_serialized(int version, bool in_double) {
    std::string file;
    std::vector<std::uint64_t> offsets;
    for (const int faces : {1, 4}) {
        std::string raw;
        put(raw, std::uint32_t{(in_double ? 0x2000u : 0x1000u) | 0x2u | 0x8u});
        if (version == 4) raw += std::string("name\0", 5);
        put(raw, std::uint64_t{4});
        put(raw, std::uint64_t(faces));
        const auto number = [&](float x) { in_double ? put(raw, double(x)) : put(raw, x); };
        for (const auto& p : kTetrahedron)
            for (const float x : p) number(x);
        for (const auto& p : kTetrahedron) number(p[0]), number(p[1]);
        for (int i = 0; i < 12; ++i) number(0.25f);  // colours
        for (int f = 0; f < faces; ++f)
            for (const auto v : kTetrahedronFaces[f]) put(raw, v);
        offsets.push_back(file.size());
        put(file, std::uint16_t{0x041c});
        put(file, static_cast<std::uint16_t>(version));
        file += packed(raw);
    }
    for (const std::uint64_t offset : offsets)
        version == 4 ? put(file, offset) : put(file, static_cast<std::uint32_t>(offset));
    put(file, std::uint32_t{2});
    return file;
}

inline std::string base64(const std::string& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t v = 0;
        for (std::size_t k = 0; k < 3; ++k)
            v = v << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[v >> (18 - 6 * k) & 63];
    }
    return out;
}

inline std::string tetrahedron_buffer() {
    std::string data;
    for (const auto& p : kTetrahedron)
        for (const float x : p) put(data, x);
    for (const auto& f : kTetrahedronFaces)
        for (const auto v : f) put(data, static_cast<std::uint16_t>(v));
    return data;
}

/// JSON of a glTF file; `buffer` is the buffer's "uri" member with a comma behind it, or empty for
/// GLB; `extra` more top-level members.
inline std::string tetrahedron_gltf_json(const std::string& buffer, const std::string& node = "",
                                         const std::string& extra = "",
                                         const std::string& primitive = "") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
           R"("nodes":[{"mesh":0)" +
           node + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" +
           primitive + R"(}]}],"buffers":[{)" + buffer +
           R"("byteLength":72}],"bufferViews":[{"buffer":0,"byteLength":48},)"
           R"({"buffer":0,"byteOffset":48,"byteLength":24}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}])" +
           extra + "}";
}

inline std::string tetrahedron_gltf(const std::string& node = "", const std::string& extra = "",
                                    const std::string& primitive = "") {
    return tetrahedron_gltf_json(
        R"("uri":"data:application/octet-stream;base64,)" + base64(tetrahedron_buffer()) + "\",",
        node, extra, primitive);
}

inline std::string tetrahedron_glb() {
    std::string json = tetrahedron_gltf_json("");
    while (json.size() % 4) json += ' ';
    const std::string data = tetrahedron_buffer();
    std::string file = "glTF";
    put(file, std::uint32_t{2});
    put(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
    put(file, static_cast<std::uint32_t>(json.size()));
    file += "JSON" + json;
    put(file, static_cast<std::uint32_t>(data.size()));
    file += std::string("BIN\0", 4) + data;
    return file;
}

/// Every valid file with the name that selects its reader.
inline std::vector<std::pair<std::string, std::string>> tetrahedron_files() {
    return {{"t.obj", tetrahedron_obj()},
            {"t.off", tetrahedron_off()},
            {"text.stl", tetrahedron_stl(false)},
            {"binary.STL", tetrahedron_stl(true)},
            {"text.ply", tetrahedron_ply(PlyFormat::Text)},
            {"little.ply", tetrahedron_ply(PlyFormat::LittleEndian)},
            {"big.Ply", tetrahedron_ply(PlyFormat::BigEndian)},
            {"v3.serialized", tetrahedron_serialized(3, false)},
            {"v4.serialized", tetrahedron_serialized(4, false)},
            {"double.serialized", tetrahedron_serialized(4, true)},
            {"t.gltf", tetrahedron_gltf()},
            {"t.glb", tetrahedron_glb()}};
}

}  // namespace nacre::test
