#pragma once
// The reference vectors of the reflectance models.
#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/math/vec.h"

namespace nacre::test {

/// Null if the shared data are absent.
inline nlohmann::json reflectance_vectors() {
    std::ifstream file(NACRE_SHARED_DIR "/reference/reflectance_vectors.json");
    return file ? nlohmann::json::parse(file) : nlohmann::json();
}

inline Vec3d vector(const nlohmann::json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

}  // namespace nacre::test
