#pragma once
// Values beyond the largest angles that were measured: those at these angles hold.
#include <cmath>
#include <numbers>

#include "nacre/measured/measured.h"

namespace nacre {

/// The direction with the same azimuth whose angle to the normal is at most `degrees`.
template <class T>
Vec3<T> held(const Vec3<T>& w, double degrees) {
    const T least = T(std::cos(degrees * std::numbers::pi / 180.));
    if (std::abs(w.z) >= least) return w;
    const T s = std::sqrt((T(1) - least * least) / (w.x * w.x + w.y * w.y));
    return {w.x * s, w.y * s, std::copysign(least, w.z)};
}

/// eval(wi, wo), or that of the directions held where it says false; false where both do.
template <class T, class Eval>
bool eval_held(const MeasuredInfo& info, const Vec3<T>& wi, const Vec3<T>& wo, Eval&& eval) {
    if (eval(wi, wo)) return true;
    const Vec3<T> near_wi = held(wi, info.largest_incidence);
    const Vec3<T> near_wo = held(wo, info.largest_exit);
    if (near_wi == wi && near_wo == wo) return false;
    return eval(near_wi, near_wo);
}

}  // namespace nacre
