#include "apps/cli/model_list.h"

#include <algorithm>
#include <cctype>

#include "nacre/math/error.h"
#include "nacre/text/split_words.h"

namespace nacre::cli {

std::vector<ModelSpec> parse_models(const std::string& option, const std::string& text) {
    std::vector<std::string> items;
    for (const std::string_view view : split_words(text, ",")) {
        std::string word(view.substr(std::min(view.find_first_not_of(' '), view.size())));
        if (word.empty()) continue;
        const bool number = !std::isalpha(static_cast<unsigned char>(word[0]));
        std::ranges::replace(word, ':', ' ');
        if (number && !items.empty())
            items.back() += "," + word;
        else
            items.push_back(word);
    }
    if (items.empty())
        throw InputError(fmt::format("{}: no model is named; see 'nacre models'", option));
    std::vector<ModelSpec> specs;
    for (const std::string& item : items) specs.push_back(parse_model_spec(item));
    return specs;
}

}  // namespace nacre::cli
