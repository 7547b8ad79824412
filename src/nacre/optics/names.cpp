#include "nacre/optics/names.h"

#include <fmt/format.h>

#include <cctype>
#include <vector>

namespace nacre {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (c != ' ' && c != '-' && c != '_')
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return plain;
}

int find_name(std::string_view name, std::span<const std::string_view> known) {
    const std::string plain = plain_name(name);
    for (std::size_t i = 0; i < known.size(); ++i)
        if (plain_name(known[i]) == plain) return static_cast<int>(i);
    return -1;
}

std::string unknown_name(std::string_view what, std::string_view name,
                         std::span<const std::string_view> known) {
    const std::string plain = plain_name(name);
    std::size_t best = plain.size() + 1;
    std::string_view nearest;
    for (const std::string_view k : known) {
        const std::string p = plain_name(k);
        const std::size_t d = edit_distance(plain, p);
        if (d < best && 3 * d <= p.size()) best = d, nearest = k;
    }
    const std::string hint =
        nearest.empty() ? std::string() : fmt::format("did you mean \"{}\"? ", nearest);
    return fmt::format("unknown {} \"{}\": {}known are {}", what, name, hint,
                       fmt::join(known, ", "));
}

}  // namespace nacre
