#pragma once
// Numbers of the command line: read whole or refused, each within a stated range.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace nacre::cli {

/// The whole of the text as a decimal number, or nothing: no blanks, no prefixes of numbers,
/// nothing that is not finite.
std::optional<double> number_in(std::string_view text);
/// The same for whole numbers, also those written like 1e6.
std::optional<std::int64_t> whole_in(std::string_view text);

/// A time in seconds: "90", "60s", "5m", "1h", "1h30m", "0.5h"; nothing if it is none, or negative.
std::optional<double> seconds_in(std::string_view text);
/// A share: "1%", "0.5%", or 0.01, below 1, so that nobody's 1 is taken for 100 %.
std::optional<double> share_in(std::string_view text);

/// From `low` to `high`, or only between them where an end is open.
struct NumberRange {
    double low, high;
    bool low_open = false, high_open = false;
};
/// Any finite one: the range is for others to check.
inline constexpr NumberRange any_number{std::numeric_limits<double>::lowest(),
                                        std::numeric_limits<double>::max()};
inline constexpr double most_whole = 9007199254740992.;  ///< 2^53: all up to it are exact in double

/// Declares an option that takes a number within the range; `value` is left alone if it is not
/// given. Other text ends in InputError "--option: 'text' is not a number from LOW to HIGH".
CLI::Option* add_number(CLI::App& app, const std::string& names, double& value, NumberRange range,
                        const std::string& description);
CLI::Option* add_number(CLI::App& app, const std::string& names, float& value, NumberRange range,
                        const std::string& description);
CLI::Option* add_number(CLI::App& app, const std::string& names, std::optional<double>& value,
                        NumberRange range, const std::string& description);
/// The same for whole numbers.
CLI::Option* add_whole(CLI::App& app, const std::string& names, int& value, std::int64_t low,
                       std::int64_t high, const std::string& description);
CLI::Option* add_whole(CLI::App& app, const std::string& names, std::uint64_t& value,
                       std::uint64_t low, std::uint64_t high, const std::string& description);

/// The same for times of more than 0 to 1e9 seconds, and for shares of more than 0 to 100 %.
CLI::Option* add_duration(CLI::App& app, const std::string& names, double& value,
                          const std::string& description);
CLI::Option* add_share(CLI::App& app, const std::string& names, double& value,
                       const std::string& description);

// Options that several verbs have.
CLI::Option* add_threads(CLI::App& app, int& value);
CLI::Option* add_samples(CLI::App& app, int& value, const std::string& description);
CLI::Option* add_seed(CLI::App& app, std::uint64_t& value, const std::string& description);
CLI::Option* add_timeout(CLI::App& app, double& value);
inline constexpr int most_samples = 1 << 30;  ///< a pixel

}  // namespace nacre::cli
