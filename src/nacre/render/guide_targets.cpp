#include "nacre/render/guide_targets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/spectrum/color.h"

namespace nacre {

namespace {

// Most proposals go to the light itself, some to twice its size: refraction through the true
// boundary displaces them, and paths near the light's edge would otherwise have too small a density
// (fireflies).
constexpr float widened_share = 0.2f, widening = 2.f;

// The cosine of the half angle under which a sphere is seen from distance sqrt(d2).
float cone_cosine(float radius, float d2) {
    return std::sqrt(std::max(0.f, 1.f - radius * radius / d2));
}

float cone_pdf(float cos_max) {
    return 1.f / (2.f * std::numbers::pi_v<float> * std::max(1e-6f, 1.f - cos_max));
}

GuideTarget stand_in(const Scene& scene, std::uint32_t shape) {
    GuideTarget target;
    const Box3f box = scene.rays.bounds(shape);
    target.center = box.center();
    const Mesh* mesh = scene.rays.mesh(shape);
    if (mesh && mesh->triangles.size() == 2 && mesh->positions.size() == 4) {
        // Four corners, two triangles: a parallelogram if the diagonals halve each other. The
        // diagonal that both triangles share joins opposite corners.
        const auto& [a, b] = std::tie(mesh->triangles[0], mesh->triangles[1]);
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t apex = a[i], p = a[(i + 1) % 3], q = a[(i + 2) % 3];
            if (std::ranges::count(b, p) == 0 || std::ranges::count(b, q) == 0) continue;
            const std::uint32_t other = 6 - apex - p - q;
            const auto& x = mesh->positions;
            const Vec3f gap = (x[apex] + x[other]) - (x[p] + x[q]);
            if (length(gap) > 1e-4f * length(x[p] - x[q])) break;
            target.u = (x[p] - x[apex]) * 0.5f;
            target.v = (x[q] - x[apex]) * 0.5f;
            target.center = (x[p] + x[q]) * 0.5f;
            const AreaSample s = scene.rays.sample_area(shape, {0.5f, 0.5f});
            target.normal = s.n;
            return target;
        }
    }
    const Vec3f d = box.diagonal();
    target.radius = mesh ? 0.5f * length(d) : 0.5f * std::max({d.x, d.y, d.z});
    return target;
}

LightSample sample_point(const Light& light, const Point3f& at) {
    return light.sample(at, {0.5f, 0.5f}, Wavelengths::rgb_bands());
}

}  // namespace

float irradiance_of(const Light& point, const Point3f& at) {
    const LightSample s = sample_point(point, at);
    return s.pdf > 0.f ? luminance({s.radiance[0], s.radiance[1], s.radiance[2]}) : 0.f;
}

Vec3f GuideTarget::towards(const Point3f& y) const {
    return point ? sample_point(*point, y).wi : normalize(center - y);
}

GuideLobe GuideTarget::lobe(const Point3f& y, float spread) const {
    if (point) return {towards(y), spread * spread};
    const Vec3f to = center - y;
    const float d2 = std::max(1e-12f, dot(to, to));
    // Half of a disk lies within 1 / sqrt(2) of its radius.
    return {to * (1.f / std::sqrt(d2)),
            spread * spread + 0.5f * area() * std::numbers::inv_pi_v<float> / d2};
}

float GuideTarget::area() const {
    return radius > 0.f ? std::numbers::pi_v<float> * radius * radius : 4.f * length(cross(u, v));
}

