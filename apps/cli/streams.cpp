#include "apps/cli/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "nacre/math/error.h"

namespace nacre::cli {

void keep_standard_streams() {
    for (int stream = 0; stream <= 2; ++stream) {
        if (fcntl(stream, F_GETFD) != -1) continue;
        // The lowest free number is this one. Of output only reading is allowed, so that writing to
        // it is still an error.
        const int opened = open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
        if (opened != stream && opened >= 0) close(opened);
    }
}

void finish_standard_output() {
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    if (flushed && !std::ferror(stdout) && std::cout) return;
    if (flushed) {
        // More than the buffer holds was written before, and why that failed is forgotten: it will
        // fail again.
        std::clearerr(stdout);
        std::fputc('\n', stdout);
        std::fflush(stdout);
    }
    throw RunError(fmt::format("standard output cannot be written: {}",
                               errno ? std::strerror(errno) : "an earlier part was lost"));
}

void say_line(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace nacre::cli
