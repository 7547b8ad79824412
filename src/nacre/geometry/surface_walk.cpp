#include "nacre/geometry/surface_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre {
namespace {

constexpr int kMostCrossings = 1000;

SideIndex next_side(SideIndex side) { return side % 3 == 2 ? side - 2 : side + 1; }

// Parameter in [0, 1] of the point of the segment a, a + e that is nearest to p.
double along_segment(const Vec3d& p, const Vec3d& a, const Vec3d& e) {
    return std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
}

}  // namespace

Vec3d SurfaceWalk::position(const SurfacePlace& place) const {
    const Vec3d a = corner(3 * place.triangle);
    return a + (corner(3 * place.triangle + 1) - a) * place.u +
           (corner(3 * place.triangle + 2) - a) * place.v;
}

// No direction can be told apart in it: height below 1e-12 of the longest side.
bool SurfaceWalk::flat(std::uint32_t triangle) const {
    const Vec3d a = corner(3 * triangle), ab = corner(3 * triangle + 1) - a,
                ac = corner(3 * triangle + 2) - a;
    const double longest = std::max({dot(ab, ab), dot(ac, ac), length_squared(ac - ab)});
    return !(length(cross(ab, ac)) > 1e-12 * longest);
}

// The side on which a walk arrives that leaves its triangle by `side` at p; kNoSide at a boundary.
SideIndex SurfaceWalk::across(SideIndex side, const Vec3d& p) const {
    for (int i = 0; i < kMostCrossings; ++i) {
        side = neighbours_[side];
        if (side == kNoSide || !flat(side / 3)) return side;
        // A flat triangle is left by that of its other sides which p lies on.
        const auto distance = [&](SideIndex s) {
            const Vec3d a = corner(s), e = corner(next_side(s)) - a;
            return length_squared(p - a - e * along_segment(p, a, e));
        };
        const SideIndex one = next_side(side), other = next_side(one);
        side = distance(one) <= distance(other) ? one : other;
    }
    return kNoSide;
}

SurfacePlace SurfaceWalk::walk(SurfacePlace from, Vec3d left) const {
    SurfacePlace at = from;
    int along = -1;  // corner opposite to the boundary edge that the walk follows
    for (int crossing = 0; crossing < kMostCrossings; ++crossing) {
        const SideIndex first = 3 * at.triangle;
        const Vec3d a = corner(first), e1 = corner(first + 1) - a, e2 = corner(first + 2) - a;
        const Vec3d n = cross(e1, e2);
        const double du = dot(cross(left, e2), n) / dot(n, n);
        const double dv = dot(cross(e1, left), n) / dot(n, n);
        std::array<double, 3> b = {std::max(0.0, 1 - at.u - at.v), at.u, at.v};
        const std::array<double, 3> db = {-du - dv, du, dv};
        double step = 1;
        int zero = -1;  // the corner whose weight vanishes first
        for (int k = 0; k < 3; ++k)
            if (k != along && db[k] < 0 && b[k] < -db[k] * step) step = b[k] / -db[k], zero = k;
        for (int k = 0; k < 3; ++k) b[k] = std::max(0.0, b[k] + step * db[k]);
        if (zero >= 0) b[zero] = 0;
        if (along >= 0) b[along] = 0;
        const double sum = b[0] + b[1] + b[2];
        at.u = b[1] / sum;
        at.v = b[2] / sum;
        if (zero < 0) return at;

        left *= 1 - step;
        const SideIndex side = first + SideIndex(zero + 1) % 3;
        const Vec3d edge = normalize(corner(next_side(side)) - corner(side));
        const double forward = dot(left, edge);
        const Vec3d p = position(at);
        const SideIndex arrival = across(side, p);
        if (arrival == kNoSide) {
            if (along >= 0 && step == 0) return at;  // in the corner of two boundary edges
            left = edge * forward;
            along = zero;
            continue;
        }
        const double outward = length(left - edge * forward);
        const Vec3d q = corner(arrival), f = corner(next_side(arrival)) - q;
        const Vec3d inside = corner(next_side(next_side(arrival))) - q;
        const Vec3d inward = normalize(inside - f * (dot(inside, f) / dot(f, f)));
        left = edge * forward + inward * outward;
        const double s = along_segment(p, q, f);
        std::array<double, 3> c{};
        c[arrival % 3] = 1 - s;
        c[(arrival + 1) % 3] = s;
        at = {arrival / 3, c[1], c[2]};
        along = -1;
    }
    return at;
}

}  // namespace nacre
