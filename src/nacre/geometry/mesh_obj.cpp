// Wavefront OBJ: v, vt, vn and f; groups, objects and materials are merged into one mesh, all else
// is skipped. Read by our own hand: the library at hand takes the next corner's index for what is
// missing in "1//", reads words that are no numbers as 0 and does not bear ten million triangles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nacre/geometry/mesh_source.h"
#include "nacre/geometry/polygon.h"

namespace nacre {
namespace {

// Corners become vertices of the mesh: one for each position while
// no face names texture coordinates or normals, later one for each combination (v, vt, vn).
class ObjBuilder {
  public:
    ObjBuilder(const MeshSource& source, const TextLines& lines)
        : source_(source), lines_(lines), polygons_(mesh_) {}

    void face(TextLines& line) {
        corners_.clear();
        for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
            const Corner c = corner(word);
            if (!combined_ && (c.vt || c.vn)) combine();
            corners_.push_back(combined_ ? vertex_of(c) : c.v - 1);
        }
        polygons_.add(corners_);
        ++faces_;
    }

    Mesh finish() {
        check(vertex_, positions.size(), "vertex", "vertices");
        check(uv_, uvs.size(), "texture coordinate", "texture coordinates");
        check(normal_, normals.size(), "normal", "normals");
        if (!combined_) {
            mesh_.positions = std::move(positions);
            polygons_.cut();
            return std::move(mesh_);
        }
        first_of_ = {};
        const bool any_uv = uv_.largest > 0, any_normal = normal_.largest > 0;
        mesh_.positions.reserve(vertices_.size() + 1);
        if (any_uv) mesh_.uvs.reserve(vertices_.size());
        if (any_normal) mesh_.normals.reserve(vertices_.size());
        for (const Entry& e : vertices_) {
            mesh_.positions.push_back(positions[e.corner.v - 1]);
            // Missing normals stay zero and are computed later.
            if (any_uv) mesh_.uvs.push_back(e.corner.vt ? uvs[e.corner.vt - 1] : Vec2f{});
            if (any_normal)
                mesh_.normals.push_back(e.corner.vn ? normals[e.corner.vn - 1] : Vec3f{});
        }
        polygons_.cut();
        return std::move(mesh_);
    }

    std::vector<Point3f> positions;
    std::vector<Vec3f> normals;
    std::vector<Vec2f> uvs;

  private:
    struct Corner {
        std::uint32_t v = 0, vt = 0, vn = 0;  ///< from 1; 0 if absent
        bool operator==(const Corner&) const = default;
    };
    struct Entry {
        Corner corner;
        std::uint32_t next;  ///< vertex of the same position, + 1; 0 at the end of the chain
    };
    /// Largest index seen and where: an index may come before what it names, so that the check
    /// waits for the end of the file.
    struct Largest {
        std::uint32_t largest = 0;
        std::size_t line = 0;
    };

    // v, v/vt, v//vn or v/vt/vn; a part that is empty, also at the end ("1//", "1/2/" are written
    // by some programs), is absent.
    Corner corner(std::string_view word) {
        std::array<std::string_view, 3> parts;
        std::size_t count = 0;
        for (std::string_view rest = word;; ++count) {
            const std::size_t slash = rest.find('/');
            if (count == 3) fail_corner(word);
            parts[count] = rest.substr(0, slash);
            if (slash == rest.npos) break;
            rest.remove_prefix(slash + 1);
        }
        if (parts[0].empty()) fail_corner(word);
        const Corner c{resolve(parts[0], word, positions.size(), vertex_),
                       resolve(parts[1], word, uvs.size(), uv_),
                       resolve(parts[2], word, normals.size(), normal_)};
        if (c.v == 0)
            source_.fail(lines_.line(), "face names vertex 0; OBJ counts vertices from 1");
        return c;
    }

    [[noreturn]] void fail_corner(std::string_view word) const {
        source_.fail(lines_.line(),
                     fmt::format("'{}' is not a corner; write v, v/vt, v//vn or v/vt/vn", word));
    }

