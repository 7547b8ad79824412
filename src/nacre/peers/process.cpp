#include "nacre/peers/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <thread>

#include "nacre/math/error.h"
#include "nacre/metrics/machine.h"

extern char** environ;

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

pid_t spawn(const std::vector<std::string>& words, const fs::path& log) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    // A group of its own, so that its children can be stopped with it, and so that Ctrl-C at the
    // terminal is nacre's to handle.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0)
        throw RunError(fmt::format("{}: cannot be started: {}", words[0], std::strerror(error)));
    return child;
}

}  // namespace

std::vector<fs::path> find_programs(std::string_view name, std::string search_path) {
    if (search_path.empty())
        if (const char* path = std::getenv("PATH")) search_path = path;
    std::vector<fs::path> found;
    for (std::size_t at = 0; at <= search_path.size();) {
        const std::size_t end = std::min(search_path.find(':', at), search_path.size());
        const fs::path file = fs::path(search_path.substr(at, end - at)) / name;
        std::error_code ignored;
        if (end > at && fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
            found.push_back(file);
        at = end + 1;
    }
    return found;
}

ProcessResult run_process(const std::vector<std::string>& words, const fs::path& log,
                          const std::atomic<bool>* stop) {
    const Clock::time_point start = Clock::now();
    const pid_t child = spawn(words, log);
    ProcessResult result;
    Clock::time_point asked;
    for (;;) {
        int status = 0;
        // Asked before it may have ended: what is gone cannot be asked.
        result.peak_mb = std::max(result.peak_mb, peak_memory_of(child));
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended < 0 && errno != EINTR)
            throw RunError(
                fmt::format("{}: cannot be waited for: {}", words[0], std::strerror(errno)));
        if (ended == child) {
            result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            result.seconds = seconds_since(start);
            return result;
        }
        if (stop && *stop && !result.stopped) {
            result.stopped = true;
            asked = Clock::now();
            kill(-child, SIGTERM);
        }
        if (result.stopped && seconds_since(asked) > 2) kill(-child, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

std::string command_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line += ' ';
        const bool plain =
            !word.empty() && word.find_first_not_of(
                                 "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                 "0123456789_-+=.,:/@%") == word.npos;
        if (plain) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

std::string last_lines(const fs::path& file, int count) {
    std::ifstream in(file);
    std::deque<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (line.find_first_not_of(" \t\r") == line.npos) continue;
        lines.push_back(line);
        if (static_cast<int>(lines.size()) > count) lines.pop_front();
    }
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
}

std::string log_value(const fs::path& log, std::string_view key) {
    const std::string begin = fmt::format("nacre: {} ", key);
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(begin)) return line.substr(begin.size());
    return {};
}

}  // namespace nacre
