#include "nacre/realtime/gpu_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/realtime/shape_vertices.h"
#include "nacre/render/object_boundary.h"
#include "nacre/scene/subsurface.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
using Vec4 = std::array<float, 4>;

Vec4 with(const Vec3f& v, float w) { return {v.x, v.y, v.z, w}; }

Vec3f rgb_of(Spectral s) { return to_rgb(s, Wavelengths::rgb_bands()); }

/// Share of even light that a material sends back to `wo` at 45 degrees, in the middle of the
/// shape's first triangle.
Vec3f albedo_of(const Scene& scene, std::uint32_t shape) {
    constexpr int samples = 256;
    const SurfacePoint at = scene.rays.surface_point({}, {.shape = shape, .u = 0.3f, .v = 0.3f});
    BsdfScratch scratch;
    const Bsdf& bsdf = scene.shapes[shape].material->at(at, Wavelengths::rgb_bands(), scratch);
    const Vec3f wo{std::sqrt(0.5f), 0.f, std::sqrt(0.5f)};
    Spectral sum(0.f);
    for (int i = 0; i < samples; ++i) {
        const float u = (float(i) + 0.5f) / samples;
        const Vec2f u2{u, std::fmod(float(i) * 0.61803399f, 1.f)};
        // What a mirror shows is nothing that Lambert's law can stand for.
        if (const auto s = bsdf.sample(wo, std::fmod(float(i) * 0.7548777f, 1.f), u2))
            if (s->wi.z > 0.f && !s->delta) sum += s->weight * Spectral(1.f / samples);
    }
    return rgb_of(sum);
}

