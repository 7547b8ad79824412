// Stereolithography files: triangles without connection, as text ("solid ... facet ... vertex") or
// binary (80 bytes of anything, a count, 50 bytes a triangle; little-endian). Vertices at exactly
// the same place are welded; the facet normals, which follow from the corners, are not read.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "nacre/geometry/mesh_source.h"
#include "nacre/geometry/weld.h"

namespace nacre {
namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

bool same_word(std::string_view a, std::string_view lower) {
    if (a.size() != lower.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if ((a[i] | 0x20) != lower[i]) return false;
    return true;
}

Vec3f checked(const MeshSource& source, std::size_t line, std::size_t triangle, const Vec3f& p) {
    if (!std::isfinite(p.x + p.y + p.z))
        source.fail_at(line, fmt::format("triangle {} (counted from 0) has a corner at ({}, {}, "
                                         "{}); coordinates must be finite",
                                         triangle, p.x, p.y, p.z));
    return p;
}

// Binary files may begin with "solid", too, but hold control characters: the last byte of the
// number of triangles is one of them in any file below 16 GB.
bool is_text(std::string_view bytes) {
    const std::string_view start = bytes.substr(0, 512);
    if (std::any_of(start.begin(), start.end(),
                    [](unsigned char c) { return c < ' ' && !is_blank(static_cast<char>(c)); }))
        return false;
    LineSplitter lines(bytes);
    for (std::string_view line; lines.next(line);) {
        line = without_comment(line);
        const std::string_view word = take_word(line);
        if (!word.empty()) return same_word(word.substr(0, 5), "solid");
    }
    return false;
}

Mesh read_text(const MeshSource& source) {
    TextLines text(source, 0, 0);
    Mesh mesh;
    Welder welder;
    const auto expect = [&](std::initializer_list<std::string_view> words) {
        for (const std::string_view wanted : words)
            if (const std::string_view found = text.any_word(); !same_word(found, wanted))
                source.fail(text.line(), found.empty()
                                             ? fmt::format("the file ends where '{}' should stand; "
                                                           "export it again",
                                                           wanted)
                                             : fmt::format("'{}' stands where '{}' should; is this "
                                                           "an STL file?",
                                                           found, wanted));
    };
    for (std::string_view w = text.any_word(); !w.empty(); w = text.any_word()) {
        if (same_word(w, "solid") || same_word(w, "endsolid")) {
            while (!text.word().empty()) {  // the rest of the line is a name
            }
            continue;
        }
        if (!same_word(w, "facet"))
            source.fail(text.line(),
                        fmt::format("'{}' stands where 'facet' should; is this an STL file?", w));
        expect({"normal"});
        for (int i = 0; i < 3; ++i) text.any_word();
        expect({"outer", "loop"});
        Mesh::Triangle t;
        for (std::uint32_t& corner : t) {
            expect({"vertex"});
            const double x = text.to_number(text.any_word(), "a coordinate");
            const double y = text.to_number(text.any_word(), "a coordinate");
            const double z = text.to_number(text.any_word(), "a coordinate");
            corner = welder.insert(
                checked(source, text.line(), mesh.triangles.size(), Vec3f(Vec3d{x, y, z})));
        }
        expect({"endloop", "endfacet"});
        mesh.triangles.push_back(t);
    }
    mesh.positions = std::move(welder.points);
    return mesh;
}

Mesh read_binary(const MeshSource& source, std::size_t count) {
    Mesh mesh;
    Welder welder;
    mesh.triangles.reserve(count);
    const char* at = source.bytes.data() + kHeaderBytes;
    for (std::size_t i = 0; i < count; ++i, at += kTriangleBytes) {
        std::array<Vec3f, 4> vectors;  // the normal and three corners
        static_assert(sizeof vectors == 48);
        std::memcpy(vectors.data(), at, sizeof vectors);
        Mesh::Triangle t;
        for (int c = 0; c < 3; ++c) t[c] = welder.insert(checked(source, 0, i, vectors[c + 1]));
        mesh.triangles.push_back(t);
    }
    mesh.positions = std::move(welder.points);
    return mesh;
}

}  // namespace

Mesh read_stl(const MeshSource& source) {
    const std::string_view bytes = source.bytes;
    std::size_t count = 0;
    if (bytes.size() >= kHeaderBytes) {
        std::uint32_t n;
        std::memcpy(&n, bytes.data() + 80, sizeof n);
        count = n;
        // Binary files may begin with "solid", too: the size decides.
        if (bytes.size() == kHeaderBytes + count * kTriangleBytes)
            return read_binary(source, count);
    }
    if (is_text(bytes)) return read_text(source);
    if (bytes.size() < kHeaderBytes)
        source.fail(fmt::format(
            "is neither text STL, which begins with 'solid', nor binary STL, whose header alone "
            "takes 84 bytes: it has {}",
            bytes.size()));
    if (bytes.size() < kHeaderBytes + count * kTriangleBytes)
        source.fail(
            fmt::format("is truncated: its header promises {} triangles ({} bytes), but it "
                        "has {} bytes; export it again",
                        count, kHeaderBytes + count * kTriangleBytes, bytes.size()));
    if (count == 0 && bytes.size() >= kHeaderBytes + kTriangleBytes)
        source.fail(
            fmt::format("promises 0 triangles in its header, but {} bytes follow it; export "
                        "it again",
                        bytes.size() - kHeaderBytes));
    return read_binary(source, count);  // something after the triangles does no harm
}

}  // namespace nacre
