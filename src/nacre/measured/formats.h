#pragma once
// The formats of measured reflectance, one a file; formats.cpp has the list. A file is recognised
// by its content; its ending does not matter.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "nacre/catalogue/catalogue.h"
#include "nacre/measured/measured.h"

namespace nacre {

/// The beginning of a file, at most `length` bytes, and how many it has in all.
struct FileStart {
    static constexpr std::size_t length = 16384;
    std::string_view head;
    std::uintmax_t size = 0;
};

/// All bytes of a file, and its name in messages.
struct MeasuredSource {
    std::string_view bytes;
    std::filesystem::path path;
    /// Throw InputError "FILE: what" and "FILE, line N: what".
    [[noreturn]] void fail(std::string_view what) const;
    [[noreturn]] void fail(std::size_t line, std::string_view what) const;
};

/// How finely what has no samples of a format's own is sampled for it; each format uses some.
struct WriteOptions {
    int resolution = 32;  ///< rgl: nodes along a side of the warped square
    int incidences = 24;  ///< rgl: of theta_i
    int azimuths = 24;    ///< rgl: steps of phi_i around the circle, if the surface is anisotropic
    double step = 5.;     ///< text: degrees between directions
    bool samples = true;  ///< text: the data's own directions, if they have any
};

struct WrittenMeasured {
    std::string bytes;
    /// What the file does not say that its source does, a sentence each.
    std::vector<std::string> lost;
};

/// What files of a format can hold.
struct FormatKeeps {
    bool wavelengths = false, grey = false;  ///< besides red, green and blue
    bool anisotropy = false, transmission = false;
};

struct MeasuredFormat {
    std::string_view name;    ///< "merl"
    std::string_view title;   ///< "MERL"
    std::string_view ending;  ///< usual one, ".binary"
    std::string_view summary;
    double memory = 1.;  ///< bytes that its table takes, at most, for each byte of the file
    bool (*recognise)(const FileStart& start) = nullptr;
    /// Throws InputError for whatever is wrong with the file.
    std::unique_ptr<Measured> (*read)(const MeasuredSource& source) = nullptr;
    FormatKeeps keeps = {};
    /// The file that holds this; null if the format cannot be written. Asked only for what the
    /// format keeps (convert.h turns the rest into it or refuses it).
    WrittenMeasured (*write)(const Measured& data, const WriteOptions& options) = nullptr;
};

const Catalogue<MeasuredFormat>& measured_formats();

/// The format of a file by its first bytes, null if it is none of them or cannot be read.
const MeasuredFormat* recognise_measured(const std::filesystem::path& path);

/// Bytes of memory that programs can still get, of what /proc/meminfo says.
std::uintmax_t available_memory();

struct ReadLimits {
    std::uintmax_t memory = available_memory();
};

/// Reads a file of any format. Throws InputError "FILE: what is wrong; how to mend it": it cannot
/// be read, is of no format (with what it seems to be), needs more memory than there is (before any
/// is taken), or what its reader refuses.
std::unique_ptr<Measured> read_measured(const std::filesystem::path& path,
                                        const ReadLimits& limits = {});
/// The same from memory.
std::unique_ptr<Measured> parse_measured(const MeasuredSource& source);

}  // namespace nacre