Vec3f direction_of(int x, int y, int width, int height) {
    const float phi = 2.f * pi * (float(x) + 0.5f) / float(width);
    const float theta = pi * (float(y) + 0.5f) / float(height);
    return {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

constexpr int sky_width = 1024, sky_height = 512;

}  // namespace

GpuScene::GpuScene(Gpu&, const Scene& scene, const std::vector<ShapeTechnique>& translucent,
                   const Work& work)
    : scene_(scene) {
    for (const ShapeTechnique& s : translucent) is_translucent_.push_back(s.technique != nullptr);
    is_translucent_.resize(scene.shapes.size(), false);
    changed({.light = true, .material = true, .geometry = true}, work);
}

void GpuScene::changed(const Changes& what, const Work& work) {
    if (what.geometry) make_geometry(work);
    if (what.geometry || what.material || what.light) {
        make_materials();
        make_surroundings(work);
    }
}

void GpuScene::make_geometry(const Work& work) {
    shapes_.clear();
    bounds_ = {};
    std::vector<std::uint32_t> order(scene_.shapes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto kind = [&](std::uint32_t i) {
        return is_translucent_[i]       ? GpuShapeKind::translucent
               : scene_.shapes[i].light ? GpuShapeKind::lamp
                                        : GpuShapeKind::opaque;
    };
    const auto rank = [&](std::uint32_t i) {
        return kind(i) == GpuShapeKind::translucent ? 0 : kind(i) == GpuShapeKind::opaque ? 1 : 2;
    };
    std::ranges::stable_sort(order, {}, rank);
    std::vector<Vec4> positions, normals;
    std::vector<std::array<std::uint32_t, 4>> indices;
    occluders_ = 0;
    for (const std::uint32_t i : order) {
        work.check();
        const ShapeVertices v = shape_vertices(scene_.rays, i);
        GpuShape s{.kind = kind(i),
                   .shape = i,
                   .first_triangle = std::uint32_t(indices.size()),
                   .triangles = std::uint32_t(v.triangles.size()),
                   .first_vertex = std::uint32_t(positions.size()),
                   .vertices = std::uint32_t(v.positions.size())};
        for (const Mesh::Triangle& t : v.triangles)
            indices.push_back({t[0] + s.first_vertex, t[1] + s.first_vertex, t[2] + s.first_vertex,
                               std::uint32_t(shapes_.size())});
        for (std::size_t k = 0; k < v.positions.size(); ++k) {
            positions.push_back(with(v.positions[k], 1.f));
            normals.push_back(with(v.normals[k], 0.f));
        }
        s.set_bounds([&](std::uint32_t k) { return v.positions[k]; });
        if (s.kind != GpuShapeKind::lamp) {
            bounds_.extend(s.bounds);
            occluders_ = std::uint32_t(indices.size());
        }
        shapes_.push_back(s);
    }
    // Triangles are numbered from 1 in 32 bits, and buffers are addressed in 32 bits.
    constexpr std::size_t largest = std::size_t{1} << 27;
    if (indices.size() > largest || positions.size() > largest)
        throw InputError(
            fmt::format("{} triangles are more than frames in real time take ({}): give a "
                        "simpler mesh, or use an offline technique",
                        indices.size(), largest));
    if (bounds_.empty())
        for (const GpuShape& s : shapes_) bounds_.extend(s.bounds);
    triangle_count_ = std::uint32_t(indices.size());
    vertex_count_ = std::uint32_t(positions.size());
    positions_ = Buffer(positions);
    normals_ = Buffer(normals);
    indices_ = Buffer(indices);
    rest_positions_ = {};
    rest_normals_ = {};
    deformation_ = {};
    rest_box_ = {};
    for (const GpuShape& s : shapes_)
        if (s.kind == GpuShapeKind::translucent) rest_box_.extend(s.bounds);
}

void GpuScene::make_materials() {
    std::vector<Vec4> materials;
    for (const GpuShape& s : shapes_) {
        const ShapeBinding& shape = scene_.shapes[s.shape];
        Vec3f color{0.f, 0.f, 0.f};
        float eta = 1.f;
        switch (s.kind) {
            case GpuShapeKind::opaque:
                color = albedo_of(scene_, s.shape);
                break;
            case GpuShapeKind::translucent:
                eta = boundary_eta(shape);
                break;
            case GpuShapeKind::lamp: {
                const SurfacePoint at =
                    scene_.rays.surface_point({}, {.shape = s.shape, .u = 0.3f, .v = 0.3f});
                color = rgb_of(shape.light->radiance(&at, -at.ng, Wavelengths::rgb_bands()));
                break;
            }
        }
        materials.push_back(with(color, float(int(s.kind))));
        materials.push_back({eta, 0.f, 0.f, 0.f});
    }
    materials_ = Buffer(materials);
}

void GpuScene::make_surroundings(const Work& work) {
    const Wavelengths bands = Wavelengths::rgb_bands();
    Box3f translucent;
    for (const GpuShape& s : shapes_)
        if (s.kind == GpuShapeKind::translucent) translucent.extend(s.bounds);
    const Point3f middle = (translucent.empty() ? bounds_ : translucent).center();
    std::vector<Vec3f> albedo(scene_.shapes.size());
    for (const GpuShape& s : shapes_)
        if (s.kind == GpuShapeKind::opaque) albedo[s.shape] = albedo_of(scene_, s.shape);
    // What a ray from the middle meets; opaque surfaces in the light of one draw of each lamp.
    const auto met = [&](Vec3f d, std::size_t pixel) {
        Point3f o = middle;
        for (int step = 0; step < 64; ++step) {
            const Ray ray{o, d};
            const auto hit = scene_.rays.intersect(ray);
            if (!hit) break;
            const SurfacePoint at = scene_.rays.surface_point(ray, *hit);
            const ShapeBinding& shape = scene_.shapes[hit->shape];
            if (is_translucent_[hit->shape]) {
                o = at.spawn(d);
                continue;
            }
            if (shape.light) return rgb_of(shape.light->radiance(&at, d, bands));
            Vec3f sum{0.f, 0.f, 0.f};
            const Vec3f n = dot(at.ng, d) < 0.f ? at.ng : -at.ng;
            for (const LightPtr& light : scene_.lights) {
                const Vec2f u{std::fmod(float(pixel) * 0.75487767f, 1.f),
                              std::fmod(float(pixel) * 0.56984029f, 1.f)};
                const LightSample s = light->sample(at.p, u, bands);
                const float cosine = s.pdf > 0.f ? dot(s.wi, n) : 0.f;
                if (!(cosine > 0.f)) continue;
                if (scene_.rays.occluded({at.spawn(s.wi), s.wi, 0.f, s.distance * 0.999f}))
                    continue;
                sum += rgb_of(s.radiance) * (cosine / (pi * s.pdf));
            }
            return sum * albedo[hit->shape];
        }
        const Light* beyond = scene_.environment;
        return beyond ? rgb_of(beyond->radiance(nullptr, d, bands)) : Vec3f{0.f, 0.f, 0.f};
    };
    std::vector<float> around(4 * sky_width * sky_height), behind(around.size());
    tbb::parallel_for(0, sky_height, [&](int y) {
        if (work.stopped()) return;
        for (int x = 0; x < sky_width; ++x) {
            const Vec3f d = direction_of(x, y, sky_width, sky_height);
            const std::size_t pixel = std::size_t(y) * sky_width + std::size_t(x);
            const Vec3f a = met(d, pixel);
            const Light* beyond = scene_.beyond(0);
            const bool hidden = scene_.integrator.hide_emitters && !scene_.background;
            const Vec3f b = beyond && !hidden ? rgb_of(beyond->radiance(nullptr, d, bands))
                                              : Vec3f{0.f, 0.f, 0.f};
            for (std::size_t c = 0; c < 3; ++c) {
                around[4 * pixel + c] = a[c];
                behind[4 * pixel + c] = b[c];
            }
        }
    });
    work.check();
    surroundings_ = Texture(TexelFormat::rgba32f, sky_width, sky_height);
    surroundings_.upload(around);
    background_ = Texture(TexelFormat::rgba32f, sky_width, sky_height);
    background_.upload(behind);
}

void GpuScene::deform(Gpu& gpu, const Deformation& deformation) {
    if (deformation == deformation_) return;
    deformation_ = deformation;
    if (rest_positions_.bytes() == 0) {
        rest_positions_ = std::move(positions_);
        rest_normals_ = std::move(normals_);
        positions_ = Buffer(rest_positions_.bytes(), nullptr);
        normals_ = Buffer(rest_normals_.bytes(), nullptr);
    }
    std::uint32_t vertices = 0;
    for (const GpuShape& s : shapes_)
        if (s.kind == GpuShapeKind::translucent) vertices = s.first_vertex + s.vertices;
    gpu.compute("deform", gpu.program("deform.glsl"))
        .reads(0, rest_positions_)
        .reads(1, rest_normals_)
        .writes(2, positions_)
        .writes(3, normals_)
        .set("vertices", vertex_count_)
        .set("translucent_vertices", vertices)
        .set("kind", int(deformation.kind))
        .set("amount", deformation.amount)
        .set("phase", deformation.phase)
        .set("box_low", rest_box_.lower)
        .set("box_size", rest_box_.diagonal())
        .threads(int(vertex_count_));
    // Where they are now: lights' pictures are framed by it.
    std::vector<Vec4> now(vertices);
    positions_.read(0, vertices * sizeof(Vec4), now.data());
    bounds_ = {};
    for (GpuShape& s : shapes_) {
        if (s.kind == GpuShapeKind::translucent)
            s.set_bounds([&](std::uint32_t i) {
                const Vec4& p = now[s.first_vertex + i];
                return Point3f(p[0], p[1], p[2]);
            });
        if (s.kind != GpuShapeKind::lamp) bounds_.extend(s.bounds);
    }
}

std::size_t GpuScene::bytes() const {
    return positions_.bytes() + normals_.bytes() + indices_.bytes() + materials_.bytes() +
           rest_positions_.bytes() + rest_normals_.bytes() + surroundings_.bytes() +
           background_.bytes();
}

}  // namespace nacre
