#include "nacre/text/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "nacre/math/error.h"

namespace nacre {
namespace {

/// A file beside the one that is wanted; removed unless it was renamed.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& wanted) : wanted_(wanted) {
        static std::atomic<unsigned> number{0};  // two threads may write into one folder
        path_ = wanted;
        path_ += fmt::format(".{}-{}.tmp", getpid(), number++);
    }
    ~TemporaryFile() {
        std::error_code ignored;
        if (!done_) std::filesystem::remove(path_, ignored);
    }
    void write(std::string_view bytes) {
        errno = 0;
        std::FILE* f = std::fopen(path_.c_str(), "wb");
        if (!f) fail();
        const bool written = std::fwrite(bytes.data(), 1, bytes.size(), f) == bytes.size();
        // Closing may be what finds the disk full.
        if (std::fclose(f) != 0 || !written) fail();
        std::error_code error;
        std::filesystem::rename(path_, wanted_, error);
        if (error) {
            errno = error.value();
            fail();
        }
        done_ = true;
    }

  private:
    [[noreturn]] void fail() const {
        throw RunError(
            fmt::format("{}: cannot be written: {}", wanted_.string(), std::strerror(errno)));
    }
    std::filesystem::path wanted_, path_;
    bool done_ = false;
};

}  // namespace

std::optional<std::string> read_whole_file(const std::filesystem::path& file) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                             std::fclose);
    if (!in) return std::nullopt;
    // The size is a hint: files of /proc say 0. One byte more finds the end in the first round.
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    std::string bytes;
    std::size_t used = 0;
    for (std::size_t room = unknown ? 4096 : std::size_t(size) + 1;; room = bytes.size()) {
        bytes.resize(used + room);
        used += std::fread(bytes.data() + used, 1, room, in.get());
        if (used < bytes.size()) break;
    }
    if (std::ferror(in.get())) return std::nullopt;
    bytes.resize(used);
    return bytes;
}

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
    TemporaryFile(file).write(bytes);
}

void check_output_file(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw InputError(fmt::format("{}: is a folder; name a file", file.string()));
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error))
        throw InputError(fmt::format("{}: the folder {} does not exist; make it first",
                                     file.string(), folder.string()));
    if (access(folder.c_str(), W_OK) != 0)
        throw InputError(fmt::format("{}: the folder {} cannot be written to: {}", file.string(),
                                     folder.string(), std::strerror(errno)));
}

void make_output_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && !std::filesystem::is_directory(folder, error))
        error = std::make_error_code(std::errc::not_a_directory);
    if (error)
        throw InputError(fmt::format("{}: cannot be made: {}; name another folder", folder.string(),
                                     error.message()));
    if (access(folder.c_str(), W_OK) != 0)
        throw InputError(fmt::format("{}: cannot be written to: {}; name another folder",
                                     folder.string(), std::strerror(errno)));
}

}  // namespace nacre
