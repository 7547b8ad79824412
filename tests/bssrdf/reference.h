#pragma once
// Reference values of tests/bssrdf/data/bssrdf.json, and what the tests of this room share.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/math/error.h"

namespace nacre::test {

inline const nlohmann::json& bssrdf_reference() {
    static const nlohmann::json values = [] {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/bssrdf/data/bssrdf.json");
        return nlohmann::json::parse(file);
    }();
    return values;
}

/// The message of the InputError that `action` throws.
template <class F>
std::string error_of(F&& action) {
    try {
        action();
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace nacre::test

#define EXPECT_RELATIVE(value, expected, tolerance) \
    EXPECT_NEAR(value, expected, (tolerance)*std::abs(double(expected)))