float GuideTarget::pdf(const Point3f& y, const Vec3f& direction) const {
    if (sky) return sky->pdf(direction);
    if (radius > 0.f) {
        const Vec3f to = center - y;
        const float d2 = dot(to, to), cosine = dot(to, direction) / std::sqrt(d2);
        if (d2 <= widening * widening * radius * radius)
            return 0.25f * std::numbers::inv_pi_v<float>;
        const float narrow = cone_cosine(radius, d2), wide = cone_cosine(widening * radius, d2);
        return (cosine >= narrow ? (1.f - widened_share) * cone_pdf(narrow) : 0.f) +
               (cosine >= wide ? widened_share * cone_pdf(wide) : 0.f);
    }
    const float facing = -dot(direction, normal);
    if (facing <= 0.f) return 0.f;
    const float t = dot(y - center, normal) / facing;
    if (t <= 0.f) return 0.f;
    // Coordinates in the parallelogram, by solving for p = a u + b v in its plane.
    const Vec3f p = y + direction * t - center;
    const float uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), pu = dot(p, u), pv = dot(p, v);
    const float inverse = 1.f / (uu * vv - uv * uv);
    const float reach =
        std::max(std::abs((pu * vv - pv * uv) * inverse), std::abs((pv * uu - pu * uv) * inverse));
    const float per_area = t * t / (facing * area());
    return ((reach <= 1.f ? 1.f - widened_share : 0.f) +
            (reach <= widening ? widened_share / (widening * widening) : 0.f)) *
           per_area;
}

Vec3f GuideTarget::sample(const Point3f& y, Random& random) const {
    if (sky) return sky->sample(random);
    const float scale = random.next() < widened_share ? widening : 1.f;
    const Vec2f r = random.next2();
    if (radius > 0.f) {
        const Vec3f to = center - y;
        const float d2 = dot(to, to);
        float cos_max = -1.f;
        if (d2 > widening * widening * radius * radius) cos_max = cone_cosine(scale * radius, d2);
        const float z = 1.f - r.x * (1.f - cos_max), s = std::sqrt(std::max(0.f, 1.f - z * z));
        const float phi = 2.f * std::numbers::pi_v<float> * r.y;
        return Framef::around(to / std::sqrt(d2))
            .to_world({s * std::cos(phi), s * std::sin(phi), z});
    }
    return normalize(center + u * (scale * (2.f * r.x - 1.f)) + v * (scale * (2.f * r.y - 1.f)) -
                     y);
}

std::vector<GuideTarget> find_guide_targets(const Scene& scene, const Box3f& object,
                                            const ExitBoundary& boundary, GuideSkies& skies,
                                            int most) {
    const float spread = boundary.spread;
    const auto is_inside = [&](const Light* light) {
        return std::ranges::any_of(boundary.lights_inside,
                                   [&](const LightPtr& inside) { return inside.get() == light; });
    };
    std::vector<std::pair<float, GuideTarget>> found;
    const Point3f middle = object.center();
    for (std::uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
        const Light* light = scene.shapes[shape].light;
        if (!light || is_inside(light)) continue;
        GuideTarget target = stand_in(scene, shape);
        // What shines all around is met by chance.
        if (length(target.center - middle) < target.radius) continue;
        const double area = scene.rays.area(shape);
        // Power of a diffuse emitter is pi * area * radiance.
        target.radiance = light->power() / static_cast<float>(std::numbers::pi * area);
        const Vec3f to = target.center - middle;
        const float strength = target.radiance * target.area() / std::max(1e-12f, dot(to, to));
        if (strength > 0.f) found.emplace_back(strength, target);
    }
    for (const LightPtr& light : scene.lights) {
        if (is_inside(light.get())) continue;
        if (light->is_delta() && spread > 0.f) {
            GuideTarget target;
            target.point = light.get();
            // Towards all sides of the object: a spot may pass by its centre.
            float strength = irradiance_of(*light, middle);
            for (int corner = 0; corner < 8; ++corner) {
                const auto& [a, b] = std::tie(object.lower, object.upper);
                strength = std::max(
                    strength, irradiance_of(*light, {corner & 1 ? a.x : b.x, corner & 2 ? a.y : b.y,
                                                     corner & 4 ? a.z : b.z}));
            }
            if (strength > 0.f) found.emplace_back(strength, target);
        }
        if (light->is_infinite()) {
            GuideTarget target;
            target.sky = skies.of(*light, boundary.eta, spread);
            if (target.sky) found.emplace_back(target.sky->flux(), target);
        }
    }
    std::ranges::stable_sort(found, std::greater<>{}, [](const auto& f) { return f.first; });
    std::vector<GuideTarget> targets;
    for (const auto& [strength, target] : found)
        if (static_cast<int>(targets.size()) < most) targets.push_back(target);
    return targets;
}

}  // namespace nacre
