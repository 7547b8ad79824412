#include "nacre/text/number.h"

#include <charconv>
#include <limits>

namespace nacre {
namespace {

bool remove_plus(std::string_view& word) {
    if (!word.starts_with('+')) return true;
    word.remove_prefix(1);
    return !word.starts_with('-') && !word.starts_with('+');
}

// What is beyond a double's range is too large or too small; the power of ten of the first digit
// tells which.
double beyond_range(std::string_view word) {
    const double sign = word.starts_with('-') ? -1 : 1;
    std::int64_t power = 0;
    bool point = false, begun = false;
    std::size_t i = 0;
    for (; i < word.size() && (word[i] | 0x20) != 'e'; ++i) {
        if (word[i] == '.') point = true;
        if (word[i] < '0' || word[i] > '9') continue;
        begun = begun || word[i] != '0';
        if (begun && !point) ++power;
        if (!begun && point) --power;
    }
    if (!begun) return sign * 0.;
    if (i < word.size()) {
        std::string_view digits = word.substr(i + 1);
        const bool negative = digits.starts_with('-');
        if (negative || digits.starts_with('+')) digits.remove_prefix(1);
        // Words are shorter than the largest exponents that are read here.
        std::int64_t exponent = std::int64_t{1} << 60;
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
        exponent = exponent > (std::int64_t{1} << 60) ? std::int64_t{1} << 60 : exponent;
        power += negative ? -exponent : exponent;
    }
    return sign * (power > 0 ? std::numeric_limits<double>::infinity() : 0.);
}

// As Microsoft's library printed what is not a number until 2015.
std::optional<double> not_finite_on_windows(std::string_view word) {
    const double sign = word.starts_with('-') ? -1 : 1;
    if (sign < 0) word.remove_prefix(1);
    if (word.starts_with("1.#INF")) return sign * std::numeric_limits<double>::infinity();
    for (const std::string_view name : {"1.#IND", "1.#QNAN", "1.#SNAN"})
        if (word.starts_with(name)) return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
    if (!remove_plus(word)) return std::nullopt;
    double value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return not_finite_on_windows(word);
    return error == std::errc{} ? value : beyond_range(word);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    if (!remove_plus(word)) return std::nullopt;
    std::int64_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error != std::errc{}) return std::nullopt;
    return value;
}

}  // namespace nacre
