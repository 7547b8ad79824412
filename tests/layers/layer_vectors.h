#pragma once
// Reference values of tests/layers/data/*.json, and what the tests of this room share.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "nacre/layers/layer.h"
#include "nacre/math/vec.h"
#include "tests/support/error_of.h"

namespace nacre::test {

inline const nlohmann::json& layer_vectors(const std::string& name) {
    static std::map<std::string, nlohmann::json> read;
    auto& values = read[name];
    if (values.is_null()) {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/layers/data/" + name + ".json");
        values = nlohmann::json::parse(file);
    }
    return values;
}

inline constexpr double degree = std::numbers::pi / 180.;

/// Unit vector at `theta` from the normal, towards azimuth `phi`, degrees.
inline Vec3d direction(double theta, double phi) {
    const double s = std::sin(theta * degree);
    return {s * std::cos(phi * degree), s * std::sin(phi * degree), std::cos(theta * degree)};
}

}  // namespace nacre::test
