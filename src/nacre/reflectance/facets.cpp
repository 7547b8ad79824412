#include "nacre/reflectance/facets.h"

#include "nacre/reflectance/registry.h"

namespace nacre {

void give_whole_highlight(std::vector<Setting>& settings) {
    for (const Setting& s : settings)
        if (s.name == "ks") return;
    settings.push_back({"ks", 1.});
}

}  // namespace nacre
