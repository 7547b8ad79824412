#pragma once
// Reference values of tests/layers/data/adding_doubling.json, and what the tests of slabs share.
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "nacre/layers/layer.h"
#include "tests/support/error_of.h"

namespace nacre::test {

inline const nlohmann::json& slab_reference() {
    static const nlohmann::json values = [] {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/layers/data/adding_doubling.json");
        return nlohmann::json::parse(file);
    }();
    return values;
}

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// A layer of 1 mm, or a half space.
inline Layer layer_of(double albedo, double tau, double g, double eta) {
    if (std::isinf(tau)) return {albedo, 1. - albedo, g, infinite, eta};
    return {albedo * tau, (1. - albedo) * tau, g, 1., eta};
}

inline double cosine_of(double degrees) { return std::cos(degrees * std::numbers::pi / 180.); }

}  // namespace nacre::test
