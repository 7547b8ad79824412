#pragma once
// Reference values of the parts of the models, tests/reflectance/data/families.json.
#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/math/vec.h"

namespace nacre::test {

inline const nlohmann::json& family_data() {
    static const nlohmann::json all = nlohmann::json::parse(
        std::ifstream(NACRE_SOURCE_DIR "/tests/reflectance/data/families.json"));
    return all;
}
inline Vec3d at_degrees(double theta, double phi = 0.) {
    const double d = std::numbers::pi / 180.;
    return {std::sin(theta * d) * std::cos(phi * d), std::sin(theta * d) * std::sin(phi * d),
            std::cos(theta * d)};
}

/// A vector of a scalar function: its parameters, and its values to 12 digits.
struct ScalarVector {
    const nlohmann::json& json;

    double operator()(const char* parameter) const { return json["params"][parameter]; }
    void expect(double value, const char* name) const {
        const double expected = json["values"][name];
        EXPECT_NEAR(value, expected, 1e-9 * std::abs(expected) + 1e-15) << json["id"] << name;
    }
    /// The directions of theta_i_deg, theta_o_deg, dphi_deg.
    Vec3d wi() const { return at_degrees((*this)("theta_i_deg")); }
    Vec3d wo() const { return at_degrees((*this)("theta_o_deg"), (*this)("dphi_deg")); }
};
template <class F>
void for_each_scalar(const char* group, F&& f) {
    int count = 0;
    for (const nlohmann::json& v : family_data()["scalars"][group]) {
        f(ScalarVector{v});
        ++count;
    }
    EXPECT_EQ(count, 12) << group;
}

}  // namespace nacre::test
