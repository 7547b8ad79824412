#pragma once
// Programs of others as child processes: found, run, timed, stopped. Used by the peers only.
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// Every executable file of that name in the folders of `search_path`, separated by ':', in order;
/// an empty search path means that of the environment.
std::vector<std::filesystem::path> find_programs(std::string_view name, std::string search_path);

struct ProcessResult {
    int status = 0;  ///< exit status; 128 + signal if a signal ended it
    bool stopped = false;
    double seconds = 0;  ///< wall time
    double peak_mb = 0;  ///< largest resident memory of the program itself, MB
};

/// Runs a program; the first word is its path and no shell looks at the others. Its output and
/// errors go to the file `log`, its input is empty. When `stop` becomes true the program and its
/// children are told to end, and after two seconds are ended. Throws RunError if it cannot start.
ProcessResult run_process(const std::vector<std::string>& words, const std::filesystem::path& log,
                          const std::atomic<bool>* stop = nullptr);

/// The words as they would be typed into a shell.
std::string command_line(const std::vector<std::string>& words);

/// A file's last lines, `count` at most, without empty ones.
std::string last_lines(const std::filesystem::path& file, int count);
/// What follows "nacre: KEY " in a log; empty if nothing does.
std::string log_value(const std::filesystem::path& log, std::string_view key);

}  // namespace nacre
