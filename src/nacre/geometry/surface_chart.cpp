#include "nacre/geometry/surface_chart.h"

#include <cmath>
#include <numbers>

#include "nacre/geometry/ray_scene.h"
#include "nacre/geometry/ray_scene_impl.h"

namespace nacre {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The unit vector along `raw`, and its derivatives by those of `raw`.
void set_normal(SurfaceChart& chart, const Vec3d& raw, const Vec3d& raw_a, const Vec3d& raw_b) {
    const double inverse = 1 / length(raw);
    chart.n = raw * inverse;
    chart.na = (raw_a - chart.n * dot(chart.n, raw_a)) * inverse;
    chart.nb = (raw_b - chart.n * dot(chart.n, raw_b)) * inverse;
}

void flip(SurfaceChart& chart) {
    chart.n = -chart.n;
    chart.na = -chart.na;
    chart.nb = -chart.nb;
}

/// Two triangles for each of `n` steps of u.
std::vector<ChartTriangle> strip(std::uint32_t shape, double u0, double u1, int n, double v0,
                                 double v1) {
    std::vector<ChartTriangle> triangles;
    for (int i = 0; i < n; ++i) {
        const double left = u0 + (u1 - u0) * i / n, right = u0 + (u1 - u0) * (i + 1) / n;
        const Vec3d a{left, v0, 0}, b{right, v0, 0}, c{right, v1, 0}, d{left, v1, 0};
        triangles.push_back({shape, 0, {a, b, c}});
        triangles.push_back({shape, 0, {a, c, d}});
    }
    return triangles;
}

}  // namespace

SurfaceChart AnalyticShape::chart(const ChartTriangle& triangle, double a, double b) const {
    SurfaceChart chart;
    const Vec3d q = triangle.at(a, b), qa = triangle.corners[1] - triangle.corners[0],
                qb = triangle.corners[2] - triangle.corners[0];
    if (kind_ == Kind::Sphere) {
        set_normal(chart, q, qa, qb);
        chart.p = o_ + chart.n * radius_;
        chart.pa = chart.na * radius_;
        chart.pb = chart.nb * radius_;
    } else if (kind_ == Kind::Disk) {
        chart.p = local(q.x, q.y, 0);
        chart.pa = x_ * qa.x + y_ * qa.y;
        chart.pb = x_ * qb.x + y_ * qb.y;
        chart.n = normalize(to_world_.map_normal({0, 0, 1}));
    } else {
        const double phi = q.x * two_pi, c = std::cos(phi), s = std::sin(phi);
        const Vec3d pu = (y_ * c - x_ * s) * two_pi;
        const Vec3d nu = to_world_.map_normal({-s, c, 0}) * two_pi;
        chart.p = local(c, s, q.y);
        chart.pa = pu * qa.x + z_ * qa.y;
        chart.pb = pu * qb.x + z_ * qb.y;
        set_normal(chart, to_world_.map_normal({c, s, 0}), nu * qa.x, nu * qb.x);
    }
    if (flip_) flip(chart);
    chart.ng = chart.n;
    return chart;
}

AnalyticHit AnalyticShape::chart_hit(const ChartTriangle& triangle, double a, double b) const {
    const Vec3d q = triangle.at(a, b);
    if (kind_ == Kind::Sphere) return on_sphere(0, q);
    return {0, static_cast<float>(q.x), static_cast<float>(q.y)};
}

std::vector<ChartTriangle> AnalyticShape::chart_triangles(std::uint32_t shape) const {
    if (kind_ == Kind::Disk) return strip(shape, -1, 1, 1, -1, 1);
    if (kind_ == Kind::Cylinder) return strip(shape, 0, 1, 16, 0, 1);
    // The faces of an octahedron.
    std::vector<ChartTriangle> triangles;
    for (int i = 0; i < 8; ++i) {
        const Vec3d x{i & 1 ? 1. : -1., 0, 0}, y{0, i & 2 ? 1. : -1., 0}, z{0, 0, i & 4 ? 1. : -1.};
        triangles.push_back({shape, 0, {x, y, z}});
    }
    return triangles;
}

SurfaceChart RayScene::chart(const ChartTriangle& triangle, double a, double b) const {
    const Impl::Shape& s = *impl_->shapes[triangle.shape];
    if (!s.mesh) return s.analytic->chart(triangle, a, b);
    const Mesh& mesh = *s.mesh;
    const Mesh::Triangle& t = mesh.triangles[triangle.primitive];
    const Vec3d q = triangle.at(a, b), qa = triangle.corners[1] - triangle.corners[0],
                qb = triangle.corners[2] - triangle.corners[0];
    SurfaceChart chart;
    const Vec3d p0(mesh.positions[t[0]]);
    const Vec3d pu = Vec3d(mesh.positions[t[1]]) - p0, pv = Vec3d(mesh.positions[t[2]]) - p0;
    chart.p = p0 + pu * q.x + pv * q.y;
    chart.pa = pu * qa.x + pv * qa.y;
    chart.pb = pu * qb.x + pv * qb.y;
    chart.ng = normalize(cross(pu, pv)) * (s.flip_normals ? -1. : 1.);
    chart.n = chart.ng;
    if (mesh.normals.empty() || s.face_normals) return chart;
    const Vec3d n0(mesh.normals[t[0]]);
    const Vec3d nu = Vec3d(mesh.normals[t[1]]) - n0, nv = Vec3d(mesh.normals[t[2]]) - n0;
    const Vec3d raw = n0 + nu * q.x + nv * q.y;
    if (!(length_squared(raw) > 0)) return chart;
    set_normal(chart, raw, nu * qa.x + nv * qa.y, nu * qb.x + nv * qb.y);
    if (dot(chart.n, chart.ng) < 0) flip(chart);
    return chart;
}

std::optional<Hit> RayScene::chart_hit(const ChartTriangle& triangle, double a, double b) const {
    const Impl::Shape& s = *impl_->shapes[triangle.shape];
    Hit hit{0.f, triangle.shape, triangle.primitive, 0.f, 0.f};
    if (s.mesh) {
        const Vec3d q = triangle.at(a, b);
        hit.u = static_cast<float>(q.x);
        hit.v = static_cast<float>(q.y);
        return hit;
    }
    const AnalyticHit at = s.analytic->chart_hit(triangle, a, b);
    hit.u = at.u;
    hit.v = at.v;
    if (std::holds_alternative<Disk>(*s.primitive) && !(hit.u * hit.u + hit.v * hit.v <= 1.f))
        return std::nullopt;
    return hit;
}

std::vector<ChartTriangle> RayScene::chart_triangles(std::uint32_t shape) const {
    const Impl::Shape& s = *impl_->shapes.at(shape);
    if (!s.mesh) return s.analytic->chart_triangles(shape);
    std::vector<ChartTriangle> triangles(s.mesh->triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        triangles[i] = {
            shape, static_cast<std::uint32_t>(i), {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}};
    return triangles;
}

}  // namespace nacre