    // The file's numbers count from 1, or, if negative, backwards.
    std::uint32_t resolve(std::string_view part, std::string_view word, std::size_t count,
                          Largest& largest) {
        if (part.empty()) return 0;
        if (part.find_first_not_of("0123456789-+") != part.npos) fail_corner(word);
        const std::optional<std::int64_t> index = integer_in(part);
        if (!index && part.find_first_of("0123456789") == part.npos) fail_corner(word);
        // What does not fit 64 bits is out of range, too. No file of n bytes holds n vertices: this
        // bounds what an index can make us allocate.
        const std::int64_t limit = std::min<std::int64_t>(source_.bytes.size(), 0xfffffffe);
        const std::int64_t absolute = !index       ? -1
                                      : *index < 0 ? std::int64_t(count) + 1 + *index
                                                   : *index;
        if (absolute < (index && *index == 0 ? 0 : 1) || absolute > limit)
            source_.fail(lines_.line(), fmt::format("face {} (counted from 1) has index {}, but {} "
                                                    "are defined before it",
                                                    faces_ + 1, part, count));
        if (absolute > largest.largest)
            largest = {static_cast<std::uint32_t>(absolute), lines_.line()};
        return static_cast<std::uint32_t>(absolute);
    }

    void check(const Largest& l, std::size_t count, const char* one, const char* many) const {
        if (l.largest > count)
            source_.fail(l.line, fmt::format("face names {} {}, but the file has {} {}", one,
                                             l.largest, count, many));
    }

    std::uint32_t vertex_of(const Corner& corner) {
        if (corner.v >= first_of_.size()) {
            first_of_.reserve(positions.size() + 1);
            first_of_.resize(corner.v + 1, 0);
        }
        std::uint32_t* link = &first_of_[corner.v];
        for (; *link; link = &vertices_[*link - 1].next)
            if (vertices_[*link - 1].corner == corner) return *link - 1;
        const auto fresh = static_cast<std::uint32_t>(vertices_.size());
        *link = fresh + 1;
        vertices_.push_back({corner, 0});
        return fresh;
    }

    // The first face with more than positions: what came before gets vertices of its own.
    void combine() {
        combined_ = true;
        for (Mesh::Triangle& t : mesh_.triangles)
            for (std::uint32_t& v : t) v = vertex_of({v + 1, 0, 0});
        for (std::uint32_t& v : corners_) v = vertex_of({v + 1, 0, 0});
    }

    const MeshSource& source_;
    const TextLines& lines_;
    Mesh mesh_;
    PolygonList polygons_;
    bool combined_ = false;
    std::size_t faces_ = 0;
    Largest vertex_, uv_, normal_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> first_of_;  ///< by position from 1: first vertex + 1, or 0
    std::vector<Entry> vertices_;
};

/// Lines whose rest is a name, which on one family of systems may end in a backslash: it is no
/// continuation there.
bool holds_a_name(std::string_view keyword) {
    constexpr std::string_view kNames[] = {"mtllib", "usemtl", "g", "o", "usemap", "maplib"};
    return std::ranges::find(kNames, keyword) != std::end(kNames);
}

/// The next number of the line; `i` of `needed` were read before it.
float next_number(const MeshSource& source, TextLines& line, std::string_view keyword, int i,
                  int needed) {
    const std::string_view word = line.word();
    if (word.empty())
        source.fail(line.line(),
                    fmt::format("'{}' with {} numbers; it needs {}", keyword, i, needed));
    const std::optional<double> value = number_in(word);
    // Infinity that is written as a number of too many digits is left to the check of the mesh.
    const bool digits = word.find_first_not_of("0123456789+-.eE") == word.npos;
    if (!value || !digits)
        source.fail(line.line(), fmt::format("'{}' is not a finite number", word));
    return static_cast<float>(*value);
}

}  // namespace

Mesh read_obj(const MeshSource& source) {
    TextLines line(source, 0, 0);
    ObjBuilder builder(source, line);
    const auto vector = [&](std::string_view keyword) {
        Vec3f v;
        for (int i = 0; i < 3; ++i) v[i] = next_number(source, line, keyword, i, 3);
        return v;
    };
    while (line.next_line()) {
        const std::string_view keyword = line.word();
        if (holds_a_name(keyword)) continue;
        line.join_continued();
        if (keyword == "v") {
            builder.positions.push_back(vector(keyword));
        } else if (keyword == "vn") {
            builder.normals.push_back(vector(keyword));
        } else if (keyword == "vt") {  // one number is enough for a texture along a line
            const float u = next_number(source, line, keyword, 0, 1);
            const bool second = !line.line_done();
            builder.uvs.push_back({u, second ? next_number(source, line, keyword, 1, 2) : 0.f});
        } else if (keyword == "f") {
            builder.face(line);
        }
    }
    return builder.finish();
}

}  // namespace nacre
