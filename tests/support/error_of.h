#pragma once
// What an InputError says.
#include <string>

#include "nacre/math/error.h"

namespace nacre::test {

template <class F>
std::string error_of(F&& f) {
    try {
        f();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace nacre::test
