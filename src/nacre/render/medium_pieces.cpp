#include "nacre/render/medium_pieces.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "nacre/math/spread_point.h"

#include "nacre/geometry/mesh_report.h"

namespace nacre {

namespace {

// A ray that looks for certain shapes meets at most so many others.
constexpr int most_other_surfaces = 64;
constexpr int points_on_a_light = 16, points_on_a_shape = 8;

bool overlap(const Box3f& a, const Box3f& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

bool holds(const Box3f& box, const Box3f& other) {
    Box3f both = box;
    both.extend(other);
    return both.lower == box.lower && both.upper == box.upper;
}

bool has(std::span<const std::uint32_t> shapes, std::uint32_t shape) {
    return std::ranges::find(shapes, shape) != shapes.end();
}

/// The first hit on one of `shapes`, whatever else is in between; the ray is moved to the last
/// surface before.
std::optional<Hit> first_of(const Scene& scene, std::span<const std::uint32_t> shapes, Ray& ray,
                            bool& known) {
    known = true;
    for (int i = 0; i < most_other_surfaces; ++i) {
        const auto hit = scene.rays.intersect(ray);
        if (!hit || has(shapes, hit->shape)) return hit;
        ray.o = scene.rays.surface_point(ray, *hit).spawn(ray.d);
    }
    known = false;
    return {};
}

/// Whether a ray in some of several directions leaves one of the shapes.
bool may_be_inside(const Scene& scene, std::span<const std::uint32_t> shapes, const Point3f& p) {
    // No axis, so that faces and edges of boxes are not met edgewise.
    static const std::array<Vec3f, 5> directions{
        normalize(Vec3f{0.36f, 0.48f, 0.8f}), normalize(Vec3f{-0.75f, 0.2f, 0.6f}),
        normalize(Vec3f{0.3f, -0.9f, 0.25f}), normalize(Vec3f{-0.2f, 0.7f, -0.65f}),
        normalize(Vec3f{0.55f, -0.3f, -0.7f})};
    for (const Vec3f& d : directions) {
        Ray ray{p, d};
        bool known;
        const auto hit = first_of(scene, shapes, ray, known);
        if (!known || (hit && dot(scene.rays.surface_point(ray, *hit).ng, d) > 0.f)) return true;
    }
    return false;
}

/// Whether what is outside of `shape` is what is inside of the shapes around `piece`.
bool is_enclosed(const Scene& scene, const MediumPiece& piece, std::uint32_t shape) {
    if (!holds(piece.bounds, scene.rays.bounds(shape))) return false;
    std::vector<std::uint32_t> faces = piece.around;
    faces.insert(faces.end(), piece.within.begin(), piece.within.end());
    const float step = 1e-4f * length(piece.bounds.diagonal());
    for (int i = 0; i < points_on_a_shape; ++i) {
        const AreaSample s = scene.rays.sample_area(shape, spread_point(i));
        Ray ray{s.p + s.n * step, s.n};
        bool known;
        const auto hit = first_of(scene, faces, ray, known);
        if (!hit) return false;
        const bool leaves = dot(scene.rays.surface_point(ray, *hit).ng, ray.d) > 0.f;
        if (leaves != has(piece.around, hit->shape)) return false;
    }
    return true;
}

}  // namespace

MediumPiece whole_of(const Scene& scene, const Medium& medium) {
    MediumPiece whole;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
        if (scene.shapes[i].exterior == &medium) whole.within.push_back(i);
        if (scene.shapes[i].interior != &medium) continue;
        whole.around.push_back(i);
        whole.bounds.extend(scene.rays.bounds(i));
    }
    return whole;
}

std::vector<MediumPiece> pieces_of(const Scene& scene, const MediumPiece& whole) {
    // Sorted by their lower ends, so that shapes far from each other are not compared.
    std::vector<std::size_t> order(whole.around.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::vector<Box3f> boxes;
    for (const std::uint32_t shape : whole.around) boxes.push_back(scene.rays.bounds(shape));
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return boxes[i].lower.x; });
    std::vector<std::size_t> parent(order.size());
    std::iota(parent.begin(), parent.end(), std::size_t(0));
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            if (boxes[order[b]].lower.x > boxes[order[a]].upper.x) break;
            if (!overlap(boxes[order[a]], boxes[order[b]])) continue;
            const std::size_t i = root(order[a]), j = root(order[b]);
            parent[std::max(i, j)] = std::min(i, j);
        }
    std::vector<MediumPiece> pieces;
    std::vector<std::size_t> piece_of(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (root(i) == i) {
            piece_of[i] = pieces.size();
            pieces.emplace_back();
        }
        MediumPiece& piece = pieces[piece_of[root(i)]];
        piece.around.push_back(whole.around[i]);
        piece.bounds.extend(boxes[i]);
    }
    for (const std::uint32_t shape : whole.within) {
        const auto around = std::ranges::find_if(pieces, [&](const MediumPiece& piece) {
            return holds(piece.bounds, scene.rays.bounds(shape));
        });
        if (around == pieces.end()) return {};
        around->within.push_back(shape);
    }
    for (const MediumPiece& piece : pieces)
        for (const std::uint32_t shape : piece.within)
            if (!is_enclosed(scene, piece, shape)) return {};
    return pieces;
}

bool is_closed(const RayScene& rays, std::uint32_t shape) {
    if (const Mesh* mesh = rays.mesh(shape)) return inspect(*mesh).closed();
    return std::holds_alternative<Sphere>(*rays.primitive(shape));
}

std::vector<LightPtr> lights_inside(const Scene& scene, const MediumPiece& piece) {
    std::vector<LightPtr> inside;
    for (const LightPtr& light : scene.lights) {
        const Box3f place = light->bounds();
        if (place.empty() || !overlap(place, piece.bounds)) continue;
        // No path meets such a light by chance: one that is seen through a hole must not be missed.
        bool is_inside =
            light->is_delta() && (may_be_inside(scene, piece.around, place.center()) ||
                                  !std::ranges::all_of(piece.around, [&](std::uint32_t shape) {
                                      return is_closed(scene.rays, shape);
                                  }));
        for (std::uint32_t shape = 0; shape < scene.shapes.size() && !is_inside; ++shape) {
            if (scene.shapes[shape].light != light.get()) continue;
            // What shines itself lights its own inside where its faces are turned.
            is_inside = has(piece.around, shape);
            for (int i = 0; i < points_on_a_light && !is_inside; ++i)
                is_inside = may_be_inside(scene, piece.around,
                                          scene.rays.sample_area(shape, spread_point(i)).p);
        }
        if (is_inside) inside.push_back(light);
    }
    return inside;
}

bool light_overlaps(const Scene& scene, const MediumPiece& piece) {
    return std::ranges::any_of(scene.lights, [&](const LightPtr& light) {
        return !light->bounds().empty() && overlap(light->bounds(), piece.bounds);
    });
}

bool is_open(const Scene& scene, const Medium& medium) {
    const MediumPiece whole = whole_of(scene, medium);
    return scene.camera_medium == &medium || whole.around.empty() ||
           std::ranges::any_of(whole.around,
                               [&](std::uint32_t shape) {
                                   return (scene.shapes[shape].material->flags() & has_null) != 0;
                               }) ||
           light_overlaps(scene, whole);
}

}  // namespace nacre
