#pragma once
// Orthonormal frames. Local coordinates have z along the normal, as every model of nacre expects.
#include "nacre/math/vec.h"

namespace nacre {

/// Right-handed orthonormal frame (s, t, n).
template <class T>
struct Frame {
    Vec3<T> s{T(1), T(0), T(0)}, t{T(0), T(1), T(0)}, n{T(0), T(0), T(1)};

    /// Any frame around the unit vector `n`, continuous but for one sign change at n.z = 0.
    /// Duff et al. 2017, Building an Orthonormal Basis, Revisited, JCGT 6(1).
    static Frame around(const Vec3<T>& n) {
        using std::copysign;
        const T sign = copysign(T(1), n.z);
        const T a = T(-1) / (sign + n.z);
        const T b = n.x * n.y * a;
        return {{T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x},
                {b, sign + n.y * n.y * a, -n.y},
                n};
    }

    /// Frame around the unit vector `n` whose s lies in the plane of n and `tangent`; falls back to
    /// `around` where the tangent is parallel to n or zero.
    static Frame with_tangent(const Vec3<T>& n, const Vec3<T>& tangent) {
        const Vec3<T> s = tangent - n * dot(n, tangent);
        const T len2 = dot(s, s);
        if (!(len2 > T(1e-12) * dot(tangent, tangent))) return around(n);
        using std::sqrt;
        const Vec3<T> unit = s * (T(1) / sqrt(len2));
        return {unit, cross(n, unit), n};
    }

    Vec3<T> to_local(const Vec3<T>& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    Vec3<T> to_world(const Vec3<T>& v) const { return s * v.x + t * v.y + n * v.z; }
};

using Framef = Frame<float>;

}  // namespace nacre
