// Mitsuba's .serialized meshes (Mitsuba 0.6 documentation, section 8.2.4 "Serialized mesh loader"):
// any number of meshes, each with a 4-byte header (0x041C, version) and a zlib stream; at the end
// of the file the offset of each and their number. Little-endian throughout.
#include <fmt/format.h>
#include <zlib.h>

#include <cstring>

#include "nacre/geometry/mesh_source.h"

namespace nacre {
namespace {

constexpr std::uint16_t kMagic = 0x041c;
constexpr std::uint32_t kNormals = 0x1, kUvs = 0x2, kColors = 0x8, kDouble = 0x2000;

template <class T>
T value_at(std::string_view bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

class Inflater {
  public:
    Inflater(const MeshSource& source, std::string_view packed) : source_(source), packed_(packed) {
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
        if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void read(void* to, std::size_t bytes, const char* what) {
        auto* out = static_cast<Bytef*>(to);
        while (bytes > 0) {
            // zlib counts in 32 bits.
            constexpr std::size_t kStep = std::size_t{1} << 30;
            const std::size_t used =
                reinterpret_cast<const char*>(stream_.next_in) - packed_.data();
            stream_.avail_in = static_cast<uInt>(std::min(packed_.size() - used, kStep));
            const std::size_t step = std::min(bytes, kStep);
            stream_.next_out = out;
            stream_.avail_out = static_cast<uInt>(step);
            const int status = inflate(&stream_, Z_NO_FLUSH);
            const std::size_t got = step - stream_.avail_out;
            out += got;
            bytes -= got;
            if (bytes > 0 && (status != Z_OK || got == 0))
                source_.fail(
                    fmt::format("is truncated or damaged: the compressed data end before "
                                "{} more bytes of {}; export it again",
                                bytes, what));
        }
    }

    template <class T>
    T read(const char* what) {
        T value;
        read(&value, sizeof value, what);
        return value;
    }

  private:
    const MeshSource& source_;
    std::string_view packed_;
    z_stream stream_{};
};

// The zlib stream of mesh number `index`, and its version.
std::string_view find_mesh(const MeshSource& source, int index, std::uint16_t& version) {
    const std::string_view bytes = source.bytes;
    if (bytes.size() < 8 || value_at<std::uint16_t>(bytes, 0) != kMagic)
        source.fail("is not a Mitsuba .serialized file: it does not begin with 1c 04");
    version = value_at<std::uint16_t>(bytes, 2);
    if (version != 3 && version != 4)
        source.fail(fmt::format("has version {} of the format; nacre reads 3 and 4", version));
    const std::size_t width = version == 4 ? 8 : 4;
    const auto count = value_at<std::uint32_t>(bytes, bytes.size() - 4);
    if (count == 0 || count > (bytes.size() - 8) / width)
        source.fail(
            fmt::format("is truncated: its last bytes promise {} meshes; export it again", count));
    if (index < 0 || static_cast<std::uint32_t>(index) >= count)
        source.fail(fmt::format("has no mesh {}; shape_index runs from 0 to {}", index, count - 1));
    const std::size_t table = bytes.size() - 4 - count * width;
    const auto offset = [&](std::uint32_t i) -> std::uint64_t {
        return i == count     ? table
               : version == 4 ? value_at<std::uint64_t>(bytes, table + i * width)
                              : value_at<std::uint32_t>(bytes, table + i * width);
    };
    const std::uint64_t begin = offset(index), end = offset(index + 1);
    if (begin > table || end > table || end < begin || end - begin < 4)
        source.fail(
            fmt::format("has mesh {} at bytes {} to {} of {}; the table of offsets at its "
                        "end is damaged, export it again",
                        index, begin, end, table));
    if (value_at<std::uint16_t>(bytes, begin) != kMagic)
        source.fail(fmt::format("has no mesh header at byte {}; export it again", begin));
    version = value_at<std::uint16_t>(bytes, begin + 2);
    if (version != 3 && version != 4)
        source.fail(fmt::format("has version {} of the format for mesh {}; nacre reads 3 and 4",
                                version, index));
    return bytes.substr(begin + 4, end - begin - 4);
}

// `count` tuples of Size numbers, stored as float or double.
template <int Size, class Tuple>
void read_tuples(Inflater& in, std::vector<Tuple>& to, std::size_t count, bool in_double,
                 const char* what) {
    static_assert(sizeof(Tuple) == Size * sizeof(float));
    to.resize(count);
    if (!in_double) return in.read(to.data(), count * sizeof(Tuple), what);
    for (Tuple& tuple : to) {
        double wide[Size];
        in.read(wide, sizeof wide, what);
        float narrow[Size];
        for (int i = 0; i < Size; ++i) narrow[i] = static_cast<float>(wide[i]);
        std::memcpy(static_cast<void*>(&tuple), narrow, sizeof narrow);
    }
}

}  // namespace

Mesh read_serialized(const MeshSource& source, int shape_index) {
    std::uint16_t version = 0;
    const std::string_view packed = find_mesh(source, shape_index, version);
    Inflater in(source, packed);
    const auto flags = in.read<std::uint32_t>("the mesh's flags");
    if (version == 4)
        while (in.read<char>("the mesh's name") != '\0') {
        }
    const auto vertices = in.read<std::uint64_t>("the number of vertices");
    const auto triangles = in.read<std::uint64_t>("the number of triangles");
    const bool wide = flags & kDouble;
    // Deflate shrinks data at most 1032 times (zlib technical details), so a larger promise is
    // broken; check it before memory is taken.
    const std::uint64_t most = packed.size() * std::uint64_t{1032};
    if (vertices > 0xffffffffull || vertices > most / 12 || triangles > most / 12)
        source.fail(
            fmt::format("promises {} vertices and {} triangles in {} compressed bytes; it is "
                        "damaged, export it again",
                        vertices, triangles, packed.size()));
    Mesh mesh;
    mesh.positions.reserve(vertices + 1);
    read_tuples<3>(in, mesh.positions, vertices, wide, "positions");
    if (flags & kNormals) read_tuples<3>(in, mesh.normals, vertices, wide, "normals");
    if (flags & kUvs) read_tuples<2>(in, mesh.uvs, vertices, wide, "texture coordinates");
    if (flags & kColors) {
        std::vector<Vec3f> colors;
        read_tuples<3>(in, colors, vertices, wide, "colours");
    }
    mesh.triangles.resize(triangles);
    in.read(mesh.triangles.data(), triangles * sizeof(Mesh::Triangle), "triangles");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= vertices)
                source.fail(
                    fmt::format("face {} names vertex {}, but the mesh has {} vertices "
                                "(counted from 0)",
                                i, corner, vertices));
    return mesh;
}

}  // namespace nacre
