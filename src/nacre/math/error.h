#pragma once
// What the library throws: what is wrong, where, and how to mend it, in one sentence that can be
// shown to a user.
#include <stdexcept>

namespace nacre {

/// Wrong input: a file, a scene, a parameter, a command line. The command line turns it into exit
/// code 2.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A failure that is not the user's input: a disk that is full, a render that a strict check
/// refused. Exit code 1.
class RunError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace nacre
