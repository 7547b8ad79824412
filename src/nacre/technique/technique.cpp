#include "nacre/technique/technique.h"

namespace nacre {

std::string Changes::text() const {
    std::string text;
    for (const auto& [is, name] : {std::pair(view, "view"),
                                   {light, "light"},
                                   {material, "material"},
                                   {geometry, "geometry"}})
        if (is) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

}  // namespace nacre
