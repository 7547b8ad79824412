#include "nacre/render/light_chooser.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace nacre {

namespace {

constexpr float uniform_share = 0.1f;

}  // namespace

LightChooser::LightChooser(std::span<const LightPtr> lights, const Box3f& scene_bounds,
                           bool skip_uniform) {
    const float radius = scene_bounds.empty() ? 1.f : 0.5f * length(scene_bounds.diagonal());
    float power = 0.f;
    for (const LightPtr& light : lights) {
        if (!(light->power() > 0.f) || (skip_uniform && light->is_uniform())) continue;
        Entry entry{light.get(), 0.f, {}, light->power(), 0.f, 0.f};
        const Box3f box = light->bounds();
        if (box.empty()) {
            // Power of a light at infinity is what falls on the scene's bounding sphere.
            entry.at_infinity =
                entry.power / (std::numbers::pi_v<float> * std::max(1e-12f, radius * radius));
        } else {
            entry.center = box.center();
            // Inside the light's bounds its distance says nothing more.
            entry.min_distance2 =
                std::max(0.25f * length_squared(box.diagonal()), 1e-6f * radius * radius);
        }
        power += entry.power;
        entries_.push_back(entry);
    }
    for (Entry& entry : entries_) {
        entry.by_power = entry.power / power;
        places_.emplace_back(entry.light, static_cast<std::uint32_t>(places_.size()));
    }
    std::ranges::sort(places_);
}

float LightChooser::importance(const Entry& entry, const Point3f& from) const {
    if (entries_.size() > max_ranked) return entry.by_power;
    if (entry.at_infinity > 0.f) return entry.at_infinity;
    const float d2 = std::max(entry.min_distance2, length_squared(entry.center - from));
    return entry.power / (std::numbers::pi_v<float> * d2);
}

float LightChooser::total(const Point3f& from) const {
    if (entries_.size() > max_ranked) return 1.f;
    float sum = 0.f;
    for (const Entry& entry : entries_) sum += importance(entry, from);
    return sum;
}

float LightChooser::mixed(float importance, float total) const {
    return uniform_share / static_cast<float>(entries_.size()) +
           (1.f - uniform_share) * importance / total;
}

LightChooser::Choice LightChooser::choose(const Point3f& from, float u) const {
    if (entries_.empty()) return {};
    if (entries_.size() == 1) return {entries_.front().light, 1.f};
    std::array<float, max_ranked> ranked;
    const bool rank = entries_.size() <= max_ranked;
    float sum = 0.f;
    for (std::size_t i = 0; rank && i < entries_.size(); ++i)
        sum += ranked[i] = importance(entries_[i], from);
    float p = 0.f;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        p = rank ? mixed(ranked[i], sum) : mixed(entries_[i].by_power, 1.f);
        if (u < p) return {entries_[i].light, p};
        u -= p;
    }
    return {entries_.back().light, p};  // rounding left a little over
}

float LightChooser::probability(const Point3f& from, const Light* light) const {
    const auto it = std::ranges::lower_bound(places_, light, std::less<>{},
                                             &std::pair<const Light*, std::uint32_t>::first);
    if (it == places_.end() || it->first != light) return 0.f;
    if (entries_.size() == 1) return 1.f;
    return mixed(importance(entries_[it->second], from), total(from));
}

}  // namespace nacre
