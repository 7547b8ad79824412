#pragma once
// Reference values of tests/bssrdf/data/bssrdf.json, and what the tests of this room share.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/error_of.h"

namespace nacre::test {

inline const nlohmann::json& bssrdf_reference() {
    static const nlohmann::json values = [] {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/bssrdf/data/bssrdf.json");
        return nlohmann::json::parse(file);
    }();
    return values;
}

}  // namespace nacre::test

namespace nacre {

inline double number(const nlohmann::json& v) { return v; }

}  // namespace nacre

#define EXPECT_RELATIVE(value, expected, tolerance) \
    EXPECT_NEAR(value, expected, (tolerance)*std::abs(double(expected)))
