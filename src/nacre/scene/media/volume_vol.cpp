// Mitsuba's .vol files: "VOL", a version byte, then little-endian int32 encoding, cells along x, y
// and z, channels; six floats of a bounding box; and the values, channels fastest, then x, y, z
// (Mitsuba 3 documentation, gridvolume).
#include <bit>
#include <cstring>
#include <fstream>

#include "nacre/math/error.h"
#include "nacre/scene/media/volume_grid.h"

namespace nacre {

static_assert(std::endian::native == std::endian::little, ".vol files are read in place");

namespace {

struct Header {
    char magic[3];
    std::uint8_t version;
    std::int32_t encoding, cells[3], channels;
    float lower[3], upper[3];
};
static_assert(sizeof(Header) == 48);

}  // namespace

std::shared_ptr<const VoxelGrid> read_vol(const std::filesystem::path& file) {
    const auto fail = [&](const std::string& what) {
        throw InputError(fmt::format("{}: {}", file.string(), what));
    };
    std::ifstream in(file, std::ios::binary);
    if (!in) fail("cannot be opened; check the name and the permissions");
    in.seekg(0, std::ios::end);
    const auto bytes = static_cast<std::uint64_t>(in.tellg());
    in.seekg(0);
    Header header{};
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!in || std::memcmp(header.magic, "VOL", 3) != 0)
        fail(
            "is not a volume file of Mitsuba: it does not begin with 'VOL' and a header of 48 "
            "bytes");
    if (header.version != 3)
        fail(fmt::format("has version {} of the format; only version 3 is read", header.version));
    if (header.encoding != 1)
        fail(
            fmt::format("stores values by encoding {}; only 1 (float32) is read", header.encoding));
    if (header.channels != 1 && header.channels != 3)
        fail(fmt::format("has {} channels; only 1 (a number) or 3 (red, green, blue) are read",
                         header.channels));
    // Compared by division, so that no product of the header's numbers can overflow.
    std::uint64_t room = (bytes - sizeof header) / sizeof(float) / header.channels;
    bool fits = true;
    std::uint64_t values = header.channels;
    for (const std::int32_t n : header.cells) {
        if (n < 1) fail(fmt::format("has a side of {} cells; at least 1 is needed", n));
        fits = fits && static_cast<std::uint64_t>(n) <= room;
        room /= n;
        values *= fits ? n : 1;
    }
    if (!fits || sizeof header + values * sizeof(float) != bytes)
        fail(
            fmt::format("is {} bytes long, which does not fit {} x {} x {} cells of {} float32 "
                        "after a header of 48 bytes; it was cut off or damaged",
                        bytes, header.cells[0], header.cells[1], header.cells[2], header.channels));

    auto grid = std::make_shared<VoxelGrid>();
    grid->nx = header.cells[0];
    grid->ny = header.cells[1];
    grid->nz = header.cells[2];
    grid->channels = header.channels;
    grid->data.resize(values);
    in.read(reinterpret_cast<char*>(grid->data.data()),
            static_cast<std::streamsize>(values * sizeof(float)));
    if (!in) fail("could not be read to its end");

    Vec3d lower, extent;
    bool box = true;
    for (int i = 0; i < 3; ++i) {
        lower[i] = header.lower[i];
        extent[i] = double(header.upper[i]) - header.lower[i];
        box = box && std::isfinite(extent[i]) && extent[i] > 0.0;
    }
    if (!box)
        fail(
            fmt::format("has a bounding box from ({}, {}, {}) to ({}, {}, {}); its sides must be "
                        "positive and finite",
                        header.lower[0], header.lower[1], header.lower[2], header.upper[0],
                        header.upper[1], header.upper[2]));
    grid->file_placement = Transform::translate(lower) * Transform::scale(extent);
    return grid;
}

}  // namespace nacre
