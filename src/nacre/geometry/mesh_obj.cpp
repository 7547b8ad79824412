// Wavefront OBJ (Wavefront Technologies 1992, The Advanced Visualizer, appendix B1): vertices,
// texture coordinates, normals and faces, one pass over the text and no copy of it; a mesh of ten
// million triangles bears little more. Materials, groups, points, lines and curves are passed over.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "nacre/geometry/mesh_polygon.h"
#include "nacre/geometry/mesh_source.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

// Statements and their words. Statements of numbers go on behind a backslash at the end of the
// line; names and comments end with their line, as paths of Windows may end in a backslash.
class ObjLines {
  public:
    explicit ObjLines(const MeshSource& source) : source_(source), text_(source, 0, 0) {}

    /// Goes to the next statement and hands over its keyword; false at the end of the file.
    bool next(std::string_view& keyword) {
        continues_ = false;
        if (!text_.next_line()) return false;
        keyword = text_.word();
        return true;
    }
    std::size_t line() const { return text_.line(); }

    std::string_view word() {
        for (;;) {
            if (std::exchange(continues_, false) && !text_.following_line()) return {};
            std::string_view word = text_.word();
            if (!word.ends_with('\\') || !text_.line_done()) return word;
            continues_ = true;
            word.remove_suffix(1);
            if (!word.empty()) return word;
        }
    }

    /// `least` to `most` numbers, which all must be finite; what follows them is passed over.
    template <std::size_t N>
    std::array<float, N> numbers(std::string_view keyword, std::size_t least) {
        std::array<float, N> values{};
        for (std::size_t i = 0; i < N; ++i) {
            const std::string_view word = this->word();
            if (word.empty()) {
                if (i >= least) break;
                source_.fail(line(),
                             fmt::format("'{}' with {} numbers; it needs {}", keyword, i, least));
            }
            const auto value = parse_number(word);
            if (!value || !std::isfinite(*value))
                source_.fail(line(), fmt::format("'{}' is not a finite number", word));
            values[i] = static_cast<float>(*value);
        }
        return values;
    }

  private:
    const MeshSource& source_;
    TextLines text_;
    bool continues_ = false;
};

// Makes the mesh. Corners become vertices: one for each position while no face names texture
// coordinates or normals, later one for each combination (v, vt, vn).
class ObjReader {
  public:
    explicit ObjReader(const MeshSource& source) : source_(source), lines_(source) {}

    Mesh read() {
        std::string_view keyword;
        while (lines_.next(keyword)) {
            if (keyword == "v") {
                const auto [x, y, z] = lines_.numbers<3>(keyword, 3);
                positions_.emplace_back(x, y, z);
            } else if (keyword == "vn") {
                const auto [x, y, z] = lines_.numbers<3>(keyword, 3);
                normals_.emplace_back(x, y, z);
            } else if (keyword == "vt") {  // may be one number only
                const auto [u, v] = lines_.numbers<2>(keyword, 1);
                uvs_.push_back({u, v});
            } else if (keyword == "f") {
                face();
            } else if (keyword == "surf" || keyword == "call") {
                source_.fail(lines_.line(),
                             keyword == "surf"
                                 ? "free-form surfaces are not read; convert them to polygons "
                                   "before the export"
                                 : "'call' takes in another file, which is not done; export the "
                                   "mesh into one file");
            }
        }
        return finish();
    }

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

    void face() {
        corners_.clear();
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
            const Corner c = corner(word);
            if (!combined_ && (c.vt || c.vn)) combine();
            corners_.push_back(combined_ ? vertex_of(c) : c.v - 1);
        }
        polygons_.add(mesh_, corners_);
        ++faces_;
    }

    // v, v/vt, v//vn or v/vt/vn; what is left empty, as in v// and v/vt/, is absent.
    Corner corner(std::string_view word) {
        std::string_view parts[3], rest = word;
        for (int i = 0; i < 3; ++i) {
            const std::size_t slash = i < 2 ? rest.find('/') : rest.npos;
            parts[i] = rest.substr(0, slash);
            rest.remove_prefix(std::min(parts[i].size() + 1, rest.size()));
        }
        if (parts[0].empty()) not_a_corner(word);
        const Corner c{index(word, parts[0], positions_.size(), vertex_),
                       index(word, parts[1], uvs_.size(), uv_),
                       index(word, parts[2], normals_.size(), normal_)};
        if (c.v == 0)
            source_.fail(lines_.line(), "face names vertex 0; OBJ counts vertices from 1");
        return c;
    }

    [[noreturn]] void not_a_corner(std::string_view word) const {
        source_.fail(lines_.line(),
                     fmt::format("'{}' is not a corner; write v, v/vt, v//vn or v/vt/vn", word));
    }

    // Numbers of the file run from 1, or are negative and count backwards.
    std::uint32_t index(std::string_view word, std::string_view part, std::size_t count,
                        Largest& largest) {
        if (part.empty()) return 0;
        if (part.starts_with('+') && !part.starts_with("+-")) part.remove_prefix(1);
        std::int64_t number = 0;
        const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (stop != part.data() + part.size() || error == std::errc::invalid_argument)
            not_a_corner(word);
        const std::int64_t absolute =
            number < 0 ? static_cast<std::int64_t>(count) + number + 1 : number;
        // No file of n bytes holds n vertices: this bounds what an index can make us allocate.
        const auto most = std::min<std::int64_t>(source_.bytes.size(), 0xfffffffe);
        if (error != std::errc{} || (number < 0 && absolute < 1) || absolute > most)
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

    Mesh finish() {
        check(vertex_, positions_.size(), "vertex", "vertices");
        check(uv_, uvs_.size(), "texture coordinate", "texture coordinates");
        check(normal_, normals_.size(), "normal", "normals");
        if (combined_)
            gather();
        else
            mesh_.positions = std::move(positions_);
        polygons_.cut_concave(mesh_);
        return std::move(mesh_);
    }

    void gather() {
        first_of_ = {};
        const bool any_uv = uv_.largest > 0, any_normal = normal_.largest > 0;
        mesh_.positions.reserve(vertices_.size() + 1);
        if (any_uv) mesh_.uvs.reserve(vertices_.size());
        if (any_normal) mesh_.normals.reserve(vertices_.size());
        for (const Entry& e : vertices_) {
            mesh_.positions.push_back(positions_[e.corner.v - 1]);
            // Missing normals stay zero and are computed later.
            if (any_uv) mesh_.uvs.push_back(e.corner.vt ? uvs_[e.corner.vt - 1] : Vec2f{});
            if (any_normal)
                mesh_.normals.push_back(e.corner.vn ? normals_[e.corner.vn - 1] : Vec3f{});
        }
    }

    std::uint32_t vertex_of(const Corner& corner) {
        if (corner.v >= first_of_.size()) {
            first_of_.reserve(positions_.size() + 1);
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
    ObjLines lines_;
    Mesh mesh_;
    Polygons polygons_;
    bool combined_ = false;
    std::size_t faces_ = 0;
    Largest vertex_, uv_, normal_;
    std::vector<Point3f> positions_;
    std::vector<Vec3f> normals_;
    std::vector<Vec2f> uvs_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> first_of_;  ///< by position from 1: first vertex + 1, or 0
    std::vector<Entry> vertices_;
};

}  // namespace

Mesh read_obj(const MeshSource& source) { return ObjReader(source).read(); }

}  // namespace nacre
