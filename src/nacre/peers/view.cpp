#include "nacre/peers/view.h"

#include <array>
#include <cmath>

namespace nacre {
namespace {

constexpr Vec2f lens_middle{0.5f, 0.5f}, lens_edge{1.f, 0.5f};

/// Lengths of the unit vectors a, b, c that make a + b = c + d true for corners of a parallelogram,
/// by Cramer's rule, with d of length 1.
std::array<double, 3> corner_scales(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                    const Vec3d& d) {
    // a x + b y - c z = d
    const double det = dot(a, cross(b, c * -1.0));
    return {dot(d, cross(b, c * -1.0)) / det, dot(a, cross(d, c * -1.0)) / det,
            dot(a, cross(b, d)) / det};
}

}  // namespace

PeerView view_of(const Camera& camera) {
    const auto at = [&](float x, float y) { return camera.ray({x, y}, lens_middle); };
    const Ray middle = at(0.5f, 0.5f), left = at(0, 0.5f), right = at(1, 0.5f), top = at(0.5f, 0),
              bottom = at(0.5f, 1);
    PeerView view;
    view.origin = Vec3d(middle.o);
    view.orthographic = length(right.o - left.o) > 0.f;
    if (view.orthographic) {
        const Vec3d across = Vec3d(right.o) - Vec3d(left.o), up = Vec3d(top.o) - Vec3d(bottom.o);
        view.half_width = 0.5 * length(across);
        view.half_height = 0.5 * length(up);
        view.right = normalize(across);
        view.up = normalize(up);
        view.forward = Vec3d(middle.d);
        view.near = middle.tmin;
        view.far = middle.tmax;
    } else {
        // The film's corners are a parallelogram; how far along the rays follows from its closing.
        const Vec3d tl(at(0, 0).d), tr(at(1, 0).d), bl(at(0, 1).d), br(at(1, 1).d);
        const auto [a, b, c] = corner_scales(tl, br, tr, bl);
        const Vec3d across = tr * c - tl * a, up = tl * a - bl;
        view.right = normalize(across);
        view.up = normalize(up);
        view.forward = normalize(cross(view.up, view.right));
        const Vec3d centre = (tr * c + bl) * 0.5;
        view.mirrored = dot(view.forward, centre) < 0;
        if (view.mirrored) view.forward = view.forward * -1.0;
        const double depth = dot(centre, view.forward);
        view.half_width = 0.5 * length(across) / depth;
        view.half_height = 0.5 * length(up) / depth;
        view.shift = {0.5 * dot(centre, view.right) / depth / view.half_width,
                      0.5 * dot(centre, view.up) / depth / view.half_height};
        // No shift but rounding.
        for (double* s : {&view.shift.x, &view.shift.y})
            if (std::abs(*s) < 1e-5) *s = 0;
        const double cosine = dot(Vec3d(middle.d), view.forward);
        view.near = middle.tmin * cosine;
        view.far = middle.tmax * cosine;
        const Ray edge = camera.ray({0.5f, 0.5f}, lens_edge);
        view.aperture_radius = length(Vec3d(edge.o) - view.origin);
        if (view.aperture_radius > 0) {
            const Vec3d d0 = Vec3d(middle.d) * (1 / cosine),
                        d1 = Vec3d(edge.d) * (1 / dot(Vec3d(edge.d), view.forward));
            const double turn = length(d1 - d0);
            view.focus_distance = turn > 0 ? view.aperture_radius / turn : view.far;
        }
    }
    if (view.orthographic) view.mirrored = dot(cross(view.up, view.right), view.forward) < 0;
    return view;
}

}  // namespace nacre
