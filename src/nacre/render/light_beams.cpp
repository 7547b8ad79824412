#include "nacre/render/light_beams.h"

#include <algorithm>
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/medium_pieces.h"

namespace nacre {

namespace {

// A facet over which the direction turns further is divided, so often at most.
constexpr int most_divisions = 12;
// A long beam is boxed in pieces about as long as this many times its facet's size, but in no more
// than so many: each halving of the boxes' length drops three quarters of the false finds.
constexpr float piece_in_sizes = 3.f;
constexpr int most_pieces = 20;
// How far beyond a facet's edge, in its own barycentric coordinates, the interpolated solution may
// lie and the true one still within, beside what the facet's curvature makes of it.
constexpr float least_doubt = 0.02f;
constexpr int most_steps = 12;
constexpr double small_step = 1e-4, far_away = 4;

float turn_cosine(const std::array<Vec3f, 3>& d) {
    return std::min({dot(d[0], d[1]), dot(d[1], d[2]), dot(d[2], d[0])});
}

Box3f common(const Box3f& a, const Box3f& b) {
    return {{std::max(a.lower.x, b.lower.x), std::max(a.lower.y, b.lower.y),
             std::max(a.lower.z, b.lower.z)},
            {std::min(a.upper.x, b.upper.x), std::min(a.upper.y, b.upper.y),
             std::min(a.upper.z, b.upper.z)}};
}

bool is_empty(const Box3f& b) {
    return b.lower.x > b.upper.x || b.lower.y > b.upper.y || b.lower.z > b.upper.z;
}

}  // namespace

/// Makes the beams of one light through one boundary.
class LightBeams::Builder {
  public:
    Builder(LightBeams& beams, std::vector<Box3f>& boxes, std::uint32_t shape)
        : beams_(beams), boxes_(boxes), binding_(beams.scene_->shapes[shape]) {
        const RayScene& rays = beams.scene_->rays;
        eta_ = binding_.material->smooth_boundary_eta();
        // Where nothing encloses the matter below, its end is not known.
        region_ = is_closed(rays, shape) ? rays.bounds(shape) : rays.bounds();
        const Vec3f reach = region_.diagonal();
        const float margin = 1e-4f * length(reach);
        region_.lower = region_.lower - Vec3f(margin, margin, margin);
        region_.upper = region_.upper + Vec3f(margin, margin, margin);
        reach_ = length(reach);
        const Medium* medium = binding_.interior;
        if (medium && medium->homogeneous()) {
            // Half of it: other wavelengths than the bands may be absorbed less.
            const Vec3f sigma = medium->sigma_t->rgb();
            const float least = 0.5f * std::min({sigma.x, sigma.y, sigma.z}) * medium->scale;
            reach_ = std::min(reach_, cut_in_free_paths / std::max(least, 1e-30f));
        }
    }

    void add(std::uint32_t source, const ChartTriangle& piece) {
        source_ = source;
        divide(piece, 0);
    }

  private:
    struct Corner {
        Vec3d p, d;
        double cos_out;
    };
    Corner corner(const ChartTriangle& piece, double a, double b) const {
        const SurfaceChart at = beams_.scene_->rays.chart(piece, a, b);
        const RefractedLight light = refract_light(at, beams_.sources_[source_].place, eta_);
        return {at.p, light.d, light.cos_out};
    }

