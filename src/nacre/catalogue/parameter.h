#pragma once
// What is said of one parameter: of a model, a technique, a profile. Plain data, given once, in its
// owner's own file; the scene reader, the command line, checks, help and documentation read it.
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

enum class ParameterKind {
    spectrum,    ///< a number a wavelength (colour); in models a member of type P
    scalar,      ///< one number for all wavelengths (shape); in models a member of type S
    choice,      ///< one of named options; an enum of the owner, in the order of `choices`
    integer,     ///< a whole number; in models a member of type int
    wavelength,  ///< the wavelength itself, nm; 0, the default, is that of the light; type P
};

struct Choice {
    std::string_view name;
    std::string_view meaning;
    std::vector<std::string_view> aliases = {};  ///< words of other renderers and of the vectors
};

struct Parameter {
    std::string_view name;
    std::string_view meaning;
    ParameterKind kind = ParameterKind::scalar;
    std::string_view unit = "";  ///< empty: none
    double low = 0., high = 1.;  ///< the range, both ends included unless said otherwise
    bool above_low = false;      ///< `low` itself is not allowed
    bool below_high = false;     ///< nor is `high`
    double otherwise = 0.;       ///< default; of a choice, its position
    std::vector<Choice> choices = {};
    /// Other names that mean this parameter: those of other renderers, of the vectors. An alias
    /// that several parameters list sets all of them.
    std::vector<std::string_view> aliases = {};
};

/// A choice with its words; `otherwise` is the position of the default.
inline Parameter choice_parameter(std::string_view name, std::string_view meaning,
                                  std::vector<Choice> choices, int otherwise = 0,
                                  std::vector<std::string_view> aliases = {}) {
    return {.name = name,
            .meaning = meaning,
            .kind = ParameterKind::choice,
            .high = double(choices.size()) - 1.,
            .otherwise = double(otherwise),
            .choices = std::move(choices),
            .aliases = std::move(aliases)};
}

/// How messages and manual pages write a range: "(0, 10]". An infinite end is never included.
std::string range_text(const Parameter& parameter);

/// The default as people write it: "0.5", or the word of a choice.
std::string default_text(const Parameter& parameter);

// What is wrong is thrown as InputError that begins with the owner of the parameter, "ward: ".

/// Throws unless the number is finite and within the range; whole for integers.
void check_range(std::string_view owner, const Parameter& parameter, double value);

/// Position of a choice by its name or alias, regardless of case, blanks, dashes and underscores;
/// throws with the nearest word if there is none.
int find_choice(std::string_view owner, const Parameter& parameter, std::string_view word);

/// Positions of the parameters that a name means: the one of that name, or all that have it as an
/// alias. As it is written comes before regardless of case, blanks, dashes and underscores. Throws
/// with the nearest name if there is none.
std::vector<int> find_parameters(std::string_view owner, std::span<const Parameter> parameters,
                                 std::string_view name);

}  // namespace nacre
