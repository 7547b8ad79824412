// Lights of shapes. A surface shines on the side of its geometric normal only.
#include <numbers>

#include "nacre/scene/lights/rectangle.h"
#include "nacre/scene/lights/types.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Any shape: points are drawn uniformly by area.
class AreaLight : public Light {
  public:
    AreaLight(TexturePtr radiance, const RayScene& rays, std::uint32_t shape)
        : radiance_(std::move(radiance)),
          rays_(rays),
          shape_(shape),
          area_(static_cast<float>(rays.area(shape))) {}

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& w) const override {
        const AreaSample at = rays_.sample_area(shape_, u);
        const Vec3f d = at.p - from;
        const float d2 = length_squared(d);
        const float distance = std::sqrt(d2);
        if (!(distance > 0.f)) return {};
        const Vec3f wi = d * (1.f / distance);
        const float cosine = -dot(wi, at.n);
        if (!(cosine > 0.f)) return {};
        return {wi, distance, radiance_->eval(at.uv, w), at.pdf * d2 / cosine};
    }

    float pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const override {
        if (!on_light) return 0.f;
        const float cosine = -dot(wi, on_light->ng);
        if (!(cosine > 0.f)) return 0.f;
        return length_squared(on_light->p - from) / (area_ * cosine);
    }

    Spectral radiance(const SurfacePoint* on_light, const Vec3f& direction,
                      const Wavelengths& w) const final {
        if (!on_light || !(dot(direction, on_light->ng) < 0.f)) return Spectral(0.f);
        return radiance_->eval(on_light->uv, w);
    }

    float power() const final { return pi * area_ * radiance_->mean(); }
    Box3f bounds() const final { return rays_.bounds(shape_); }
    bool is_spectral() const final { return radiance_->is_spectral(); }

  protected:
    TexturePtr radiance_;
    const RayScene& rays_;
    std::uint32_t shape_;
    float area_;
};

/// A sphere of constant radiance: from outside, directions are uniform in the cone that it fills.
class SphereLight final : public AreaLight {
  public:
    SphereLight(TexturePtr radiance, const RayScene& rays, std::uint32_t shape,
                const Sphere& sphere)
        : AreaLight(std::move(radiance), rays, shape),
          center_(sphere.center),
          radius_(sphere.radius),
          shines_inwards_(sphere.flip_normals) {}

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& w) const override {
        const Vec3f to_center = center_ - from;
        const float d2 = length_squared(to_center), r2 = radius_ * radius_;
        if ((d2 < r2) != shines_inwards_) return {};
        if (shines_inwards_) return AreaLight::sample(from, u, w);
        const float sin2_max = r2 / d2;
        const float one_minus_cos_max = one_minus_cosine(sin2_max);
        const float one_minus_cos = u.x * one_minus_cos_max;
        const float cosine = 1.f - one_minus_cos;
        const float sin2 = one_minus_cos * (2.f - one_minus_cos);
        const float sine = std::sqrt(sin2);
        const float phi = 2.f * pi * u.y;
        const float d = std::sqrt(d2);
        const Framef frame = Framef::around(to_center * (1.f / d));
        const Vec3f wi = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
        // Nearer crossing with the sphere. d cos - sqrt(r^2 - d^2 sin^2), where the root is written
        // by the angle's distance from the rim so that it does not cancel.
        const float distance = d * (cosine - std::sqrt(std::max(0.f, sin2_max - sin2)));
        return {normalize(wi), distance, radiance_->eval({}, w),
                1.f / (2.f * pi * one_minus_cos_max)};
    }

    float pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const override {
        if (!on_light) return 0.f;
        const float d2 = length_squared(center_ - from), r2 = radius_ * radius_;
        if ((d2 < r2) != shines_inwards_) return 0.f;
        if (shines_inwards_) return AreaLight::pdf(from, wi, on_light);
        return 1.f / (2.f * pi * one_minus_cosine(r2 / d2));
    }

  private:
    /// 1 - cos of the cone's half angle from its squared sine, exact for small cones.
    static float one_minus_cosine(float sin2) {
        return sin2 / (1.f + std::sqrt(std::max(0.f, 1.f - sin2)));
    }

    Point3f center_;
    float radius_;
    bool shines_inwards_;
};

