#pragma once
// Standard output and standard error: what is lost on the first is an error, on the second it is
// not.
#include <fmt/format.h>

#include <string>

namespace nacre::cli {

/// Opens what the caller has closed, so that no file of ours gets the number of a standard stream:
/// output then fails as it would have, input is empty.
void keep_standard_streams();

/// Writes what is still buffered. Throws RunError if anything written to standard output was lost.
void finish_standard_output();

/// A message to standard error. Where it cannot be written, it is not: nobody is there to read it.
void say_line(const std::string& text);
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
    say_line(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace nacre::cli
