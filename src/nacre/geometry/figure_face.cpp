// The face of the built-in sculpture: big masses first, then what is set into and on to them.
#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"

namespace nacre::figure {
using namespace sdf;

float cranium(const Point3f& p) { return ellipsoid(p - Vec3f(0, 26, -16), {73, 88, 97}); }

namespace {

// Half a face: x >= 0.
float skull(const Point3f& p) {
    float d = cranium(p);
    d = smooth_union(d, ellipsoid(p - Vec3f(0, 40, 28), {60, 54, 55}), 25);       // forehead
    d = smooth_union(d, ellipsoid(p - Vec3f(0, -28, 22), {59, 74, 62}), 25);      // face
    d = smooth_union(d, round_cone(p, {43, -55, 6}, {10, -98, 70}, 16, 15), 26);  // jaw
    d = smooth_union(d, ellipsoid(p - Vec3f(0, -100, 77), {19, 14, 15}), 16);     // chin
    d = smooth_union(d, ellipsoid(p - Vec3f(37, -24, 58), {20, 15, 17}), 26);     // cheekbone
    d = smooth_union(d, capsule(p, {46, -20, 46}, {62, -12, 4}, 8), 24);          // its arch
    d = smooth_union(d, ellipsoid(p - Vec3f(28, -58, 56), {20, 26, 18}), 26);     // cheek
    d = smooth_union(d, ellipsoid(p - Vec3f(0, -68, 72), {30, 26, 22}), 20);      // teeth
    return d;
}

float brow_and_nose(float d, const Point3f& p) {
    // The sockets first, then the brow over them, and the bridge from brow to tip in one line.
    d = smooth_subtraction(d, ellipsoid(p - Vec3f(32, -1, 94), {22, 13, 22}), 26);
    d = smooth_union(d, bezier_tube(p, {3, 16, 80}, {29, 35, 88}, {57, -2, 36}, 5, 4.5f, 0), 20);
    float nose = round_cone(p, {0, 18, 81}, {0, -33, 104}, 6.5f, 6);
    nose = smooth_union(nose, round_cone(p, {0, 4, 76}, {0, -38, 91}, 8, 13), 10);
    nose = smooth_union(nose, sphere(p - Vec3f(0, -36.5f, 105.5f), 7.5f), 8);              // tip
    nose = smooth_union(nose, ellipsoid(p - Vec3f(10.5f, -40, 95), {5.8f, 6.5f, 10}), 9);  // wing
    d = smooth_union(d, nose, 12);
    return smooth_subtraction(d, ellipsoid(p - Vec3f(5.8f, -49, 101), {2.8f, 5, 6}), 3);  // nostril
}

// An eyeball under two lids. Each lid is a shell cut by a plane through the corners of the eye, so
// that its rim is an arc of a great circle and the lids meet at the corners: an almond.
float eye(float d, const Point3f& p) {
    static const Turn slant = Turn::degrees(-6);  // outer corner higher
    static const Turn upper_rim = Turn::degrees(4), lower_rim = Turn::degrees(-22);
    Point3f e = turn_z(p - Vec3f(32, -2, 62), slant);
    if (length_squared(e) > square(45)) return d;
    e.x *= 0.9f;  // longer than high
    const float upper = e.z * upper_rim.s - e.y * upper_rim.c;
    const float lower = e.y * lower_rim.c - e.z * lower_rim.s;
    const float lids = std::min(smooth_intersection(sphere(e, 18.2f), upper, 2.2f),
                                smooth_intersection(sphere(e, 17.4f), lower, 2.6f));
    return smooth_union(smooth_union(d, lids, 4), sphere(e, 15.6f), 1.4f);
}

float mouth(float d, const Point3f& p) {
    if (length_squared(p - Vec3f(0, -70, 85)) > square(55)) return d;
    const float upper =
        bezier_tube(p, {0, -65, 95}, {9, -62.5f, 96}, {25, -71, 81}, 3.8f, 4.4f, 1.5f);
    const float lower =
        bezier_tube(p, {0, -76.5f, 93}, {13, -77.5f, 93.5f}, {24, -71.5f, 81}, 5, 4.8f, 1.2f);
    d = smooth_union(d, std::min(upper, lower), 6);
    const float slit =
        bezier_tube(p, {0, -70.5f, 99.5f}, {12, -68.5f, 99}, {27, -71.5f, 83}, 0.6f, 0.9f, 0.6f);
    d = smooth_subtraction(d, slit, 3.5f);
    d += 1.6f * brush(p, {0, -54, 97}, {4, 7, 9});     // philtrum
    d -= 0.8f * brush(p, {6, -57, 96}, {2.6f, 7, 9});  // its ridge
    d += 2.5f * brush(p, {0, -88, 92}, {15, 5, 10});   // furrow above the chin
    d += 1.8f * brush(p, {29, -73, 80}, {5, 6, 9});    // corner of the mouth
    return d;
}

}  // namespace

float face(const Point3f& p) {
    // Mirrored with a rounded edge: no crease down the middle of the face.
    const Point3f m{std::hypot(p.x, 2.5f), p.y, p.z};
    const float d = skull(m);
    // Features lie in front of z = 15 and change the distance only near the skin.
    if (m.z < 15.f || std::abs(d) > 40.f) return d;
    return mouth(eye(brow_and_nose(d, m), m), m);
}

}  // namespace nacre::figure
