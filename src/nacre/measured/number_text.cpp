#include "nacre/measured/number_text.h"

#include <numbers>

#include "nacre/text/lines.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// A word as messages show it: not too long, and without what no terminal shows.
std::string shown(std::string_view word) {
    std::string r;
    for (const char c : word.substr(0, 24)) r += c >= 32 && c < 127 ? c : '?';
    return word.size() > 24 ? r + "..." : r;
}

double number_of(const MeasuredSource& source, std::size_t line, std::string_view word) {
    const auto value = parse_number(word);
    if (value && !std::isinf(*value)) return *value;
    const bool decimal_comma = word.find(',') != word.npos && word.find('.') == word.npos;
    source.fail(line, word.empty() ? "a number is missing between two commas"
                                   : fmt::format("'{}' is {}{}", shown(word),
                                                 value ? "no finite number" : "no number",
                                                 decimal_comma ? "; write decimal points" : ""));
}

}  // namespace

std::vector<std::string_view> comma_words(std::string_view text) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::string_view word = text.substr(0, comma);
        while (!word.empty() && is_blank(word.front())) word.remove_prefix(1);
        while (!word.empty() && is_blank(word.back())) word.remove_suffix(1);
        words.push_back(word);
        if (comma == text.size()) return words;
        text.remove_prefix(comma + 1);
    }
}

void take_numbers(const MeasuredSource& source, std::size_t line, std::string_view text,
                  bool commas, std::vector<double>& numbers) {
    if (commas)
        for (const std::string_view word : comma_words(text))
            numbers.push_back(number_of(source, line, word));
    else
        for (std::string_view word = take_word(text); !word.empty(); word = take_word(text))
            numbers.push_back(number_of(source, line, word));
}

double checked_theta(const MeasuredSource& source, std::size_t line, std::string_view name,
                     double theta, double limit) {
    constexpr double rounding = 1e-4;
    if (!(theta >= -rounding && theta <= limit + rounding))
        source.fail(line,
                    fmt::format("{} = {:g} lies outside 0 to {:.6g} radians{}", name, theta, limit,
                                theta > limit && theta <= 180. ? "; is it in degrees?" : ""));
    return std::clamp(theta, 0., limit);
}

double checked_phi(const MeasuredSource& source, std::size_t line, std::string_view name,
                   double phi) {
    if (!(std::abs(phi) <= 4. * pi))
        source.fail(line, fmt::format("{} = {:g} lies outside two turns{}", name, phi,
                                      std::isfinite(phi) ? "; is it in degrees?" : ""));
    return phi;
}

Vec3d polar_direction(double theta, double phi) {
    const double s = std::sin(theta);
    return {s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
}

double theta_of(const Vec3d& w) { return std::atan2(std::hypot(w.x, w.y), w.z); }

}  // namespace nacre
