// The local geometry of surfaces: points, normals, shading frames, uniform points by area.
#include <algorithm>
#include <cmath>

#include "nacre/geometry/ray_scene.h"
#include "nacre/geometry/ray_scene_impl.h"

namespace nacre {
namespace {

constexpr float kHalfUlp = 0x1p-24f;

float largest(const Vec3f& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// A unit normal of a triangle; any perpendicular of its longest side if it has no area.
Vec3d triangle_normal(const Vec3d& e1, const Vec3d& e2) {
    const Vec3d n = cross(e1, e2);
    if (const double len = length(n); len > 0) return n / len;
    const Vec3d& side = dot(e1, e1) > dot(e2, e2) ? e1 : e2;
    const double len = length(side);
    return len > 0 ? Frame<double>::around(side / len).s : Vec3d{0, 0, 1};
}

}  // namespace

Point3f SurfacePoint::spawn(const Vec3f& d) const {
    // The start is moved along the geometric normal by the bound of the surface's and the ray
    // query's error plus that of this very sum, each axis of which is rounded once: at most
    // sqrt(3) half ulps of the largest coordinate, 4 taken. Only the distance from the surface
    // counts, so the step need not grow towards grazing directions. A constant in ulps, as in
    // Waechter and Binder 2019, A Fast and Robust Method for Avoiding Self-Intersection, Ray
    // Tracing Gems ch. 6, but with the size of the triangle in it, which theirs leaves out.
    const float step = error + 4 * kHalfUlp * largest(p);
    return p + ng * (dot(d, ng) >= 0.f ? step : -step);
}

SurfacePoint RayScene::Impl::Shape::surface(std::uint32_t primitive, float u, float v) const {
    return mesh ? mesh_surface(primitive, u, v) : analytic_surface(u, v);
}

SurfacePoint RayScene::Impl::Shape::mesh_surface(std::uint32_t primitive, float u, float v) const {
    const Mesh::Triangle& t = mesh->triangles[primitive];
    const Point3f &p0 = mesh->positions[t[0]], &p1 = mesh->positions[t[1]],
                  &p2 = mesh->positions[t[2]];
    const Vec3d e1 = Vec3d(p1) - Vec3d(p0), e2 = Vec3d(p2) - Vec3d(p0);
    const float w = 1.f - u - v;
    const float side = flip_normals ? -1.f : 1.f;

    SurfacePoint point;
    point.p = Point3f(Vec3d(p0) + e1 * double(u) + e2 * double(v));
    point.ng = Vec3f(triangle_normal(e1, e2)) * side;
    // Rounding of p, and of Embree's single-precision test, which works on the triangle moved to
    // the ray's origin: relative errors of about eight half ulps of the longest side.
    const double side2 = std::max({dot(e1, e1), dot(e2, e2), length_squared(e2 - e1)});
    point.error = kHalfUlp * (2 * largest(point.p) + 16 * static_cast<float>(std::sqrt(side2)));

    Vec3f n = point.ng;
    if (!mesh->normals.empty() && !face_normals) {
        const Vec3f smooth =
            mesh->normals[t[0]] * w + mesh->normals[t[1]] * u + mesh->normals[t[2]] * v;
        const float len = length(smooth);
        if (len > 0.f) n = smooth * (1.f / len);
        if (dot(n, point.ng) < 0.f) n = -n;
    }
    if (mesh->uvs.empty()) {
        point.uv = {u, v};
        point.shading = Framef::around(n);
        return point;
    }
    const Vec2f &uv0 = mesh->uvs[t[0]], &uv1 = mesh->uvs[t[1]], &uv2 = mesh->uvs[t[2]];
    point.uv = uv0 * w + uv1 * u + uv2 * v;
    const Vec2f d1 = uv1 - uv0, d2 = uv2 - uv0;
    // dp/du up to a positive factor: only its direction is used.
    const float det = d1.x * d2.y - d1.y * d2.x;
    const Vec3d dpdu = (e1 * double(d2.y) - e2 * double(d1.y)) * (det < 0.f ? -1.0 : 1.0);
    const double len = length(dpdu);
    point.shading =
        det != 0.f && len > 0 ? Framef::with_tangent(n, Vec3f(dpdu / len)) : Framef::around(n);
    return point;
}

SurfacePoint RayScene::Impl::Shape::analytic_surface(float u, float v) const {
    const AnalyticPoint at = analytic->at(u, v);
    SurfacePoint point;
    point.p = Point3f(at.p);
    point.ng = Vec3f(at.n);
    point.shading = Framef::with_tangent(point.ng, Vec3f(normalize(at.dpdu)));
    point.uv = at.uv;
    // Everything but the last rounding happens in double precision: 2^-30 of the size is ample.
    point.error = 2 * kHalfUlp * largest(point.p) + 0x1p-30f * static_cast<float>(analytic->size());
    return point;
}

const std::vector<double>& RayScene::Impl::Shape::cumulative_area() const {
    std::call_once(cumulative_made, [&] {
        cumulative.reserve(mesh->triangles.size());
        double sum = 0;
        for (const Mesh::Triangle& t : mesh->triangles) {
            const Vec3d a(mesh->positions[t[0]]);
            sum += 0.5 * length(cross(Vec3d(mesh->positions[t[1]]) - a,
                                      Vec3d(mesh->positions[t[2]]) - a));
            cumulative.push_back(sum);
        }
    });
    return cumulative;
}

double RayScene::area(std::uint32_t shape) const {
    const Impl::Shape& s = *impl_->shapes.at(shape);
    return s.mesh ? s.cumulative_area().back() : s.analytic->area();
}

AreaSample RayScene::sample_area(std::uint32_t shape, Vec2f u) const {
    const Impl::Shape& s = *impl_->shapes.at(shape);
    if (!s.mesh) {
        double pdf = 0;
        const AnalyticHit hit = s.analytic->sample(u, pdf);
        const AnalyticPoint at = s.analytic->at(hit.u, hit.v);
        return {Point3f(at.p), Vec3f(at.n), at.uv, static_cast<float>(pdf)};
    }
    const std::vector<double>& sums = s.cumulative_area();
    const double target = u.x * sums.back();
    const auto found = std::min(std::upper_bound(sums.begin(), sums.end(), target), sums.end() - 1);
    const double below = found == sums.begin() ? 0.0 : *(found - 1);
    // What is left of u.x after the choice of the triangle is uniform again. Its 24 bits leave
    // coarse positions within triangles beyond some ten thousand of them.
    const double rest = std::clamp((target - below) / (*found - below), 0.0, 1.0);
    const double root = std::sqrt(rest);
    const SurfacePoint point =
        s.surface(static_cast<std::uint32_t>(found - sums.begin()), static_cast<float>(1 - root),
                  static_cast<float>(u.y * root));
    return {point.p, point.ng, point.uv, static_cast<float>(1 / sums.back())};
}

}  // namespace nacre
