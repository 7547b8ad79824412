#include "nacre/compare/brdf_portrait.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "nacre/measured/cuts.h"
#include "nacre/reflectance/albedo.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

Vec3d albedo_at(const BandBrdf& brdf, double degrees) {
    const Vec3d wi = in_plane(degrees * degree);
    Vec3d albedo;
    for (int c = 0; c < 3; ++c)
        albedo[c] = integrate_hemisphere(
                        [&](const Vec3d& wo) { return brdf.value(wi, wo)[c] * wo.z; }, wi, 1e-4)
                        .value;
    return albedo + brdf.mirror(wi);
}

Vec3d interpolated_albedo(const BrdfPortrait& p, double degrees) {
    int i = 0;
    while (i + 2 < BrdfPortrait::albedo_count && BrdfPortrait::albedo_angle(i + 1) < degrees) ++i;
    const double a = BrdfPortrait::albedo_angle(i), b = BrdfPortrait::albedo_angle(i + 1);
    const double t = std::clamp((degrees - a) / (b - a), 0., 1.);
    return p.albedo[i] * (1. - t) + p.albedo[i + 1] * t;
}

void set(Image& image, int x, int y, const Vec3d& v) {
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(v[c]);
}

Image draw_slice(const BandBrdf& brdf) {
    Image image(90, 90);
    tbb::parallel_for(0, 90, [&](int y) {
        for (int x = 0; x < 90; ++x) {
            const DirectionPair w = burley_slice((x + 0.5) * degree, (89.5 - y) * degree);
            set(image, x, y, brdf.value(w.wi, w.wo) * std::numbers::pi);
        }
    });
    return image;
}

/// Radiance at a point of the unit sphere, seen from +z, y up.
Vec3d sphere_radiance(const BandBrdf& brdf, const BrdfPortrait& p, double x, double y) {
    const Vec3d n{x, y, std::sqrt(std::max(0., 1. - x * x - y * y))};
    const Vec3d to_light = normalize(Vec3d{-1., 1., std::numbers::sqrt2});
    const double across = std::hypot(n.x, n.z);
    const Vec3d t = across > 1e-9 ? Vec3d{n.z / across, 0., -n.x / across} : Vec3d{1., 0., 0.};
    const Vec3d b = cross(n, t);
    const auto local = [&](const Vec3d& w) { return Vec3d{dot(w, t), dot(w, b), dot(w, n)}; };
    const Vec3d wi = local(to_light), wo = local({0., 0., 1.});
    Vec3d radiance = interpolated_albedo(p, std::acos(std::min(n.z, 1.)) / degree) * 0.1;
    if (wi.z > 0. && wo.z > 0.) radiance += brdf.value(wi, wo) * (std::numbers::pi * wi.z);
    return radiance;
}

Image draw_sphere(const BandBrdf& brdf, const BrdfPortrait& p) {
    constexpr int size = 320;
    constexpr double radius = 0.47 * size;
    Image image(size, size);
    tbb::parallel_for(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            Vec3d sum;
            for (int s = 0; s < 4; ++s) {
                const double u = (x + 0.25 + 0.5 * (s % 2) - 0.5 * size) / radius;
                const double v = (0.5 * size - y - 0.25 - 0.5 * (s / 2)) / radius;
                if (u * u + v * v < 1.) sum += sphere_radiance(brdf, p, u, v) * 0.25;
            }
            set(image, x, y, sum);
        }
    });
    return image;
}

}  // namespace

BandBrdf bands_of(const Target& target) {
    return {
        [&](const Vec3d& wi, const Vec3d& wo) { return target.value(wi, wo).value_or(Vec3d{}); },
        [&](const Vec3d& w) { return target.mirror(w); }};
}

BandBrdf bands_of(const AnyModel& model) {
    const ValuesS values = model.values(Wavelengths::rgb_bands());
    const Evaluator& e = model.evaluator();
    const auto bands = [](const Spectral& s) { return Vec3d{s[0], s[1], s[2]}; };
    return {[=, &e](const Vec3d& wi, const Vec3d& wo) {
                return bands(e.eval(values, Vec3f(wi), Vec3f(wo)));
            },
            [=, &e](const Vec3d& w) { return bands(e.mirror(values, Vec3f(w))); }};
}

BrdfPortrait make_portrait(const BandBrdf& brdf) {
    BrdfPortrait p;
    p.albedo.resize(BrdfPortrait::albedo_count);
    tbb::parallel_for(0, BrdfPortrait::albedo_count,
                      [&](int i) { p.albedo[i] = albedo_at(brdf, BrdfPortrait::albedo_angle(i)); });
    for (std::size_t k = 0; k < p.lobes.size(); ++k)
        for (int i = 0; i < BrdfPortrait::lobe_count; ++i)
            p.lobes[k].push_back(brdf.value(in_plane(-BrdfPortrait::incidences[k] * degree),
                                            in_plane(BrdfPortrait::lobe_angle(i) * degree)));
    p.slice = draw_slice(brdf);
    p.sphere = draw_sphere(brdf, p);
    return p;
}

double albedo_difference(const BrdfPortrait& a, const BrdfPortrait& b) {
    double sum = 0.;
    int count = 0;
    for (int i = 0; i < BrdfPortrait::albedo_count; ++i) {
        if (BrdfPortrait::albedo_angle(i) > 80.) continue;
        const double d = a.mean_albedo(i) - b.mean_albedo(i);
        sum += d * d;
        ++count;
    }
    return std::sqrt(sum / count);
}

}  // namespace nacre
