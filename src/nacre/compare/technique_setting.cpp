#include "nacre/compare/technique_setting.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

TechniqueChoice parse_choice(const std::vector<std::string_view>& words) {
    TechniqueChoice choice{std::string(words[0])};
    techniques().find(words[0]);  // before its options are looked at
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == 0 || equals == words[i].npos)
            throw InputError(
                fmt::format("'{}' of {} is not of the form name=value", words[i], words[0]));
        choice.options.emplace_back(words[i].substr(0, equals), words[i].substr(equals + 1));
    }
    choice = checked(choice);  // a wrong option is better known before than after an hour
    // What tells settings apart is named in one order.
    std::ranges::stable_partition(choice.options,
                                  [](const auto& option) { return option.first == "profile"; });
    return choice;
}

std::vector<TechniqueChoice> parse_list(std::string_view list) {
    std::vector<TechniqueChoice> choices;
    const auto add_variants = [&](const TechniqueDescription& technique) {
        for (TechniqueChoice& c : variants_of(technique)) choices.push_back(std::move(c));
    };
    if (list == "all") {
        for (const TechniqueDescription* t : techniques()) add_variants(*t);
        return choices;
    }
    for (const std::string_view item : split_words(list, ",")) {
        const std::vector<std::string_view> words = split_words(item, ":");
        if (words.size() == 1)
            add_variants(techniques().find(words[0]));
        else if (!words.empty())
            choices.push_back(parse_choice(words));
    }
    if (choices.empty())
        throw InputError("no technique is named; write all, or see 'nacre models'");
    return choices;
}

}  // namespace

std::string TechniqueSetting::options() const {
    std::string text;
    for (const auto& [name, value] : choice.options)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
    return text;
}

std::string TechniqueSetting::id() const {
    const std::string o = options();
    return fmt::format("{}{}{} {} spp", choice.technique, o.empty() ? "" : " ", o, samples);
}

std::string TechniqueSetting::arguments() const {
    std::string text = "--technique " + choice.technique;
    for (const auto& [name, value] : choice.options)
        text +=
            name == "profile" ? " --profile " + value : fmt::format(" --set {}={}", name, value);
    return text + fmt::format(" --spp {}", samples);
}

std::vector<TechniqueSetting> parse_techniques(std::string_view list,
                                               const std::vector<int>& samples) {
    std::vector<TechniqueSetting> settings;
    for (const TechniqueChoice& choice : parse_list(list))
        for (const int n : samples) {
            if (n < 1) throw InputError(fmt::format("{} samples a pixel make no picture", n));
            const TechniqueSetting setting{choice, n};
            const bool twice = std::ranges::any_of(
                settings, [&](const TechniqueSetting& s) { return s.id() == setting.id(); });
            if (twice) throw InputError(fmt::format("'{}' is asked for twice", setting.id()));
            settings.push_back(setting);
        }
    return settings;
}

}  // namespace nacre
