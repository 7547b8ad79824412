#include "apps/cli/direction.h"

#include "apps/cli/number_option.h"
#include "nacre/math/error.h"

namespace nacre::cli {

Vec3d parse_direction(const std::string& text, const char* option) {
    Vec3d w;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t end = k < 2 ? text.find(',', begin) : text.size();
        const auto x = end == text.npos
                           ? std::nullopt
                           : number_in(std::string_view(text).substr(begin, end - begin));
        if (!x)
            throw InputError(fmt::format(
                "{} '{}' is not a direction; write x,y,z, such as 0.6,0,0.8", option, text));
        w[k] = *x;
        begin = end + 1;
    }
    if (!(length(w) > 0.) || !std::isfinite(length(w)))
        throw InputError(fmt::format("{} '{}' has no direction", option, text));
    return normalize(w);
}

}  // namespace nacre::cli
