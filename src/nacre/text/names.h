#pragma once
// Names that people type: compared without regard to case, spaces, dashes and underscores, and
// refused with the nearest known one.
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// Names that are known: whatever list of strings they stand in, to which this refers.
class KnownNames {
  public:
    KnownNames(std::initializer_list<std::string_view> names) : names_(names) {}
    template <class List>
    requires requires(const List& list) { std::string_view(*std::begin(list)); }
    KnownNames(const List& list) : names_(std::begin(list), std::end(list)) {}

    auto begin() const { return names_.begin(); }
    auto end() const { return names_.end(); }
    bool empty() const { return names_.empty(); }

  private:
    std::vector<std::string_view> names_;
};

/// Lower case, with spaces, dashes and underscores removed, so that `toWorld`, `to-world` and
/// `to_world` are the same word.
std::string plain_name(std::string_view name);

/// The position of `name` in `known`, compared by `plain_name`, or -1.
int find_name(std::string_view name, const KnownNames& known);

/// The nearest of `known` to `word`, if near enough to be a plausible misspelling, else empty: a
/// word that was cut short, or one in which at most a third of the letters are wrong (inserted,
/// left out, replaced, or two neighbours swapped).
std::string nearest_name(std::string_view word, const KnownNames& known);

/// What ends a sentence about a wrong word: "; did you mean 'x'?" or, if nothing is near, "; known
/// are: a, b, c" (empty if nothing is known).
std::string suggestion(std::string_view word, const KnownNames& known);

/// The sentence to refuse an unknown name with: "unknown <what> '<name>'; did you mean
/// '<nearest>'?" or "unknown <what> '<name>'; known are: a, b, c".
std::string unknown_name(std::string_view what, std::string_view name, const KnownNames& known);

/// "an integer", "a float": the word with its article.
std::string with_article(std::string_view noun);

}  // namespace nacre
