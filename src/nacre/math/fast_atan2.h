#pragma once
// The angle of a vector in the plane for inner loops: float accuracy, no special cases.
#include "nacre/math/lanes.h"

namespace nacre {

/// atan2(y, x) in [-pi, pi] for float or packs of them; relative error below 3e-7, 0 at the origin.
/// The smaller over the larger of |y| and |x| goes through a polynomial for atan(t)/t, and the
/// eighth of the circle is undone.
template <class T>
T fast_atan2(T y, T x) {
    const T zero(0.f), pi(3.14159265f), half_pi(1.57079633f);
    const T ax = select(x < zero, -x, x), ay = select(y < zero, -y, y);
    const auto steep = ay > ax;
    const T high = select(steep, ay, ax), low = select(steep, ax, ay);
    const T t = low / select(high > T(1e-37f), high, T(1e-37f));
    const T z = t * t;
    T p(0.00284985202f);  // 1.5e-8; weighted minimax fit (Lawson iteration)
    for (const float c : {-0.0160684789f, 0.0426912759f, -0.0750427401f, 0.106409244f, -0.14203642f,
                          0.199926191f, -0.333330733f, 0.999999985f})
        p = p * z + T(c);
    T r = t * p;
    r = select(steep, half_pi - r, r);
    r = select(x < zero, pi - r, r);
    return select(y < zero, -r, r);
}

}  // namespace nacre
