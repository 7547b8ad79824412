#pragma once
// What the mesh readers share. Only for the .cpp files of this room.
#include <filesystem>
#include <string>
#include <string_view>

#include "nacre/geometry/mesh_io.h"
#include "nacre/text/lines.h"

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

/// What every reader leaves to be done: values checked, triangles without area dropped, normals
/// completed, `options` applied.
void finish_mesh(Mesh& mesh, const MeshSource& source, const MeshOptions& options,
                 bool flip_tex_coords);

/// Throws InputError for what an archiver left packed.
void refuse_compressed(const MeshSource& source);

/// Whole content of a file; throws InputError.
std::string read_bytes(const std::filesystem::path& path);

/// Adds a convex polygon as a fan, or counts it as dropped if it has fewer than three corners.
template <class Corners>
void add_polygon(Mesh& mesh, const Corners& corners) {
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

/// Text as lines of blank-separated words, comments (# to the end of the line), byte order marks
/// and line ends of any system left out. Throws InputError if the file is text in UTF-16.
class TextLines {
  public:
    TextLines(const MeshSource& source, std::size_t offset, std::size_t line);

    /// Goes to the next line that has a word; false at the end of the file.
    bool next_line();
    /// Goes to the next line, empty or not; false at the end of the file.
    bool following_line();
    /// Next word of the line; empty at its end.
    std::string_view word();
    /// Next word of the file, from whichever line; empty at the end of the file.
    std::string_view any_word();
    /// Next word of the line as a number; `what` names it in the message. Infinities and NaN are
    /// numbers here: the mesh is checked as a whole, with the vertex named.
    double number(const char* what);
    double to_number(std::string_view word, const char* what) const;
    std::int64_t to_integer(std::string_view word, const char* what) const;
    bool line_done();
    /// Number of the current line, from 1.
    std::size_t line() const { return lines_.line(); }
    /// Bytes not yet read, the rest of the current line included.
    std::size_t remaining() const { return source_.bytes.size() - lines_.offset() + rest_.size(); }

  private:
    const MeshSource& source_;
    LineSplitter lines_;
    std::string_view rest_;
};

}  // namespace nacre
