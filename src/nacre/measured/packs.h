#pragma once
// Directions sixteen at a time: what bulk evaluation of measured reflectance has in common with
// single calls (half_vector_square.h, surface.h), over packs. Only for the .cpp files of this room.
#include <algorithm>
#include <numbers>

#include "nacre/math/fast_atan2.h"
#include "nacre/math/gather.h"
#include "nacre/math/vec.h"

namespace nacre {

inline constexpr int pack_size = 16;
using Pack = Lanes<float, pack_size>;
using PackInts = IntLanes<pack_size>;
using PackMask = Mask<float, pack_size>;
using PackVec = Vec3<Pack>;

/// Calls step(first, count) for each pack of `n`; count is below pack_size in the last one only.
template <class Step>
void for_each_pack(std::size_t n, Step&& step) {
    for (std::size_t first = 0; first < n; first += pack_size)
        step(first, int(std::min<std::size_t>(pack_size, n - first)));
}

/// The numbers of the lanes; those beyond `count` are the last one again.
inline PackInts lane_numbers(int count) {
    PackInts at{};
    for (int i = 0; i < pack_size; ++i) at[i] = std::min(i, count - 1);
    return at;
}

inline PackVec load(const Vec3f* from, int count) {
    static_assert(sizeof(Vec3f) == 3 * sizeof(float));
    const PackInts at = lane_numbers(count) * 3;
    const float* numbers = &from->x;
    return {gather<pack_size>(numbers, at), gather<pack_size>(numbers + 1, at),
            gather<pack_size>(numbers + 2, at)};
}
inline Vec2<Pack> load(const Vec2f* from, int count) {
    const PackInts at = lane_numbers(count) * 2;
    return {gather<pack_size>(&from->x, at), gather<pack_size>(&from->x + 1, at)};
}
inline void store(Pack x, float* to, int count) {
    float all[pack_size];
    x.store(all);
    std::copy_n(all, count, to);
}
inline void store(const PackVec& w, Vec3f* to, int count) {
    for (int i = 0; i < count; ++i) to[i] = {w.x[i], w.y[i], w.z[i]};
}

inline PackMask above(const PackVec& w) { return w.z > Pack(0.f); }
inline Pack if_else(PackMask m, float yes, float no) { return select(m, Pack(yes), Pack(no)); }

inline PackVec normalized(const PackVec& w) { return w * (Pack(1.f) / fast_sqrt(dot(w, w))); }
inline Pack sin_theta_of(const PackVec& w) { return fast_sqrt(w.x * w.x + w.y * w.y); }

struct PackPolar {
    Pack theta, phi;
};
inline PackPolar polar_of(const PackVec& w) {
    return {fast_atan2(sin_theta_of(w), w.z), fast_atan2(w.y, w.x)};
}
inline Pack square_x(Pack theta) {
    return fast_sqrt(theta * Pack(2.f / std::numbers::pi_v<float>));
}
inline Pack square_y(Pack phi) {
    constexpr float pi = std::numbers::pi_v<float>;
    const Pack turns = (phi + Pack(pi)) * Pack(1.f / (2.f * pi));
    return turns - floor(turns);
}
inline PackVec square_vector(Pack x, Pack y, Pack phi) {
    const auto polar = fast_unit_circle(Pack(0.25f) * x * x);
    const Pack turns = y + Pack(0.5f) + phi * Pack(0.5f * std::numbers::inv_pi_v<float>);
    const auto around = fast_unit_circle(turns - floor(turns));
    return {polar.sin * around.cos, polar.sin * around.sin, polar.cos};
}
inline Pack reflected_solid_angle(Pack x, Pack sin_theta_h, Pack w_h) {
    constexpr float pi = std::numbers::pi_v<float>;
    return max(Pack(2.f * pi * pi) * x * sin_theta_h, Pack(1e-6f)) * Pack(4.f) * w_h;
}

}  // namespace nacre
