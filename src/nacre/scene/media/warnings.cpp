// What is likely to be a mistake in where media begin and end: said, since the picture alone does
// not tell.
#include <fmt/format.h>

#include <cmath>

#include "nacre/geometry/mesh_report.h"
#include "nacre/math/spread_point.h"
#include "nacre/scene/scene_builder.h"

namespace nacre {
namespace {

/// The medium that a ray is in at its start, by the first boundary that it meets; null if there is
/// none, or no medium.
const Medium* medium_at_start(const Scene& scene, Ray ray) {
    constexpr int most_surfaces = 64;
    ray.tmin = 0.f, ray.tmax = 1e30f;
    for (int i = 0; i < most_surfaces; ++i) {
        const auto hit = scene.rays.intersect(ray);
        if (!hit) return nullptr;
        const ShapeBinding& shape = scene.shapes[hit->shape];
        const SurfacePoint at = scene.rays.surface_point(ray, *hit);
        if (shape.separates_media) return dot(at.ng, ray.d) > 0.f ? shape.interior : shape.exterior;
        ray.o = at.spawn(ray.d);
    }
    return nullptr;
}

void warn_about_camera(Scene& scene) {
    if (scene.camera_medium || !scene.camera) return;
    const Ray ahead = scene.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f});
    Ray back = ahead;
    back.d = -ahead.d;
    if (medium_at_start(scene, ahead) && medium_at_start(scene, back))
        scene.warnings.emplace_back(
            "the camera stands in a medium but does not say so, and light reaches it as through "
            "nothing: give the sensor that <medium>, by <ref>, too");
}

bool has_volume(const RayScene& rays, std::uint32_t shape) {
    if (const Mesh* mesh = rays.mesh(shape)) return inspect(*mesh).closed();
    return std::holds_alternative<Sphere>(*rays.primitive(shape));
}

bool is_inside(const RayScene& rays, std::uint32_t shape, const Point3f& p) {
    constexpr int most_surfaces = 256;
    Ray ray{p, normalize(Vec3f{0.31f, 0.67f, 0.59f})};  // along nothing that people model
    bool inside = false;
    for (int i = 0; i < most_surfaces; ++i) {
        const auto hit = rays.intersect(ray);
        if (!hit) return inside;
        if (hit->shape == shape) inside = !inside;
        ray.o = rays.surface_point(ray, *hit).spawn(ray.d);
    }
    return false;
}

/// Of points spread over a shape: how many lie inside another, how many outside, and how many on it
/// with the two surfaces back to back.
struct Contact {
    int inside = 0, outside = 0, touching = 0;

    Contact(const RayScene& rays, std::uint32_t of, std::uint32_t other) {
        const float size = length(rays.bounds(of).diagonal());
        for (int i = 0; i < 128; ++i) {
            const AreaSample at = rays.sample_area(of, spread_point(i));
            const float near = 1e-5f * size;
            if (const auto hit = rays.closest(at.p, near, other)) {
                const SurfacePoint there = rays.surface_point({at.p, at.n}, *hit);
                touching += dot(there.ng, at.n) < -0.99f;
            } else {
                ++(is_inside(rays, other, at.p) ? inside : outside);
            }
        }
    }
};

void warn_about_pair(Scene& scene, std::uint32_t a, std::uint32_t b) {
    const RayScene& rays = scene.rays;
    const Box3f p = rays.bounds(a), q = rays.bounds(b);
    for (std::size_t i = 0; i < 3; ++i)
        if (p.lower[i] > q.upper[i] || q.lower[i] > p.upper[i]) return;
    if (!has_volume(rays, a) || !has_volume(rays, b)) return;
    const Contact of_a(rays, a, b), of_b(rays, b, a);
    const std::string names = fmt::format("'{}' and '{}' (shapes {} and {}, counted from 0)",
                                          scene.shapes[a].name, scene.shapes[b].name, a, b);
    if (of_a.touching > 2 || of_b.touching > 2)
        scene.warnings.push_back(names +
                                 " have media and touch face to face: light is gained or lost "
                                 "where two surfaces coincide; leave a gap or make them one");
    // Wholly inside is legitimate: the inner one says what is outside of it.
    else if ((of_a.inside > 0 && of_a.outside > 0) || (of_b.inside > 0 && of_b.outside > 0))
        scene.warnings.push_back(names +
                                 " have media and overlap: light is gained or lost where both "
                                 "are; let one end where the other begins");
}

}  // namespace

void warn_about_media(Scene& scene) {
    warn_about_camera(scene);
    std::vector<std::uint32_t> filled;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (scene.shapes[i].interior) filled.push_back(i);
    constexpr std::size_t most_shapes = 64;  // pairs are looked at one by one
    if (filled.size() > most_shapes) return;
    for (std::size_t i = 0; i < filled.size(); ++i)
        for (std::size_t k = i + 1; k < filled.size(); ++k)
            warn_about_pair(scene, filled[i], filled[k]);
}

}  // namespace nacre
