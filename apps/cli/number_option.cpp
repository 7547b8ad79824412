#include "apps/cli/number_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/text/number.h"

namespace nacre::cli {
namespace {

std::string_view without_plus(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    return text;
}

/// Of 64 bits, with a sign or without.
template <class T>
std::optional<T> read(std::string_view text) {
    text = without_plus(text);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

/// Numbers that are short in full are written so: 65536, not 65540 or 6.5536e+04.
std::string written(double x) {
    return x == std::floor(x) && std::abs(x) < 1e7 ? fmt::format("{:.0f}", x)
                                                   : fmt::format("{:g}", x);
}

std::string described(const NumberRange& r) {
    if (r.low == any_number.low && r.high == any_number.high) return "";
    return fmt::format(" {} {} {} {}", r.low_open ? "above" : "from", written(r.low),
                       r.high_open ? "to below" : "to", written(r.high));
}

/// Declares the option; `read` has a value of the text or nothing, which ends in InputError.
template <class Read, class Value>
CLI::Option* declare(CLI::App& app, const std::string& names, const std::string& what, Read read,
                     Value& value, const std::string& description) {
    const std::string name = names.substr(names.find("--"));
    CLI::Option* option = app.add_option_function<std::string>(
        names,
        [&value, name, what, read](const std::string& text) {
            const auto found = read(text);
            if (!found) throw InputError(fmt::format("{}: '{}' is not a {}", name, text, what));
            value = static_cast<Value>(*found);
        },
        description);
    return option;
}

template <class Value>
CLI::Option* declare_number(CLI::App& app, const std::string& names, Value& value,
                            const NumberRange& r, const std::string& description) {
    const auto read = [r](const std::string& text) -> std::optional<double> {
        const std::optional<double> x = number_in(text);
        const bool within = x && (r.low_open ? *x > r.low : *x >= r.low) &&
                            (r.high_open ? *x < r.high : *x <= r.high);
        return within ? x : std::nullopt;
    };
    return declare(app, names, "number" + described(r), read, value, description)
        ->type_name("NUMBER");
}

template <class Value, class Wide>
CLI::Option* declare_whole(CLI::App& app, const std::string& names, Value& value, Wide low,
                           Wide high, const std::string& description) {
    const auto read_it = [low, high](const std::string& text) -> std::optional<Wide> {
        std::optional<Wide> x = read<Wide>(text);
        if (const auto whole = whole_in(text); !x && whole && *whole >= 0) x = Wide(*whole);
        return x && *x >= low && *x <= high ? x : std::nullopt;
    };
    return declare(app, names, fmt::format("whole number from {} to {}", low, high), read_it, value,
                   description)
        ->type_name("INT");
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
    const std::optional<double> value = parse_number(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> whole_in(std::string_view text) {
    if (const auto value = read<std::int64_t>(text)) return value;
    const std::optional<double> value = number_in(text);
    if (!value || *value != std::floor(*value) || std::abs(*value) > most_whole) return {};
    return static_cast<std::int64_t>(*value);
}

std::optional<double> seconds_in(std::string_view text) {
    if (const auto plain = number_in(text)) return *plain >= 0 ? plain : std::nullopt;
    constexpr std::pair<char, double> units[] = {{'h', 3600.}, {'m', 60.}, {'s', 1.}};
    double sum = 0;
    const auto* unit = std::begin(units);  // each once, the large ones first
    while (!text.empty()) {
        const std::size_t end = text.find_first_not_of("0123456789.");
        if (end == text.npos) return {};
        const auto number = number_in(text.substr(0, end));
        while (unit != std::end(units) && unit->first != text[end]) ++unit;
        if (!number || unit == std::end(units)) return {};
        sum += *number * unit++->second;
        text.remove_prefix(end + 1);
        if (text.empty()) return sum;
    }
    return {};
}

std::optional<double> share_in(std::string_view text) {
    if (text.ends_with('%')) {
        const auto percent = number_in(text.substr(0, text.size() - 1));
        if (!percent) return {};
        return *percent / 100;
    }
    const auto plain = number_in(text);
    return plain && *plain < 1 ? plain : std::nullopt;
}

CLI::Option* add_duration(CLI::App& app, const std::string& names, double& value,
                          const std::string& description) {
    const auto read_it = [](const std::string& text) -> std::optional<double> {
        const auto s = seconds_in(text);
        return s && *s > 0 && *s <= 1e9 ? s : std::nullopt;
    };
    return declare(app, names, "time above 0 to 1e+09 s, such as 90, 60s, 5m or 1h30m", read_it,
                   value, description)
        ->type_name("TIME");
}
CLI::Option* add_share(CLI::App& app, const std::string& names, double& value,
                       const std::string& description) {
    const auto read_it = [](const std::string& text) -> std::optional<double> {
        const auto s = share_in(text);
        return s && *s > 0 && *s <= 1 ? s : std::nullopt;
    };
    return declare(app, names, "share above 0 to 100%, such as 1% or 0.01", read_it, value,
                   description)
        ->type_name("SHARE");
}

CLI::Option* add_number(CLI::App& app, const std::string& names, double& value, NumberRange range,
                        const std::string& description) {
    return declare_number(app, names, value, range, description);
}
CLI::Option* add_number(CLI::App& app, const std::string& names, float& value, NumberRange range,
                        const std::string& description) {
    return declare_number(app, names, value, range, description);
}
CLI::Option* add_number(CLI::App& app, const std::string& names, std::optional<double>& value,
                        NumberRange range, const std::string& description) {
    return declare_number(app, names, value, range, description);
}
CLI::Option* add_whole(CLI::App& app, const std::string& names, int& value, std::int64_t low,
                       std::int64_t high, const std::string& description) {
    return declare_whole(app, names, value, low, high, description);
}
CLI::Option* add_whole(CLI::App& app, const std::string& names, std::uint64_t& value,
                       std::uint64_t low, std::uint64_t high, const std::string& description) {
    return declare_whole(app, names, value, low, high, description);
}

CLI::Option* add_threads(CLI::App& app, int& value) {
    return add_whole(app, "-t,--threads", value, 1, 65536, "threads (default: all cores)");
}
CLI::Option* add_samples(CLI::App& app, int& value, const std::string& description) {
    return add_whole(app, "--spp", value, 1, most_samples, description);
}
CLI::Option* add_seed(CLI::App& app, std::uint64_t& value, const std::string& description) {
    return add_whole(app, "--seed", value, std::uint64_t(0),
                     std::numeric_limits<std::uint64_t>::max(), description);
}
CLI::Option* add_timeout(CLI::App& app, double& value) {
    return add_duration(app, "--timeout", value,
                        "after which to stop and save what there is: seconds, or 5m, 1h30m");
}

}  // namespace nacre::cli
