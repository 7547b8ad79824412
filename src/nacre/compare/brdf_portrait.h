#pragma once
// What people look at of a BRDF: albedo over the angle, lobes, Burley's slice, a lit sphere.
#include <array>
#include <functional>
#include <vector>

#include "nacre/image/image.h"
#include "nacre/measured/target.h"

namespace nacre {

/// A BRDF in red, green and blue: what a target and a model have in common here.
struct BandBrdf {
    /// sr^-1, without cosine; 0 where not known and below the horizon. Called from many threads.
    std::function<Vec3d(const Vec3d& wi, const Vec3d& wo)> value;
    /// Share that is mirrored without blur.
    std::function<Vec3d(const Vec3d& w)> mirror;
};
/// Both must outlive the result.
BandBrdf bands_of(const Target& target);
BandBrdf bands_of(const AnyModel& model);

struct BrdfPortrait {
    static constexpr int albedo_count = 19, lobe_count = 359;
    static constexpr std::array<double, 3> incidences = {10., 45., 75.};  ///< degrees
    /// Angles of the albedo curve, degrees: 0, 5, ... 85, 88.
    static double albedo_angle(int i) { return i < 18 ? 5. * i : 88.; }
    /// Angles of the viewer in the plane of incidence, degrees: -89.5, -89, ... 89.5; the light
    /// stands at the negative ones, its mirror direction at the positive.
    static double lobe_angle(int i) { return -89.5 + 0.5 * i; }

    /// Share of the light from that angle that is scattered or mirrored, by band; within about 1e-4
    /// where the BRDF is smooth.
    std::vector<Vec3d> albedo;
    /// Values in the plane of incidence, sr^-1, for each of `incidences`.
    std::array<std::vector<Vec3d>, 3> lobes;
    /// 90 x 90 pixels, pi f: theta_h from 0 to 90 degrees to the right, theta_d upwards.
    Image slice;
    /// 320 x 320 pixels: an orthographic sphere, seen along the normal at its middle, in a light of
    /// irradiance pi from the upper left, 45 degrees off the view, and of radiance 0.1 from
    /// everywhere. The former is evaluated, without its mirrored part; for the latter the albedo of
    /// the viewer's direction stands, which is exact for reciprocal models. A white matt surface
    /// that faces the light is 1.1. Tangents run round the vertical axis.
    Image sphere;

    /// Mean of the bands of an albedo.
    double mean_albedo(int i) const { return (albedo[i].x + albedo[i].y + albedo[i].z) / 3.; }
};

BrdfPortrait make_portrait(const BandBrdf& brdf);

/// Root mean square of the differences of the albedos' means at the angles up to 80 degrees.
double albedo_difference(const BrdfPortrait& a, const BrdfPortrait& b);

}  // namespace nacre