    void divide(const ChartTriangle& piece, int level) {
        const std::array<Corner, 3> c{corner(piece, 0, 0), corner(piece, 1, 0),
                                      corner(piece, 0, 1)};
        // Of the side opposite to each corner.
        const std::array<Corner, 3> middle{corner(piece, 0.5, 0.5), corner(piece, 0, 0.5),
                                           corner(piece, 0.5, 0)};
        double highest = -1;
        for (const auto& corners : {c, middle})
            for (const Corner& each : corners) highest = std::max(highest, each.cos_out);
        std::array<Vec3f, 3> d;
        for (int i = 0; i < 3; ++i) d[std::size_t(i)] = Vec3f(c[std::size_t(i)].d);
        const bool even = turn_cosine(d) > std::cos(widest_turn);
        // The lit part of a coarse facet may lie between the corners that were looked at.
        if (highest <= (even ? 0. : -0.5)) return;
        if (!even && level < most_divisions) {
            const std::array<Vec3d, 3>& q = piece.corners;
            const std::array<Vec3d, 3> m{piece.at(0.5, 0.5), piece.at(0, 0.5), piece.at(0.5, 0)};
            for (const std::array<Vec3d, 3>& part :
                 {std::array{q[0], m[2], m[1]}, std::array{m[2], q[1], m[0]},
                  std::array{m[1], m[0], q[2]}, m})
                divide({piece.shape, piece.primitive, part}, level + 1);
            return;
        }
        // How far surface and directions leave what the corners say.
        double bulge = 0, spread = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner &a = c[(i + 1) % 3], &b = c[(i + 2) % 3];
            bulge = std::max(bulge, length(middle[i].p - (a.p + b.p) * 0.5));
            spread = std::max(spread, length(middle[i].d - (a.d + b.d) * 0.5));
        }
        Facet facet{{}, d, piece, 0, 0, source_};
        double longest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            facet.p[i] = Point3f(c[i].p);
            longest = std::max(longest, length(c[i].p - c[(i + 1) % 3].p));
        }
        const double height = length(cross(c[1].p - c[0].p, c[2].p - c[0].p)) / longest;
        facet.bulge = float(2 * bulge / height);
        facet.spread = float(2 * spread / height);
        add_boxes(facet, float(2 * bulge), float(2 * spread));
    }

    void add_boxes(const Facet& facet, float bulge, float spread) {
        const float size =
            std::max({length(facet.p[0] - facet.p[1]), length(facet.p[1] - facet.p[2]),
                      length(facet.p[2] - facet.p[0])});
        const int pieces =
            std::clamp(int(std::ceil(reach_ / (piece_in_sizes * size))), 1, most_pieces);
        bool used = false;
        for (int k = 0; k < pieces; ++k) {
            const float t0 = reach_ * float(k) / float(pieces),
                        t1 = reach_ * float(k + 1) / float(pieces);
            Box3f box;
            for (std::size_t i = 0; i < 3; ++i) {
                box.extend(facet.p[i] + facet.d[i] * t0);
                box.extend(facet.p[i] + facet.d[i] * t1);
            }
            const float by = bulge + spread * t1 + 1e-5f * size;
            box.lower = box.lower - Vec3f(by, by, by);
            box.upper = box.upper + Vec3f(by, by, by);
            box = common(box, region_);
            if (is_empty(box)) {
                if (used) break;
                continue;
            }
            used = true;
            boxes_.push_back(box);
            beams_.facet_of_.push_back(std::uint32_t(beams_.facets_.size()));
        }
        if (!used) return;
        beams_.facets_.push_back(facet);
        Cone cone{(facet.p[0] + facet.p[1] + facet.p[2]) * (1.f / 3),
                  normalize(facet.d[0] + facet.d[1] + facet.d[2]), 0.f, spread};
        for (std::size_t i = 0; i < 3; ++i) {
            cone.radius = std::max(cone.radius, length(facet.p[i] - cone.p) + bulge);
            cone.spread = std::max(cone.spread, length(facet.d[i] - cone.d) + spread);
        }
        cone.radius *= 1.0001f;
        beams_.cones_.push_back(cone);
    }

    LightBeams& beams_;
    std::vector<Box3f>& boxes_;
    std::uint32_t source_ = 0;
    const ShapeBinding& binding_;
    float eta_ = 1.f, reach_ = 0.f;
    Box3f region_;
};

LightBeams::LightBeams(const Scene& scene, const Work& work)
    : scene_(&scene), sources_(sources_without_extent(scene)) {
    if (sources_.empty()) return;
    std::vector<Box3f> boxes;
    for (std::uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
        if (!(scene.shapes[shape].material->smooth_boundary_eta() > 1.f)) continue;
        const std::vector<ChartTriangle> pieces = scene.rays.chart_triangles(shape);
        WorkPhase phase(work, "light beams", pieces.size());
        Builder builder(*this, boxes, shape);
        for (const ChartTriangle& piece : pieces) {
            phase.advance();
            for (std::uint32_t s = 0; s < sources_.size(); ++s) builder.add(s, piece);
        }
    }
    tree_ = BoxTree(std::move(boxes));
}

