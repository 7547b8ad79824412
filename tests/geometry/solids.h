#pragma once
// Solids of known area and volume as files of every format but glTF, for the tests of readers.
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "tests/geometry/files.h"

namespace nacre::test {

/// Faces are polygons, counter-clockwise from outside; indices from 0.
struct Solid {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::vector<std::uint32_t>> faces;
};

/// [0,1]^3: area 6, volume 1.
inline Solid unit_cube() {
    return {
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}

/// The outline, counter-clockwise, raised from z = 0 to 1: area 2 A + perimeter, volume A. The caps
/// are polygons that begin at corner `start`; `mirrored` turns the whole to z < 0 and the faces
/// round.
inline Solid prism(const std::vector<std::array<float, 2>>& outline, std::size_t start = 0,
                   bool mirrored = false) {
    const auto n = static_cast<std::uint32_t>(outline.size());
    Solid s;
    for (const float z : {0.f, mirrored ? -1.f : 1.f})
        for (const auto& [x, y] : outline) s.positions.push_back({x, y, z});
    std::vector<std::uint32_t> bottom, top;
    for (std::uint32_t i = 0; i < n; ++i) {
        bottom.push_back(n - 1 - (i + static_cast<std::uint32_t>(start)) % n);
        top.push_back(n + (i + static_cast<std::uint32_t>(start)) % n);
    }
    s.faces = {bottom, top};
    for (std::uint32_t i = 0; i < n; ++i)
        s.faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    if (mirrored)
        for (auto& f : s.faces) f = {f.rbegin(), f.rend()};
    return s;
}

/// An L of three unit squares: as a prism area 14, volume 3.
inline std::vector<std::array<float, 2>> l_shape() {
    return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
}

inline std::string solid_obj(const Solid& s, bool backwards = false) {
    std::string text;
    for (const auto& p : s.positions) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& f : s.faces) {
        text += "f";
        for (const auto i : f)
            text += backwards ? fmt::format(" {}", int(i) - int(s.positions.size()))
                              : fmt::format(" {}", i + 1);
        text += "\n";
    }
    return text;
}

inline std::string solid_off(const Solid& s) {
    std::string text = fmt::format("OFF\n{} {} 0\n", s.positions.size(), s.faces.size());
    for (const auto& p : s.positions) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    for (const auto& f : s.faces) text += fmt::format("{} {}\n", f.size(), fmt::join(f, " "));
    return text;
}

inline std::string solid_ply(const Solid& s, bool binary) {
    std::string text = fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face {}\nproperty list int int vertex_indices\nend_header\n",
        binary ? "binary_little_endian" : "ascii", s.positions.size(), s.faces.size());
    for (const auto& p : s.positions)
        if (binary)
            put(text, p[0]), put(text, p[1]), put(text, p[2]);
        else
            text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    for (const auto& f : s.faces) {
        if (!binary) text += fmt::format("{} {}\n", f.size(), fmt::join(f, " "));
        if (!binary) continue;
        put(text, static_cast<std::int32_t>(f.size()));
        for (const auto i : f) put(text, i);
    }
    return text;
}

/// Faces must be convex: they are cut as fans.
inline std::vector<std::array<std::uint32_t, 3>> fans(const Solid& s) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& f : s.faces)
        for (std::size_t i = 2; i < f.size(); ++i) triangles.push_back({f[0], f[i - 1], f[i]});
    return triangles;
}

inline std::string solid_stl(const Solid& s, bool binary) {
    const auto triangles = fans(s);
    std::string text = binary ? "solid" + std::string(75, ' ') : "solid a part\n";
    if (binary) put(text, static_cast<std::uint32_t>(triangles.size()));
    for (const auto& t : triangles) {
        if (binary) put(text, 0.f), put(text, 0.f), put(text, 0.f);
        if (!binary) text += "facet normal 0 0 0\nouter loop\n";
        for (const auto i : t) {
            const auto& p = s.positions[i];
            if (binary)
                put(text, p[0]), put(text, p[1]), put(text, p[2]);
            else
                text += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
        }
        if (binary) put(text, std::uint16_t{0x7c00});  // a colour
        if (!binary) text += "endloop\nendfacet\n";
    }
    return binary ? text : text + "endsolid a part\n";
}

/// One mesh of a .serialized file of version 3; with normals of zero if asked.
inline std::string solid_serialized(const Solid& s, bool normals = false) {
    std::string raw;
    const auto triangles = fans(s);
    put(raw, std::uint32_t{0x1000u | (normals ? 1u : 0u)});
    put(raw, static_cast<std::uint64_t>(s.positions.size()));
    put(raw, static_cast<std::uint64_t>(triangles.size()));
    for (const auto& p : s.positions)
        for (const float x : p) put(raw, x);
    if (normals) raw += std::string(s.positions.size() * 12, '\0');
    for (const auto& t : triangles)
        for (const auto i : t) put(raw, i);
    std::string file;
    put(file, std::uint16_t{0x041c}), put(file, std::uint16_t{3});
    file += packed(raw);
    put(file, std::uint32_t{0}), put(file, std::uint32_t{1});
    return file;
}

inline std::string replace_all(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

}  // namespace nacre::test
