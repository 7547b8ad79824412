// Wavefront OBJ through tinyobjloader's callbacks: its ordinary interface keeps several copies of
// all faces, which a mesh of ten million triangles does not bear.
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <istream>
#include <limits>
#include <streambuf>

#include "nacre/geometry/mesh_source.h"

namespace nacre {
namespace {

constexpr std::string_view kBlank = " \t\r";

// Hands the file to the parser line by line, so that callbacks know the line they are called for;
// joins lines that end in a backslash; refuses words that are no numbers, which the parser would
// silently read as zero.
class ObjLines : public std::streambuf {
  public:
    explicit ObjLines(const MeshSource& source) : source_(source) {}
    std::size_t line() const { return line_; }

  protected:
    int_type underflow() override {
        if (offset_ >= source_.bytes.size()) return traits_type::eof();
        text_.clear();
        line_ = ++lines_read_;
        append_line();
        while (ends_in_backslash() && offset_ < source_.bytes.size()) {
            text_.back() = ' ';
            ++lines_read_;
            append_line();
        }
        check();
        text_ += '\n';
        setg(text_.data(), text_.data(), text_.data() + text_.size());
        return traits_type::to_int_type(text_[0]);
    }

  private:
    void append_line() {
        const std::string_view bytes = source_.bytes;
        const std::size_t end = std::min(bytes.find('\n', offset_), bytes.size());
        text_ += bytes.substr(offset_, end - offset_);
        if (text_.ends_with('\r')) text_.pop_back();
        offset_ = std::min(end + 1, bytes.size());
    }
    bool ends_in_backslash() const { return text_.ends_with('\\'); }

    void check() const {
        std::string_view rest = text_;
        const auto word = [&] {
            rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
            const std::string_view found = rest.substr(0, rest.find_first_of(kBlank));
            rest.remove_prefix(found.size());
            return found;
        };
        const std::string_view keyword = word();
        // Texture coordinates may be one number only.
        const int needed = keyword == "v" || keyword == "vn" ? 3 : keyword == "vt" ? 1 : 0;
        for (int i = 0; i < needed; ++i) {
            const std::string_view number = word();
            if (number.empty())
                source_.fail(line_,
                             fmt::format("'{}' with {} numbers; it needs {}", keyword, i, needed));
            if (number.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
                source_.fail(line_, fmt::format("'{}' is not a finite number", number));
        }
        if (keyword != "f") return;
        for (std::string_view corner = word(); !corner.empty(); corner = word())
            if (corner.find_first_not_of("0123456789-+/") != std::string_view::npos)
                source_.fail(line_, fmt::format("'{}' is not a corner; write v, v/vt, v//vn or "
                                                "v/vt/vn",
                                                corner));
    }

    const MeshSource& source_;
    std::string text_;
    std::size_t offset_ = 0, lines_read_ = 0, line_ = 0;
};

// Takes the parser's callbacks. Corners become vertices of the mesh: one for each position while
// no face names texture coordinates or normals, later one for each combination (v, vt, vn).
class ObjBuilder {
  public:
    ObjBuilder(const MeshSource& source, const ObjLines& lines) : source_(source), lines_(lines) {}

    void face(const tinyobj::index_t* raw, int count) {
        corners_.clear();
        for (int i = 0; i < count; ++i) {
            const Corner c{resolve(raw[i].vertex_index, positions.size(), vertex_),
                           resolve(raw[i].texcoord_index, uvs.size(), uv_),
                           resolve(raw[i].normal_index, normals.size(), normal_)};
            if (c.v == 0)
                source_.fail(lines_.line(), "face names vertex 0; OBJ counts vertices from 1");
            if (!combined_ && (c.vt || c.vn)) combine();
            corners_.push_back(combined_ ? vertex_of(c) : c.v - 1);
        }
        add_polygon(mesh_, corners_);
        ++faces_;
    }

    Mesh finish() {
        check(vertex_, positions.size(), "vertex", "vertices");
        check(uv_, uvs.size(), "texture coordinate", "texture coordinates");
        check(normal_, normals.size(), "normal", "normals");
        if (!combined_) {
            mesh_.positions = std::move(positions);
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

    // tinyobjloader hands over the numbers of the file: from 1, or negative to count backwards.
    std::uint32_t resolve(int index, std::size_t count, Largest& largest) {
        const std::int64_t absolute = index < 0 ? std::int64_t(count) + index + 1 : index;
        // No file of n bytes holds n vertices: this bounds what an index can make us allocate.
        if ((index < 0 && absolute < 1) || absolute > std::int64_t(source_.bytes.size()))
            source_.fail(lines_.line(), fmt::format("face {} (counted from 1) has index {}, but {} "
                                                    "are defined before it",
                                                    faces_ + 1, index, count));
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
    const ObjLines& lines_;
    Mesh mesh_;
    bool combined_ = false;
    std::size_t faces_ = 0;
    Largest vertex_, uv_, normal_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> first_of_;  ///< by position from 1: first vertex + 1, or 0
    std::vector<Entry> vertices_;
};

}  // namespace

Mesh read_obj(const MeshSource& source) {
    ObjLines lines(source);
    ObjBuilder builder(source, lines);
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* to, float x, float y, float z, float) {
        static_cast<ObjBuilder*>(to)->positions.emplace_back(x, y, z);
    };
    callbacks.normal_cb = [](void* to, float x, float y, float z) {
        static_cast<ObjBuilder*>(to)->normals.emplace_back(x, y, z);
    };
    callbacks.texcoord_cb = [](void* to, float u, float v, float) {
        static_cast<ObjBuilder*>(to)->uvs.push_back({u, v});
    };
    callbacks.index_cb = [](void* to, tinyobj::index_t* corners, int count) {
        static_cast<ObjBuilder*>(to)->face(corners, count);
    };
    std::istream stream(&lines);
    stream.exceptions(std::ios::badbit);  // lets our own exceptions through
    tinyobj::LoadObjWithCallback(stream, callbacks, &builder);
    return builder.finish();
}

}  // namespace nacre
