#include "nacre/geometry/mesh_io.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_source.h"
#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

// Embree ignores triangles with coordinates beyond 1.8e18, whose squares overflow.
constexpr float kFarthest = 1e18f;

bool usable(const Point3f& p) {
    return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

void check_values(const Mesh& mesh, const MeshSource& source) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (const Point3f& p = mesh.positions[i]; !usable(p))
            source.fail(
                fmt::format("vertex {} (counted from 0) lies at ({}, {}, {}); coordinates "
                            "must be finite and below 1e18",
                            i, p.x, p.y, p.z));
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
        if (const Vec2f& uv = mesh.uvs[i]; !std::isfinite(uv.x) || !std::isfinite(uv.y))
            source.fail(
                fmt::format("vertex {} (counted from 0) has texture coordinates ({}, {}); "
                            "they must be finite",
                            i, uv.x, uv.y));
}

void drop_degenerate(Mesh& mesh, const MeshSource& source) {
    const std::size_t had = mesh.triangles.size();
    if (had == 0)
        source.fail("has no triangles; nacre renders surfaces, not points, lines or empty files");
    std::erase_if(mesh.triangles, [&](const Mesh::Triangle& t) {
        const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                      &c = mesh.positions[t[2]];
        return a == b || b == c || c == a;
    });
    mesh.dropped_triangles += had - mesh.triangles.size();
    if (mesh.triangles.empty())
        source.fail(fmt::format(
            "has no area: two corners coincide in each of its {} triangles; check the export scale",
            had));
}

void repair_normals(Mesh& mesh) {
    const auto bad = [](const Vec3f& n) {
        const float len = length(n);
        return !(len > 0.f) || !std::isfinite(len);
    };
    std::size_t missing = 0;
    for (const Vec3f& n : mesh.normals) missing += bad(n);
    if (missing == mesh.normals.size()) {
        mesh.normals = {};
        return;
    }
    if (missing > 0) {
        std::vector<Vec3f> given = std::move(mesh.normals);
        compute_normals(mesh);
        for (std::size_t i = 0; i < given.size(); ++i)
            if (!bad(given[i])) mesh.normals[i] = given[i];
    }
    for (Vec3f& n : mesh.normals) n = normalize(n);
}

void apply(const Transform& to_world, Mesh& mesh) {
    if (to_world.is_identity()) return;
    for (Point3f& p : mesh.positions) p = to_world.point(p);
    for (Vec3f& n : mesh.normals) {
        const Vec3d mapped = to_world.map_normal(Vec3d(n));
        n = Vec3f(normalize(mapped));
    }
    if (to_world.swaps_handedness())
        for (Mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

// Readers that do not know counts beforehand grow their arrays by doubling; large meshes should
// not keep that slack. Embree's padding needs room for one position more.
template <class T>
void trim(std::vector<T>& v, std::size_t extra) {
    if (v.capacity() >= v.size() + extra && v.capacity() <= v.size() + v.size() / 8 + 64) return;
    std::vector<T> exact;
    exact.reserve(v.size() + extra);
    exact.assign(v.begin(), v.end());
    v = std::move(exact);
}

Mesh read(const MeshSource& source, const std::string& extension, const MeshOptions& options) {
    if (extension == ".obj") return read_obj(source);
    if (extension == ".ply") return read_ply(source);
    if (extension == ".off") return read_off(source);
    if (extension == ".stl") return read_stl(source);
    if (extension == ".gltf" || extension == ".glb") return read_gltf(source);
    if (extension == ".serialized") return read_serialized(source, options.shape_index);
    source.fail(
        fmt::format("unknown mesh format '{}'; nacre reads .glb, .gltf, .obj, .off, .ply, "
                    ".serialized and .stl",
                    extension));
}

}  // namespace

// Files that a browser or an archiver left packed would only be called damaged.
void refuse_compressed(const MeshSource& source) {
    constexpr std::pair<std::string_view, const char*> kPacked[] = {{"\x1f\x8b", "gzip"},
                                                                    {"PK\3\4", "zip"},
                                                                    {"\xfd"
                                                                     "7zXZ",
                                                                     "xz"},
                                                                    {"\x28\xb5\x2f\xfd", "zstd"},
                                                                    {"BZh", "bzip2"}};
    for (const auto& [start, name] : kPacked)
        if (source.bytes.starts_with(start))
            source.fail(fmt::format("is compressed with {}; unpack it first", name));
}

void MeshSource::fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", path.string(), what));
}
void MeshSource::fail(std::size_t line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path.string(), line, what));
}
void MeshSource::fail_at(std::size_t line, const std::string& what) const {
    line ? fail(line, what) : fail(what);
}

std::string read_bytes(const std::filesystem::path& path) {
    const MeshSource source{{}, path};
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        source.fail("is a folder; give the mesh file inside it");
    if (std::filesystem::exists(path, error)) {
        static_cast<void>(
            std::filesystem::file_size(path, error));  // a device has none, nor an end
        if (error) source.fail(fmt::format("has no size ({}); give a plain file", error.message()));
    }
    auto bytes = read_whole_file(path);
    if (!bytes)
        source.fail(fmt::format("cannot be opened ({}); check the path", std::strerror(errno)));
    return *std::move(bytes);
}

void finish_mesh(Mesh& mesh, const MeshSource& source, const MeshOptions& options,
                 bool flip_tex_coords) {
    mesh.name = source.path.filename().string();
    check_values(mesh, source);
    drop_degenerate(mesh, source);
    repair_normals(mesh);
    if (options.flip_tex_coords.value_or(flip_tex_coords))
        for (Vec2f& uv : mesh.uvs) uv.y = 1 - uv.y;
    apply(options.to_world, mesh);
    if (!options.to_world.is_identity()) check_values(mesh, source);
    trim(mesh.positions, 1);
    trim(mesh.normals, 0);
    trim(mesh.uvs, 0);
    trim(mesh.triangles, 0);
}

std::shared_ptr<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path,
                                 const MeshOptions& options) {
    const MeshSource source{bytes, path};
    refuse_compressed(source);
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    auto mesh = std::make_shared<Mesh>(read(source, extension, options));
    finish_mesh(*mesh, source, options, extension == ".obj");
    return mesh;
}

std::shared_ptr<Mesh> load_mesh(const std::filesystem::path& path, const MeshOptions& options) {
    const std::string bytes = read_bytes(path);
    if (bytes.empty()) MeshSource{bytes, path}.fail("is empty; export the mesh again");
    return parse_mesh(bytes, path, options);
}

}  // namespace nacre