/// A rectangle of constant radiance: directions are uniform in the solid angle that it fills, from
/// afar in its area.
class RectangleLight final : public AreaLight {
  public:
    RectangleLight(TexturePtr radiance, const RayScene& rays, std::uint32_t shape,
                   const Rectangle& rectangle)
        : AreaLight(std::move(radiance), rays, shape),
          rectangle_(rectangle),
          normal_(rays.sample_area(shape, {0.5f, 0.5f}).n),
          corner_(rectangle.corner),
          x_edge_(rectangle.x_axis * rectangle.width),
          y_edge_(rectangle.y_axis * rectangle.height),
          area_(static_cast<float>(rectangle.width * rectangle.height)) {}

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& w) const override {
        if (!in_front(from)) return {};
        if (far(from)) {
            const Vec3f to = corner_ + x_edge_ * u.x + y_edge_ * u.y - from;
            const float distance = length(to);
            const Vec3f wi = to * (1.f / distance);
            return {wi, distance, radiance_->eval({}, w), pdf_by_area(distance, wi)};
        }
        const SphericalRectangle seen(rectangle_, Vec3d(from));
        const Vec3d d = seen.sample(u);
        const double distance = length(d);
        return {Vec3f(d * (1.0 / distance)), static_cast<float>(distance), radiance_->eval({}, w),
                static_cast<float>(1.0 / seen.solid_angle())};
    }

    float pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const override {
        if (!on_light || !in_front(from)) return 0.f;
        if (far(from)) return pdf_by_area(length(on_light->p - from), wi);
        return static_cast<float>(1.0 / SphericalRectangle(rectangle_, Vec3d(from)).solid_angle());
    }

  private:
    /// From where the rectangle spans less than 45 degrees, points drawn by area differ little from
    /// points drawn by solid angle (cosine and squared distance vary by a third over it), and cost
    /// a fifth. 0.7 is (2 tan 22.5 degrees)^2.
    static constexpr float largest_span2 = 0.7f;

    bool far(const Point3f& from) const {
        const Vec3f to = corner_ + (x_edge_ + y_edge_) * 0.5f - from;
        return length_squared(x_edge_ + y_edge_) < largest_span2 * length_squared(to);
    }
    float pdf_by_area(float distance, const Vec3f& wi) const {
        return distance * distance / (area_ * std::max(1e-6f, -dot(wi, normal_)));
    }
    bool in_front(const Point3f& from) const {
        return dot(Vec3d(from) - rectangle_.corner, Vec3d(normal_)) > 0.0;
    }

    Rectangle rectangle_;
    Vec3f normal_, corner_, x_edge_, y_edge_;
    float area_;
};

}  // namespace

LightPtr make_area_light(const SceneNode& node, const RayScene& rays, std::uint32_t shape,
                         BuildContext& context) {
    if (node.type != "area")
        node.fail(fmt::format("unknown emitter type '{}' of a shape{}", node.type,
                              suggestion(node.type, {"area"})));
    if (!(rays.area(shape) > 0.0)) node.fail("the shape of an area light has no area");
    // Shapes that are drawn by solid angle do not know the texture coordinates of the drawn point.
    const bool textured = node.child("radiance", "texture") != nullptr;
    const TexturePtr radiance =
        textured ? get_texture(node, "radiance", ColorRole::illuminant, 1.f, context)
                 : make_constant_texture(
                       get_spectrum(node, "radiance", ColorRole::illuminant, default_emission()));
    node.check_all_used();
    if (textured) return std::make_shared<AreaLight>(radiance, rays, shape);
    if (const Primitive* primitive = rays.primitive(shape))
        if (const Sphere* sphere = std::get_if<Sphere>(primitive))
            return std::make_shared<SphereLight>(radiance, rays, shape, *sphere);
    if (const Mesh* mesh = rays.mesh(shape))
        if (const auto rectangle = as_rectangle(*mesh))
            return std::make_shared<RectangleLight>(radiance, rays, shape, *rectangle);
    return std::make_shared<AreaLight>(radiance, rays, shape);
}

}  // namespace nacre
