#include "nacre/render/refraction.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

/// The part of the derivative `raw` of a vector of length `length` along `unit` that turns it.
Vec3d turning(const Vec3d& raw, const Vec3d& unit, double length) {
    return (raw - unit * dot(unit, raw)) * (1 / length);
}

struct ToLight {
    Vec3d w, wa, wb;
    double distance = 1;
};

ToLight to_light(const SurfaceChart& at, const LightPlace& light) {
    if (light.distant) return {light.place, {}, {}, 1};
    const Vec3d to = light.place - at.p;
    const double distance = length(to);
    const Vec3d w = to * (1 / distance);
    return {w, turning(-at.pa, w, distance), turning(-at.pb, w, distance), distance};
}

}  // namespace

std::vector<SourceWithoutExtent> sources_without_extent(const Scene& scene) {
    std::vector<SourceWithoutExtent> sources;
    for (const LightPtr& light : scene.lights) {
        if (!light->is_delta() || !(light->power() > 0.f)) continue;
        const Box3f place = light->bounds();
        if (place.empty()) {
            const LightSample s =
                light->sample(scene.rays.bounds().center(), {}, Wavelengths::rgb_bands());
            sources.push_back({light.get(), {normalize(Vec3d(s.wi)), true}});
        } else {
            sources.push_back({light.get(), {Vec3d(place.center()), false}});
        }
    }
    return sources;
}

RefractedLight refract_light(const SurfaceChart& at, const LightPlace& light, double eta) {
    const ToLight to = to_light(at, light);
    const double cos_out = dot(to.w, at.n);
    const double cos_in = std::sqrt(1 - (1 - cos_out * cos_out) / (eta * eta));
    // d = -w / eta + k n
    const double k = cos_out / eta - cos_in, k_by_cos = 1 / eta - cos_out / (eta * eta * cos_in);
    const auto derivative = [&](const Vec3d& w_by, const Vec3d& n_by) {
        const double cos_by = dot(w_by, at.n) + dot(to.w, n_by);
        return w_by * (-1 / eta) + n_by * k + at.n * (k_by_cos * cos_by);
    };
    return {to.w * (-1 / eta) + at.n * k, derivative(to.wa, at.na), derivative(to.wb, at.nb),
            cos_out};
}

bool step_towards(const Vec3d& y, const SurfaceChart& at, const RefractedLight& light,
                  double& step_a, double& step_b) {
    const Vec3d from = y - at.p;
    const double t = dot(from, light.d);
    const Vec3d a = at.pa + light.da * t, b = at.pb + light.db * t;
    const double volume = det(a, b, light.d);
    if (!(std::abs(volume) > 1e-12 * length(at.pa) * length(at.pb))) return false;
    step_a = det(from, b, light.d) / volume;
    step_b = det(a, from, light.d) / volume;
    return true;
}

double refraction_gain(const Vec3d& y, const SurfaceChart& at, const LightPlace& light,
                       double eta) {
    const Vec3d from = y - at.p;
    const double t = length(from);
    const Vec3d d = from * (1 / t);
    const double cos_in = -dot(d, at.n);
    const double cos_out = std::sqrt(std::max(0., 1 - eta * eta * (1 - cos_in * cos_in)));
    // Outwards w = -eta d + k n, with y fixed.
    const double k = cos_out - eta * cos_in, k_by_cos = eta * eta * cos_in / cos_out - eta;
    const double distance = light.distant ? 1 : length(light.place - at.p);
    const Vec3d w = d * -eta + at.n * k;
    const auto across = [&](const Vec3d& p_by, const Vec3d& n_by) {
        const Vec3d d_by = turning(-p_by, d, t);
        const double cos_by = -dot(d_by, at.n) - dot(d, n_by);
        const Vec3d w_by = d_by * -eta + n_by * k + at.n * (k_by_cos * cos_by);
        // How the ray out of here moves where the light is, over the distance.
        return light.distant ? w_by : w_by + p_by * (1 / distance);
    };
    const double at_light = std::abs(det(across(at.pa, at.na), across(at.pb, at.nb), w));
    const double at_y = std::abs(det(at.pa, at.pb, d)) / (t * t);
    return eta * eta * at_y / at_light;
}

}  // namespace nacre
