#pragma once
// Reference values of tests/optics/data/scattering_optics.json.
#include <fstream>
#include <nlohmann/json.hpp>

namespace nacre::test {

inline const nlohmann::json& optics_reference() {
    static const nlohmann::json values = [] {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/optics/data/scattering_optics.json");
        return nlohmann::json::parse(file);
    }();
    return values;
}

}  // namespace nacre::test
