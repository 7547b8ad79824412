#include "nacre/goniometer/patch.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {

Patch make_patch(std::shared_ptr<const RayScene> rays, SurfaceBsdf bsdf, double x, double y,
                 double width, double height) {
    const Box3f box = rays->bounds();
    if (box.empty()) throw InputError("there is no surface to measure");
    if (width == 0.) {
        x = box.lower.x;
        y = box.lower.y;
        width = double(box.upper.x) - x;
        height = double(box.upper.y) - y;
    }
    if (!(width > 0. && height > 0.))
        throw InputError(fmt::format(
            "a patch of {:.6g} by {:.6g} has no area: its mean normal is +z, the tile lies in x "
            "and y",
            width, height));
    // Room for rays that start and end beyond what is highest and lowest.
    const double margin = 1e-3 * std::min(width, height);
    return {std::move(rays),
            x,
            y,
            width,
            height,
            double(box.lower.z) - margin,
            double(box.upper.z) + margin,
            std::move(bsdf),
            {},
            {}};
}

namespace {

/// Along one axis from `at` by `step` to where the interval [low, high] ends.
double distance_to_end(double at, double step, double low, double high) {
    if (step > 0.) return std::max(0., (high - at) / step);
    if (step < 0.) return std::max(0., (low - at) / step);
    return 1e30;
}

}  // namespace

Flight fly(const Patch& patch, Point3f origin, const Vec3f& direction, double longest) {
    // What stands on the edge of a tile is looked for from both sides of it.
    const double slack = 1e-5 * std::max(patch.width, patch.height);
    Vec3d o(origin);
    const Vec3d d(direction);
    Ray ray{origin, direction, 0.f, 0.f};
    double length = 0.;
    for (int period = 0; period < 100'000; ++period) {
        const double tx = distance_to_end(o.x, d.x, patch.x, patch.x + patch.width);
        const double ty = distance_to_end(o.y, d.y, patch.y, patch.y + patch.height);
        const double tz = distance_to_end(o.z, d.z, patch.bottom, patch.top);
        const double t = std::min({tx, ty, tz}), left = longest - length;
        ray.o = Point3f(o);
        ray.tmax = float(std::min(t + slack, left));
        if (const auto hit = patch.rays->intersect(ray))
            return {Fate::meets, patch.rays->surface_point(ray, *hit), length + double(hit->t), {}};
        if (left <= t) return {Fate::ends, {}, longest, Point3f(o + d * left)};
        length += t;
        if (tz <= t) return {d.z > 0. ? Fate::leaves_above : Fate::leaves_below, {}, length, {}};
        o = o + d * t;
        if (tx <= t) o.x += d.x > 0. ? -patch.width : patch.width;
        if (ty <= t) o.y += d.y > 0. ? -patch.height : patch.height;
    }
    return {Fate::lost, {}, length, {}};
}

}  // namespace nacre
