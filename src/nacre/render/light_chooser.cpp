#include "nacre/render/light_chooser.h"

#include <algorithm>

namespace nacre {

LightChooser::LightChooser(std::span<const LightPtr> lights) {
    double total = 0;
    for (const LightPtr& light : lights) total += std::max(0.f, light->power());
    if (!(total > 0)) return;
    const double uniform = 1.0 / static_cast<double>(lights.size());
    double sum = 0;
    for (const LightPtr& light : lights) {
        const double p = 0.5 * uniform + 0.5 * std::max(0.f, light->power()) / total;
        choices_.push_back({light.get(), static_cast<float>(p)});
        cumulative_.push_back(static_cast<float>(sum += p));
    }
    by_address_ = choices_;
    std::ranges::sort(by_address_, std::less<>{}, &Choice::light);
}

LightChooser::Choice LightChooser::choose(float u) const {
    if (choices_.empty()) return {};
    const auto it = std::ranges::upper_bound(cumulative_, u);
    return choices_[std::min<std::size_t>(static_cast<std::size_t>(it - cumulative_.begin()),
                                          choices_.size() - 1)];
}

float LightChooser::probability(const Light* light) const {
    const auto it = std::ranges::lower_bound(by_address_, light, std::less<>{}, &Choice::light);
    return it != by_address_.end() && it->light == light ? it->probability : 0.f;
}

}  // namespace nacre
