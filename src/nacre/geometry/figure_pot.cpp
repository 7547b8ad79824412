// A pot for tea, cast solid: body, lid, spout and handle.
#include "nacre/geometry/figure.h"
#include "nacre/geometry/sdf.h"

namespace nacre {
using namespace sdf;

namespace {

// Flattened below and drawn in to the rim.
float body(const Point3f& p) {
    const float belly = ellipsoid(p - Vec3f(0, 58, 0), {74, 56, 74});
    const float foot = rounded_cylinder(p - Vec3f(0, 6, 0), 44, 6, 3);
    return smooth_union(smooth_intersection(belly, 6.f - p.y, 8), foot, 10);
}

float lid(const Point3f& p) {
    const float dome = ellipsoid(p - Vec3f(0, 104, 0), {40, 16, 40});
    const float rim = torus(p - Vec3f(0, 106, 0), 38, 3);
    const float knob =
        smooth_union(sphere(p - Vec3f(0, 131, 0), 9), capsule(p, {0, 110, 0}, {0, 128, 0}, 4), 6);
    return smooth_union(smooth_union(dome, rim, 4), knob, 5);
}

}  // namespace

float pot_distance(const Point3f& p) {
    const float spout = bezier_tube(p, {58, 40, 0}, {104, 44, 0}, {112, 104, 0}, 17, 12, 8);
    const float handle = bezier_tube(p, {-60, 88, 0}, {-150, 104, 0}, {-62, 30, 0}, 7, 6, 7);
    float d = smooth_union(body(p), spout, 14);
    d = smooth_union(d, handle, 10);
    d = smooth_union(d, lid(p), 2);
    // A dent for the mouth of the spout.
    return smooth_subtraction(d, capsule(p, {111, 100, 0}, {114, 116, 0}, 5), 3);
}

Box3f pot_box() { return {{-128, -6, -84}, {132, 148, 84}}; }

}  // namespace nacre
