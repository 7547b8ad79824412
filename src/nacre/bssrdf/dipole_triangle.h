#pragma once
// The classical dipole integrated over a triangle: what a point receives from a uniformly lit
// patch.
//
//   T. Mertens, J. Kautz, P. Bekaert, H.-P. Seidel, F. Van Reeth 2003, Interactive Rendering of
//   Translucent Deformable Objects, EGSR 2003.
//
// In polar coordinates about the foot of the point on the triangle's plane the radial integral is
// the dipole's cumulative C in closed form, which leaves a line integral around the edges:
//   integral over the triangle of R_d dA = sum over edges of integral of
//     [C(sqrt(rho^2 + h^2)) - C(h)] / (2 pi) dtheta,   rho = p / cos(theta),
// h the height over the plane, p the distance of the foot from the edge, theta from the foot's
// perpendicular on the edge. Feet inside the triangle are met without a case of their own: the
// signed angles then add up to a full turn.
#include <array>
#include <cmath>
#include <numbers>

#include "nacre/bssrdf/dipole.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/vec.h"

namespace nacre {

/// Integral of R_d(|x - point|) over the points x of the triangle, distances in mm through space as
/// BSSRDFs are commonly used; dimensionless, >= 0 whatever the winding, 0 for a degenerate
/// triangle. `rule` is used on panels of each edge; 8 nodes give 1e-8 of the dipole's total. Lanes
/// of T share the geometry.
template <class T>
T dipole_triangle_integral(const Dipole<T>& dipole, const Vec3d& point,
                           const std::array<Vec3d, 3>& corners, const GaussLegendre& rule) {
    const Vec3d area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = length(area);
    if (!(size > 0.)) return T(0);
    const Vec3d normal = area / size;
    const double height = dot(corners[0] - point, normal), h2 = height * height;
    const T at_foot = dipole.cumulative(T(h2));

    T sum(0);
    for (int i = 0; i < 3; ++i) {
        const Vec3d a = corners[i] - point, b = corners[(i + 1) % 3] - point;
        const Vec3d along = normalize(b - a);
        const double p = dot(cross(normal, along), a), apart = std::abs(p);
        // An edge whose line passes through the foot spans no angle.
        if (apart < 1e-12 * length(b - a)) continue;
        // u with tan(theta) = sinh(u): then rho = p cosh(u), dtheta = du / cosh(u), and what
        // changes over decades of rho does so over a few units of u.
        const double from = std::asinh(dot(a, along) / apart);
        const double to = std::asinh(dot(b, along) / apart);
        const int panels = 1 + static_cast<int>(to - from);
        const double width = (to - from) / panels;
        T edge(0);
        for (int k = 0; k < panels; ++k)
            for (std::size_t j = 0; j < rule.node.size(); ++j) {
                const double c = std::cosh(from + width * (k + 0.5 + 0.5 * rule.node[j]));
                edge += T(0.5 * width * rule.weight[j] / c) *
                        (dipole.cumulative(T(p * p * c * c + h2)) - at_foot);
            }
        // The foot is left of the edge, seen against the normal, where p is negative.
        sum += p < 0. ? edge : T(-edge);
    }
    return T(0.5 * std::numbers::inv_pi) * sum;
}

}  // namespace nacre
