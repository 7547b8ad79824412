#pragma once
// What the papers themselves printed about speed: on their objects, their machines, in their years.
// Facts to stand beside measured ones, never among them.
#include <array>
#include <span>
#include <string_view>

namespace nacre {

struct PrintedNumber {
    std::string_view technique, object, precomputation, speed, hardware, may_change;
};

std::span<const PrintedNumber> printed_numbers();

}  // namespace nacre
