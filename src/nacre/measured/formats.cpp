#include "nacre/measured/formats.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "nacre/math/error.h"
#include "nacre/measured/unknown_file.h"
#include "nacre/text/whole_file.h"

namespace nacre {
// Each format's line: the function NAME_format() of its own file describes it. The first that
// recognises a file reads it.
// clang-format off
#define NACRE_MEASURED_FORMATS(X) \
    X(merl)                       \
    X(rgl)                        \
    X(klems)                      \
    X(cornell)                    \
    X(alta)                       \
    X(astm)                       \
    X(csv)
// clang-format on

#define NACRE_DECLARE_FORMAT(name) const MeasuredFormat& name##_format();
NACRE_MEASURED_FORMATS(NACRE_DECLARE_FORMAT)
#undef NACRE_DECLARE_FORMAT

namespace {

const MeasuredFormat* recognise(const FileStart& start) {
    for (const MeasuredFormat* format : measured_formats())
        if (format->recognise(start)) return format;
    return nullptr;
}

[[noreturn]] void refuse_unknown(const std::filesystem::path& path, const FileStart& start) {
    std::string titles;
    for (const MeasuredFormat* format : measured_formats())
        titles += (titles.empty() ? "" : ", ") + std::string(format->title);
    throw InputError(fmt::format("{}: holds no measured reflectance that can be read ({}): {}",
                                 path.string(), titles, what_it_seems_to_be(start)));
}

/// The size and the beginning of a file; nothing if it cannot be read.
std::optional<std::uintmax_t> look_into(const std::filesystem::path& path, std::string& head) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) return std::nullopt;
    head.resize(std::min<std::uintmax_t>(size, FileStart::length));
    file.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(file.gcount()));
    return size;
}

}  // namespace

void MeasuredSource::fail(std::string_view what) const {
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

void MeasuredSource::fail(std::size_t line, std::string_view what) const {
    throw InputError(fmt::format("{}, line {}: {}", path.string(), line, what));
}

const Catalogue<MeasuredFormat>& measured_formats() {
    static const Catalogue<MeasuredFormat> all = [] {
#define NACRE_DESCRIBE_FORMAT(name) &name##_format(),
        const MeasuredFormat* formats[] = {NACRE_MEASURED_FORMATS(NACRE_DESCRIBE_FORMAT)};
#undef NACRE_DESCRIBE_FORMAT
        return Catalogue<MeasuredFormat>("format of measured reflectance", formats);
    }();
    return all;
}

const MeasuredFormat* recognise_measured(const std::filesystem::path& path) {
    std::string head;
    const auto size = look_into(path, head);
    return size ? recognise({head, *size}) : nullptr;
}

std::uintmax_t available_memory() {
    std::ifstream file("/proc/meminfo");
    std::string word;
    std::uintmax_t kib = 0;
    while (file >> word)
        if (word == "MemAvailable:" && file >> kib) return kib * 1024;
    const long pages = sysconf(_SC_AVPHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? std::uintmax_t(pages) * std::uintmax_t(size)
                                 : std::numeric_limits<std::uintmax_t>::max();
}

std::unique_ptr<Measured> read_measured(const std::filesystem::path& path,
                                        const ReadLimits& limits) {
    std::string head;
    const auto size = look_into(path, head);
    if (!size) throw InputError(fmt::format("{}: cannot be read; check the name", path.string()));
    const FileStart start{head, *size};
    const MeasuredFormat* format = recognise(start);
    if (!format) refuse_unknown(path, start);
    // Whatever a header claims must stand in the file, so its size bounds what is needed.
    const double need = double(*size) * (1. + format->memory);
    if (need > double(limits.memory))
        throw InputError(fmt::format(
            "{}: has {:.1f} MB, and reading it as {} takes up to {:.1f} MB of memory, but only "
            "{:.1f} MB are free; free some, or read it on a larger machine",
            path.string(), double(*size) * 1e-6, format->title, need * 1e-6,
            double(limits.memory) * 1e-6));
    const auto bytes = read_whole_file(path);
    if (!bytes) throw InputError(fmt::format("{}: cannot be read; check the name", path.string()));
    return format->read({*bytes, path});
}

std::unique_ptr<Measured> parse_measured(const MeasuredSource& source) {
    const FileStart start{source.bytes.substr(0, FileStart::length), source.bytes.size()};
    const MeasuredFormat* format = recognise(start);
    if (!format) refuse_unknown(source.path, start);
    return format->read(source);
}

}  // namespace nacre
