#include "nacre/realtime/moved_light.h"

namespace nacre {

MovedLight::MovedLight(LightPtr light, const Scene& scene, const Transform& to, double brightness)
    : light_(std::move(light)),
      scene_(scene),
      to_(to),
      back_(to.inverse()),
      scale_(length(to.vector({1, 0, 0}))),
      brightness_(float(brightness)) {}

LightSample MovedLight::sample(const Point3f& from, Vec2f u, const Wavelengths& w) const {
    LightSample s = light_->sample(back_.point(from), u, w);
    s.wi = normalize(to_.vector(s.wi));
    if (s.distance < 1e29f) s.distance *= scale_;
    s.radiance = s.radiance * Spectral(brightness_);
    return s;
}

float MovedLight::pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const {
    return light_->pdf(back_.point(from), normalize(back_.vector(wi)), on_light);
}

Spectral MovedLight::radiance(const SurfacePoint* on_light, const Vec3f& direction,
                              const Wavelengths& w) const {
    return light_->radiance(on_light, normalize(back_.vector(direction)), w) *
           Spectral(brightness_);
}

Box3f MovedLight::bounds() const {
    const Box3f box = light_->bounds();
    Box3f moved;
    if (box.empty()) return moved;
    for (int i = 0; i < 8; ++i)
        moved.extend(
            to_.point({i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                       i & 4 ? box.upper.z : box.lower.z}));
    return moved;
}

Vec3f MovedLight::surface_normal(const Point3f& p, const Vec3f& wi, float distance) const {
    const Vec3f n = lamp_normal(scene_, *light_, back_.point(p), normalize(back_.vector(wi)),
                                distance / scale_);
    return length_squared(n) > 0.f ? normalize(to_.normal(n)) : n;
}

Vec3f lamp_normal(const Scene& scene, const Light& light, const Point3f& p, const Vec3f& wi,
                  float distance) {
    const Ray back{p - wi * (1e-3f * distance), wi, 0.f, 2e-3f * distance};
    if (const auto hit = scene.rays.intersect(back)) {
        const SurfacePoint at = scene.rays.surface_point(back, *hit);
        // A ball gives the same to all sides, whichever of its points stand for it.
        const Primitive* primitive = scene.rays.primitive(at.shape);
        const bool ball = primitive && std::holds_alternative<Sphere>(*primitive);
        if (scene.shapes[at.shape].light == &light && !ball) return at.ng;
    }
    return {0.f, 0.f, 0.f};
}

}  // namespace nacre
