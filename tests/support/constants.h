#pragma once
// Constants of several tests. The tests of a room are compiled several files in one unit
// (tests/CMakeLists.txt), where a name in an anonymous namespace can be defined once only.
#include <limits>
#include <numbers>

namespace nacre {

inline constexpr double pi = std::numbers::pi;
inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace nacre
