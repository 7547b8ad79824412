#include "nacre/reflectance/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre {
namespace {

std::string text_of(const Condition& c) {
    if (!c.same_as.empty()) return fmt::format("{} = {}", c.parameter, c.same_as);
    if (!c.choices.empty()) return fmt::format("{} {}", c.parameter, fmt::join(c.choices, " or "));
    if (c.low == c.high) return fmt::format("{} = {}", c.parameter, c.low);
    return c.low > 0. ? fmt::format("{} from {} to {}", c.parameter, c.low, c.high)
                      : fmt::format("{} up to {}", c.parameter, c.high);
}

}  // namespace

std::string condition_text(const Behaviour& behaviour) {
    std::vector<std::string> parts;
    for (const Condition& c : behaviour.conditions) parts.push_back(text_of(c));
    if (!behaviour.joint.text.empty()) parts.emplace_back(behaviour.joint.text);
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string claim_text(const Behaviour& behaviour) {
    const std::string condition = condition_text(behaviour);
    if (condition.empty()) return std::string(behaviour.options);
    return fmt::format("{}{}for {}", behaviour.options, behaviour.options.empty() ? "" : ", ",
                       condition);
}

}  // namespace nacre
