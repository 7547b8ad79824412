#include "nacre/realtime/light_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/realtime/moved_light.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

/// The R2 sequence (Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences): evenly
/// spread however many are taken.
Vec2f spread(std::uint32_t i, std::uint32_t light) {
    constexpr double a = 0.7548776662466927, b = 0.5698402909980532;
    const double n = double(i) + 0.5, shift = 0.6180339887498949 * light;
    const auto fraction = [](double x) { return float(x - std::floor(x)); };
    return {std::min(fraction(0.5 + a * n + shift), 0.9999999f),
            std::min(fraction(0.5 + b * n + shift), 0.9999999f)};
}

}  // namespace

LightShape shape_of(const Light& light) {
    constexpr float pi = std::numbers::pi_v<float>;
    const Wavelengths bands = Wavelengths::rgb_bands();
    const Point3f from = light.bounds().center();
    const auto intensity = [&](const Vec3f& d) {
        const LightSample s = light.sample(from + d, {0.5f, 0.5f}, bands);
        return s.pdf > 0.f ? to_rgb(s.radiance, bands) : Vec3f{};
    };
    LightShape shape;
    float low = 1e30f, high = 0.f;
    for (int y = 0; y < LightShape::height; ++y)
        for (int x = 0; x < LightShape::width; ++x) {
            const float phi = 2.f * pi * (float(x) + 0.5f) / LightShape::width,
                        theta = pi * (float(y) + 0.5f) / LightShape::height;
            const Vec3f rgb = intensity({std::sin(theta) * std::sin(phi), std::cos(theta),
                                         std::sin(theta) * std::cos(phi)});
            const float l = luminance(rgb);
            if (l > high) shape.peak = rgb;
            low = std::min(low, l);
            high = std::max(high, l);
            shape.falloff.push_back(l);
        }
    shape.even = high - low <= 1e-4f * high;
    for (float& l : shape.falloff) l = high > 0.f ? l / high : 0.f;
    if (shape.even) shape.falloff.clear();
    return shape;
}

std::vector<LightPoint> light_points(const Scene& scene, const Point3f& middle, int points,
                                     std::uint32_t index) {
    const Wavelengths bands = Wavelengths::rgb_bands();
    float power = 0.f;
    for (const LightPtr& light : scene.lights)
        if (!light->is_delta()) power += light->power();
    std::vector<LightPoint> result;
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        const Light& light = *scene.lights[l];
        if (light.is_delta() && !light.bounds().empty()) {
            const Point3f at = light.bounds().center();
            result.push_back(
                {.light = &light, .position = at, .distance2 = length_squared(middle - at)});
            continue;
        }
        int count = 1;
        if (!light.is_delta() && power > 0.f)
            count = std::max(1, int(std::lround(float(points) * light.power() / power)));
        for (int i = 0; i < count; ++i) {
            const LightSample s = light.sample(
                middle, spread(index * std::uint32_t(count) + std::uint32_t(i), l), bands);
            if (!(s.pdf > 0.f)) continue;
            LightPoint p{.light = &light};
            p.color = to_rgb(s.radiance, bands) * (1.f / (s.pdf * float(count)));
            p.parallel = s.distance > 1e29f;
            p.position = s.wi;
            if (!p.parallel) {
                p.position = middle + s.wi * s.distance;
                p.distance2 = s.distance * s.distance;
                // A lamp's surface there, whose light falls off to its sides.
                const auto* moved = dynamic_cast<const MovedLight*>(&light);
                p.normal = moved ? moved->surface_normal(p.position, s.wi, s.distance)
                                 : lamp_normal(scene, light, p.position, s.wi, s.distance);
            }
            result.push_back(p);
        }
    }
    return result;
}

}  // namespace nacre
