#pragma once
// What the mesh readers share. Only for the .cpp files of this room.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "nacre/geometry/mesh_io.h"

namespace nacre {

/// The bytes of a mesh file and the name to complain under.
struct MeshSource {
    std::string_view bytes;
    std::filesystem::path path;

    /// Throws InputError "FILE: what".
    [[noreturn]] void fail(const std::string& what) const;
    /// Throws InputError "FILE:line: what".
    [[noreturn]] void fail(std::size_t line, const std::string& what) const;
    /// fail(what), with the line unless it is 0.
    [[noreturn]] void fail_at(std::size_t line, const std::string& what) const;
};

Mesh read_obj(const MeshSource& source);
Mesh read_ply(const MeshSource& source);
Mesh read_off(const MeshSource& source);
Mesh read_stl(const MeshSource& source);
Mesh read_gltf(const MeshSource& source);
Mesh read_serialized(const MeshSource& source, int shape_index);

/// Whole content of a file; throws InputError.
std::string read_bytes(const std::filesystem::path& path);

/// Adds the triangles of a fan, or counts it as dropped if it has fewer than three corners. (A
/// polygon that may be concave is one for PolygonList, polygon.h.)
template <class Corners>
void add_fan(Mesh& mesh, const Corners& corners) {
    if (corners.size() < 3) ++mesh.dropped_triangles;
    for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// Adds the triangles of a strip: every second one is turned round.
template <class Corners>
void add_strip(Mesh& mesh, const Corners& corners) {
    if (corners.size() < 3) ++mesh.dropped_triangles;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        mesh.triangles.push_back({corners[i - 2 + odd], corners[i - 1 - odd], corners[i]});
    }
}

/// Bytes of a byte order mark of UTF-8 at the beginning of a text, 3 or 0.
std::size_t byte_order_mark(std::string_view text);

/// Text as lines of blank-separated words. Lines end in LF, CR LF or CR; comments (# at the
/// beginning of a word or behind one, to the end of the line) and a byte order mark are left out.
class TextLines {
  public:
    /// Begins at this byte, which is the first of line `line` + 1.
    TextLines(const MeshSource& source, std::size_t offset, std::size_t line)
        : source_(source),
          offset_(offset == 0 ? byte_order_mark(source.bytes) : offset),
          line_(line),
          lines_read_(line) {}

    /// Goes to the next line that has a word; false at the end of the file.
    bool next_line();
    /// If the line ends in a backslash, takes the lines that go on with it in, too.
    void join_continued();
    /// Next word of the line; empty at its end.
    std::string_view word();
    /// Next word of the file, from whichever line; empty at the end of the file.
    std::string_view any_word();
    /// Next word of the line as a number; `what` names it in the message. The whole word must be
    /// one: "1.2.3" is refused. What is too small for a double is 0. Infinities and NaN are numbers
    /// here: the mesh is checked as a whole, with the vertex named.
    double number(const char* what);
    double to_number(std::string_view word, const char* what) const;
    std::int64_t to_integer(std::string_view word, const char* what) const;
    bool line_done();
    /// Number of the current line, from 1; of its first one if it was continued.
    std::size_t line() const { return line_; }
    /// Bytes not yet read, the rest of the current line included.
    std::size_t remaining() const { return source_.bytes.size() - offset_ + rest_.size(); }

  private:
    std::string_view take_line();

    const MeshSource& source_;
    std::size_t offset_, line_, lines_read_;
    std::string_view rest_;
    std::string joined_;
};

/// The whole word as a number, and nothing else; a '+' before it is allowed. What is too small is
/// 0, what is too large infinite.
std::optional<double> number_in(std::string_view word);
std::optional<std::int64_t> integer_in(std::string_view word);

}  // namespace nacre