bool LightBeams::near(const Facet& facet, const Point3f& y, double& in_a, double& in_b) {
    // Two steps of Newton's method on the beam whose corners are interpolated.
    const Vec3f pu = facet.p[1] - facet.p[0], pv = facet.p[2] - facet.p[0];
    const Vec3f du = facet.d[1] - facet.d[0], dv = facet.d[2] - facet.d[0];
    float a = 1.f / 3, b = 1.f / 3;
    for (int step = 0; step < 2; ++step) {
        const Vec3f d = facet.d[0] + du * a + dv * b;
        const Vec3f from = y - (facet.p[0] + pu * a + pv * b);
        const float t = dot(from, d);
        const Vec3f along_u = pu + du * t, along_v = pv + dv * t;
        const Vec3f across = cross(along_u, along_v);
        const float volume = dot(across, d);
        if (volume == 0.f) break;
        a += dot(cross(from, along_v), d) / volume;
        b += dot(cross(along_u, from), d) / volume;
    }
    in_a = a;
    in_b = b;
    const float t = dot(y - facet.p[0], facet.d[0]);
    const float doubt = least_doubt + facet.bulge + facet.spread * std::max(0.f, t);
    return a > -doubt && b > -doubt && a + b < 1 + doubt;
}

bool LightBeams::solve(const Facet& facet, const Point3f& point, double a, double b,
                       Way& way) const {
    const LightPlace& place = sources_[facet.source].place;
    const double eta = scene_->shapes[facet.piece.shape].material->smooth_boundary_eta();
    const Vec3d y(point);
    for (int step = 0; step < most_steps; ++step) {
        const SurfaceChart at = scene_->rays.chart(facet.piece, a, b);
        double da, db;
        if (!step_towards(y, at, refract_light(at, place, eta), da, db)) return false;
        a += da;
        b += db;
        // Steps shrink quadratically: the next would be the square of this.
        if (std::abs(da) + std::abs(db) < small_step)
            return a >= 0 && b >= 0 && a + b < 1 && complete(facet, y, a, b, way);
        // Far outside of the facet there is nothing of it to find.
        if (std::abs(a - 1. / 3) + std::abs(b - 1. / 3) > far_away) return false;
    }
    return false;
}

bool LightBeams::complete(const Facet& facet, const Vec3d& y, double a, double b, Way& way) const {
    const std::optional<Hit> hit = scene_->rays.chart_hit(facet.piece, a, b);
    if (!hit) return false;
    const LightPlace& place = sources_[facet.source].place;
    const double eta = scene_->shapes[facet.piece.shape].material->smooth_boundary_eta();
    const SurfaceChart at = scene_->rays.chart(facet.piece, a, b);
    const RefractedLight light = refract_light(at, place, eta);
    const double t = dot(y - at.p, light.d);
    const Vec3d to_light = place.distant ? place.place : place.place - at.p;
    if (!(t > 0) || !(light.cos_out > 0) || !(dot(to_light, at.ng) > 0) ||
        !(dot(light.d, at.ng) < 0))
        return false;
    way.light = sources_[facet.source].light;
    way.at = scene_->rays.surface_point({}, *hit);
    way.inside = Vec3f(-light.d);
    way.length = float(t);
    way.gain =
        float((1 - fresnel_dielectric(light.cos_out, eta)) * refraction_gain(y, at, place, eta));
    return std::isfinite(way.gain);
}

void LightBeams::find(const Point3f& y, float reach, std::vector<Way>& ways,
                      std::vector<std::uint32_t>& scratch) const {
    ways.clear();
    tree_.holding(y, scratch);
    const auto misses = [&](std::uint32_t box) {
        const Cone& cone = cones_[facet_of_[box]];
        const Vec3f from = y - cone.p;
        const float t = dot(from, cone.d), widest = cone.radius + cone.spread * std::max(t, 0.f);
        return t < -widest || t > reach + widest ||
               length_squared(from) - t * t > 1.001f * widest * widest;
    };
    std::erase_if(scratch, misses);
    // The order of a tree's answers is its own affair; sums must not hang on it.
    std::ranges::sort(scratch);
    std::uint32_t last = ~0u;
    for (const std::uint32_t box : scratch) {
        // The pieces of a beam follow each other; a point near their ends is in two.
        if (facet_of_[box] == last) continue;
        last = facet_of_[box];
        const Facet& facet = facets_[last];
        double a, b;
        Way way;
        if (near(facet, y, a, b) && solve(facet, y, a, b, way) && way.length < reach)
            ways.push_back(way);
    }
}

}  // namespace nacre
