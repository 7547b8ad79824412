// Geomview's object file format as text: header [ST][C][N]OFF, counts of vertices, faces and edges,
// then a vertex a line (position, normal, colour, texture coordinates) and a face a line (count,
// vertex indices from 0, colour). http://www.geomview.org/docs/html/OFF.html
#include <fmt/format.h>

#include "nacre/geometry/mesh_polygon.h"
#include "nacre/geometry/mesh_source.h"

namespace nacre {
namespace {

struct Header {
    bool normals = false, uvs = false;
    std::int64_t vertices = 0, faces = 0;
};

Header read_header(const MeshSource& source, TextLines& text) {
    if (!text.next_line()) source.fail("is empty; an OFF file begins with 'OFF'");
    const std::string_view keyword = text.word();
    const std::size_t off = keyword.find("OFF");
    // ModelNet's files have the first count right behind the keyword: OFF490 518 0.
    std::string_view first = off == keyword.npos ? "" : keyword.substr(off + 3);
    if (off == keyword.npos)
        source.fail(text.line(), fmt::format("begins with '{}'; an OFF file begins with 'OFF'",
                                             keyword.substr(0, 20)));
    std::string_view flags = keyword.substr(0, off);
    Header header;
    if (flags.starts_with("ST")) header.uvs = true, flags.remove_prefix(2);
    if (flags.starts_with('C')) flags.remove_prefix(1);
    if (flags.starts_with('N')) header.normals = true, flags.remove_prefix(1);
    const bool count_follows = first.empty() || (first[0] >= '0' && first[0] <= '9');
    if (flags == "4" || flags == "n" || flags == "4n")
        source.fail(text.line(), fmt::format("'{}' has coordinates in other than three dimensions; "
                                             "save it as plain OFF",
                                             keyword.substr(0, 20)));
    if (!flags.empty() || !count_follows)
        source.fail(text.line(), fmt::format("'{}' is not a header of OFF, which is written "
                                             "[ST][C][N]OFF; save it as plain OFF",
                                             keyword.substr(0, 20)));
    if (first.empty()) first = text.any_word();
    if (first == "BINARY")
        source.fail(text.line(), "binary OFF is not read; save it as text, or as PLY");
    header.vertices = text.to_integer(first, "the number of vertices");
    header.faces = text.to_integer(text.any_word(), "the number of faces");
    if (header.vertices < 0 || header.faces < 0 || header.vertices > 0xffffffffll)
        source.fail(text.line(), fmt::format("{} vertices and {} faces cannot be; check the header",
                                             header.vertices, header.faces));
    // Each vertex takes at least three digits and three blanks, each face two.
    const auto left = static_cast<std::int64_t>(text.remaining()) + 1;
    if (header.vertices > left / 6 || header.faces > left / 2)
        source.fail(
            fmt::format("is truncated: its header promises {} vertices and {} faces, but "
                        "only {} bytes follow; export it again",
                        header.vertices, header.faces, left - 1));
    return header;
}

}  // namespace

Mesh read_off(const MeshSource& source) {
    TextLines text(source, 0, 0);
    const Header header = read_header(source, text);
    Mesh mesh;
    mesh.positions.reserve(header.vertices + 1);
    mesh.triangles.reserve(header.faces);
    std::vector<std::string_view> words;
    for (std::int64_t i = 0; i < header.vertices; ++i) {
        if (!text.next_line())
            source.fail(fmt::format("is truncated: {} of {} vertices; export it again", i,
                                    header.vertices));
        const auto vector = [&](const char* what) {
            const double x = text.number(what), y = text.number(what), z = text.number(what);
            return Vec3f(Vec3d{x, y, z});
        };
        mesh.positions.push_back(vector("a coordinate"));
        if (header.normals) mesh.normals.push_back(vector("a normal"));
        if (!header.uvs) continue;  // the rest of the line is colour
        words.clear();
        for (std::string_view w = text.word(); !w.empty(); w = text.word()) words.push_back(w);
        if (words.size() < 2)
            source.fail(text.line(), "a texture coordinate is missing; the line is too short");
        mesh.uvs.push_back(
            {static_cast<float>(text.to_number(words[words.size() - 2], "a texture coordinate")),
             static_cast<float>(text.to_number(words.back(), "a texture coordinate"))});
    }
    Polygons polygons;
    std::vector<std::uint32_t> corners;
    for (std::int64_t i = 0; i < header.faces; ++i) {
        if (!text.next_line())
            source.fail(
                fmt::format("is truncated: {} of {} faces; export it again", i, header.faces));
        const std::int64_t count = text.to_integer(text.word(), "the number of corners");
        if (count < 0) source.fail(text.line(), fmt::format("face {} has {} corners", i, count));
        corners.clear();
        for (std::int64_t c = 0; c < count; ++c) {
            const std::int64_t index = text.to_integer(text.word(), "a vertex index");
            if (index < 0 || index >= header.vertices)
                source.fail(text.line(),
                            fmt::format("face {} names vertex {}, but vertices run from 0 to {}", i,
                                        index, header.vertices - 1));
            corners.push_back(static_cast<std::uint32_t>(index));
        }
        polygons.add(mesh, corners);
    }
    polygons.cut_concave(mesh);
    return mesh;
}

}  // namespace nacre
