#include "apps/cli/plain_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

void print_plain(const ordered_json& json, int indent = 0) {
    for (const auto& [key, value] : json.items()) {
        const std::string label = json.is_array() ? "-" : key + ":";
        const bool flat = value.is_primitive() ||
                          (value.is_array() && std::all_of(value.begin(), value.end(),
                                                           [](auto& v) { return v.is_number(); }));
        fmt::print("{:{}}{}{}\n", "", indent, label,
                   !flat               ? ""
                   : value.is_string() ? " " + value.template get<std::string>()
                                       : " " + value.dump());
        if (!flat) print_plain(value, indent + 2);
    }
}

}  // namespace

void print_found(const ordered_json& json, bool as_json) {
    if (as_json)
        fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    else
        print_plain(json);
}

}  // namespace nacre::cli
