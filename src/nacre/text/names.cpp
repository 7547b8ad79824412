#include "nacre/text/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>

namespace nacre {
namespace {

/// Least number of insertions, deletions, replacements and swaps of neighbours (optimal string
/// alignment: F. J. Damerau 1964, CACM 7(3)).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (c != ' ' && c != '-' && c != '_')
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return plain;
}

int find_name(std::string_view name, const KnownNames& known) {
    const std::string plain = plain_name(name);
    const auto at = std::find_if(known.begin(), known.end(),
                                 [&](std::string_view k) { return plain_name(k) == plain; });
    return at == known.end() ? -1 : static_cast<int>(at - known.begin());
}

std::string nearest_name(std::string_view word, const KnownNames& known) {
    const std::string wanted = plain_name(word);
    std::string_view best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string_view name : known) {
        const std::string candidate = plain_name(name);
        std::size_t distance = edit_distance(wanted, candidate);
        // A word cut short, such as `gauss` for `gaussian`, is plausible as well.
        if (wanted.size() >= 3 && candidate.starts_with(wanted))
            distance = std::min<std::size_t>(distance, 2);
        // A third of the letters may be wrong; beyond that the suggestion would puzzle.
        const std::size_t allowed =
            std::max<std::size_t>(std::max(wanted.size(), candidate.size()) / 3, 1);
        if (distance <= allowed && distance < candidate.size() && distance < best_distance) {
            best = name;
            best_distance = distance;
        }
    }
    return std::string(best);
}

std::string suggestion(std::string_view word, const KnownNames& known) {
    if (const std::string near = nearest_name(word, known); !near.empty())
        return fmt::format("; did you mean '{}'?", near);
    return known.empty() ? std::string() : fmt::format("; known are: {}", fmt::join(known, ", "));
}

std::string unknown_name(std::string_view what, std::string_view name, const KnownNames& known) {
    return fmt::format("unknown {} '{}'{}", what, name, suggestion(name, known));
}

std::string with_article(std::string_view noun) {
    const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun[0]) != noun.npos;
    // "rgb" is spoken letter by letter and so begins with a vowel.
    return fmt::format("{} {}", vowel || noun == "rgb" ? "an" : "a", noun);
}

}  // namespace nacre
