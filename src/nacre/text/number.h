#pragma once
// Numbers as words of text files, of which the whole word must be the number.
#include <cstdint>
#include <optional>
#include <string_view>

namespace nacre {

/// The whole of `word` as a decimal number: an optional sign, digits with at most one point, an
/// optional exponent. Nothing if any part of it is left over ("1.2.3", "1e", "0x10", "1,5").
/// What a double cannot hold becomes an infinity, or 0 if it is too small. Infinities and NaN, also
/// as C and Windows print them ("-nan(ind)", "1.#QNAN"), are numbers here that are not finite.
std::optional<double> parse_number(std::string_view word);

/// The whole of `word` as a decimal integer; nothing if it is not one or lies beyond 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace nacre
