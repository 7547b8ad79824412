#include "nacre/geometry/weld.h"

#include <bit>

#include "nacre/math/random.h"

namespace nacre {
namespace {

std::size_t hash(const Vec3f& p) {
    return stream_key(std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                      std::bit_cast<std::uint32_t>(p.z));
}

}  // namespace

void Welder::grow() {
    slots_.assign(std::max<std::size_t>(64, slots_.size() * 2), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t slot = hash(points[i]) & (slots_.size() - 1);
        while (slots_[slot]) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
}

std::uint32_t Welder::insert(Vec3f p) {
    // Adding +0 turns -0 into +0, which hash alike.
    p = {p.x + 0.f, p.y + 0.f, p.z + 0.f};
    if (points.size() * 3 >= slots_.size() * 2) grow();
    std::size_t slot = hash(p) & (slots_.size() - 1);
    for (; slots_[slot]; slot = (slot + 1) & (slots_.size() - 1))
        if (points[slots_[slot] - 1] == p) return slots_[slot] - 1;
    points.push_back(p);
    slots_[slot] = static_cast<std::uint32_t>(points.size());
    return slots_[slot] - 1;
}

}  // namespace nacre
