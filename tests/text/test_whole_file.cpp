// Files that are read whole.
#include "nacre/text/whole_file.h"

#include <unistd.h>

#include <cerrno>

namespace nacre {

TEST(WholeFile, IsReadByteByByte) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("nacre_whole_{}", getpid());
    make_output_folder(folder);
    for (const std::size_t size : {0, 1, 4095, 4096, 4097, 100000}) {
        std::string bytes(size, '\0');
        for (std::size_t i = 0; i < size; ++i) bytes[i] = char(i * 7 + i / 251);
        write_whole_file(folder / "bytes", bytes);
        EXPECT_EQ(read_whole_file(folder / "bytes"), bytes) << size;
    }
    EXPECT_EQ(read_whole_file(folder), std::nullopt);
    EXPECT_EQ(errno, EISDIR);
    EXPECT_EQ(read_whole_file(folder / "absent"), std::nullopt);
    EXPECT_EQ(errno, ENOENT);
    // Says that it has no bytes, and has some.
    EXPECT_TRUE(read_whole_file("/proc/self/status").value_or("").starts_with("Name:"));
    std::filesystem::remove_all(folder);
}

}  // namespace nacre
