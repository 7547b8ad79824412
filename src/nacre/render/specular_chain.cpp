#include "nacre/render/specular_chain.h"

#include <algorithm>
#include <cmath>

#include "nacre/optics/fresnel.h"

namespace nacre {

namespace {

// The chance of reflection at a boundary where both are possible: by what it carries, but so that
// neither is starved.
constexpr double least_chance = 0.1;
// After an event that could be the last, it is with this chance.
constexpr float end_chance = 0.7f;
constexpr int most_steps = 20, most_halvings = 4;
// A chain has arrived within this share of the scene's size, and two are the same if they begin
// within the other.
constexpr double arrived = 1e-6, same_place = 1e-4;
// Trials end here: the reciprocal of a smaller probability is underestimated, and the light of a
// solution found so seldom comes out too dark.
constexpr int most_trials = 10000;

/// A ray and its derivatives by two coordinates.
struct Differential {
    Vec3d o, d;
    std::array<Vec3d, 2> o_by{}, d_by{};
};

/// A piece of surface around a hit, whose coordinates are (0, 0) there.
ChartTriangle piece_at(const RayScene& rays, const Hit& hit, const SurfacePoint& at) {
    ChartTriangle piece{hit.shape, hit.primitive, {}};
    const Primitive* primitive = rays.primitive(hit.shape);
    if (primitive && std::holds_alternative<Sphere>(*primitive)) {
        const Vec3d n = normalize(Vec3d(at.p) - Vec3d(std::get<Sphere>(*primitive).center));
        const Frame<double> frame = Frame<double>::around(n);
        piece.corners = {n, n + frame.s, n + frame.t};
    } else {
        const Vec3d uv{hit.u, hit.v, 0};
        piece.corners = {uv, uv + Vec3d{1, 0, 0}, uv + Vec3d{0, 1, 0}};
    }
    return piece;
}

void turn_against(SurfaceChart& chart, const Vec3d& d) {
    if (dot(chart.ng, d) < 0) return;
    chart.ng = -chart.ng;
    chart.n = -chart.n;
    chart.na = -chart.na;
    chart.nb = -chart.nb;
}

/// Moves the ray to the surface that it meets and sends it on; `chart`'s normals are against it.
/// False if it is reflected totally, or comes from behind the interpolated normal.
bool pass(Differential& ray, const SurfaceChart& chart, bool reflects, double eta) {
    const Vec3d& n = chart.n;
    const double c = -dot(ray.d, n);
    if (!(c > 0)) return false;
    const double t = dot(chart.p - ray.o, ray.d);
    const double c2 = reflects ? 0 : 1 - eta * eta * (1 - c * c);
    if (!(c2 >= 0)) return false;
    const double out = std::sqrt(c2);
    // Directions of the surface against which moves of the hit are measured.
    const double aa = dot(chart.pa, chart.pa), ab = dot(chart.pa, chart.pb),
                 bb = dot(chart.pb, chart.pb), area = aa * bb - ab * ab;
    Differential next{chart.p, reflects ? ray.d + n * (2 * c) : ray.d * eta + n * (eta * c - out)};
    for (std::size_t k = 0; k < 2; ++k) {
        const Vec3d raw = ray.o_by[k] + ray.d_by[k] * t;
        const Vec3d moved = raw - ray.d * (dot(raw, chart.ng) / dot(ray.d, chart.ng));
        const double ma = dot(moved, chart.pa), mb = dot(moved, chart.pb);
        const Vec3d n_by = area > 0 ? chart.na * ((ma * bb - mb * ab) / area) +
                                          chart.nb * ((mb * aa - ma * ab) / area)
                                    : Vec3d{};
        const double c_by = -dot(ray.d_by[k], n) - dot(ray.d, n_by);
        next.o_by[k] = moved;
        next.d_by[k] = reflects ? ray.d_by[k] + n * (2 * c_by) + n_by * (2 * c)
                                : ray.d_by[k] * eta + n_by * (eta * c - out) +
                                      n * ((eta - eta * eta * c / std::max(out, 1e-9)) * c_by);
    }
    next.d = normalize(next.d);
    ray = next;
    return true;
}

}  // namespace

/// The light's ray that begins a chain, and what has become of it after the last vertex.
struct SpecularChains::Beam {
    Differential first, last;

    static Beam of(const LightPlace& place, const Vec3d& through, double far) {
        Beam beam;
        if (place.distant) {
            const Frame<double> frame = Frame<double>::around(-place.place);
            beam.first = {through + place.place * far, frame.n};
            beam.first.o_by = {frame.s, frame.t};
        } else {
            beam.first = {place.place, {}};
            beam.turn_to(through - place.place);
        }
        return beam;
    }
    void turn_to(const Vec3d& direction) {
        const Frame<double> frame = Frame<double>::around(normalize(direction));
        first.d = frame.n;
        first.d_by = {frame.s, frame.t};
    }
    Beam moved(const LightPlace& place, double a, double b) const {
        Beam beam = *this;
        if (place.distant)
            beam.first.o += first.o_by[0] * a + first.o_by[1] * b;
        else
            beam.turn_to(first.d + first.d_by[0] * a + first.d_by[1] * b);
        return beam;
    }
    /// From the last leg, and from its foot of the perpendicular, to y.
    Vec3d miss(const Vec3d& y, double& t) const {
        const Vec3d from = y - last.o;
        t = dot(from, last.d);
        return from - last.d * t;
    }
};

SpecularChains::SpecularChains(const Scene& scene)
    : scene_(&scene), sources_(sources_without_extent(scene)) {
    double sum = 0;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
        if (!(scene.shapes[i].material->smooth_boundary_eta() > 1.f)) continue;
        boundaries_.push_back(i);
        area_.push_back(sum += scene.rays.area(i));
    }
    size_ = length(scene.rays.bounds().diagonal());
}

/// Follows the beam over the boundaries. With `random`, chance decides what happens at each, and
/// where the chain ends; without, it must do what `chain` says.
bool SpecularChains::trace(Beam& beam, Chain& chain, bool inside, Random* random,
                           RayCounts& counts) const {
    Differential ray = beam.first;
    Ray leg{Point3f(ray.o), Vec3f(ray.d)};
    for (int i = 0;; ++i) {
        if (i == (random ? most_vertices : chain.vertices)) break;
        ++counts.rays;
        const auto hit = scene_->rays.intersect(leg);
        if (!hit) return false;
        const float eta = scene_->shapes[hit->shape].material->smooth_boundary_eta();
        if (!(eta > 1.f)) return false;
        Vertex vertex;
        vertex.at = scene_->rays.surface_point(leg, *hit);
        vertex.chart = scene_->rays.chart(piece_at(scene_->rays, *hit, vertex.at), 0, 0);
        const bool from_outside = dot(vertex.chart.ng, ray.d) < 0;
        turn_against(vertex.chart, ray.d);
        vertex.eta = from_outside ? 1. / eta : eta;
        const double cosine = -dot(ray.d, vertex.chart.n);
        if (!(cosine > 0)) return false;
        vertex.reflectance = fresnel_dielectric(cosine, 1 / vertex.eta);
        const Vertex& before = chain.vertex[std::size_t(i)];
        if (random)
            vertex.reflects = vertex.reflectance >= 1 ||
                              random->next() < std::clamp(vertex.reflectance, least_chance, 1.);
        else if (before.at.shape != hit->shape)
            return false;
        else
            vertex.reflects = before.reflects;
        if (!pass(ray, vertex.chart, vertex.reflects, vertex.eta)) return false;
        // Where surface and interpolated normal disagree about the side, a path would end.
        if ((dot(ray.d, vertex.chart.ng) > 0) != vertex.reflects) return false;
        chain.vertex[std::size_t(i)] = vertex;
        if (random) {
            chain.vertices = i + 1;
            const bool within = from_outside != vertex.reflects;
            // One refraction alone is not a chain.
            const bool could_end = (within || !inside) && !(i == 0 && !vertex.reflects);
            if (could_end && random->next() < end_chance) {
                beam.last = ray;
                return true;
            }
        }
        const Vec3f d(ray.d);
        leg = {vertex.at.spawn(d), d};
    }
    beam.last = ray;
    return !random;
}

std::optional<SpecularChains::Chain> SpecularChains::attempt(const Point3f& point, bool inside,
                                                             Random& random,
                                                             RayCounts& counts) const {
    const SourceWithoutExtent& source = sources_[std::min(
        sources_.size() - 1, std::size_t(random.next() * float(sources_.size())))];
    const double target = random.next() * area_.back();
    const auto boundary =
        std::size_t(std::upper_bound(area_.begin(), area_.end() - 1, target) - area_.begin());
    const AreaSample start = scene_->rays.sample_area(boundaries_[boundary], random.next2());
    const Vec3d y(point);
    Beam beam = Beam::of(source.place, Vec3d(start.p), 2. * size_);
    Chain chain;
    chain.light = source.light;
    if (!trace(beam, chain, inside, &random, counts)) return std::nullopt;
    double t;
    Vec3d miss = beam.miss(y, t);
    for (int step = 0; step < most_steps; ++step) {
        if (length_squared(miss) < arrived * arrived * size_ * size_) {
            if (!(t > 0)) return std::nullopt;
            chain.gain = gain(chain, source, point);
            if (!std::isfinite(chain.gain)) return std::nullopt;
            return chain;
        }
        const Vec3d a = beam.last.o_by[0] + beam.last.d_by[0] * t,
                    b = beam.last.o_by[1] + beam.last.d_by[1] * t;
        const double volume = det(a, b, beam.last.d);
        if (volume == 0) return std::nullopt;
        double da = det(miss, b, beam.last.d) / volume, db = det(a, miss, beam.last.d) / volume;
        bool better = false;
        for (int half = 0; half < most_halvings && !better; ++half, da *= 0.5, db *= 0.5) {
            Beam next = beam.moved(source.place, da, db);
            Chain moved = chain;
            if (!trace(next, moved, inside, nullptr, counts)) continue;
            double next_t;
            const Vec3d next_miss = next.miss(y, next_t);
            if (!(length_squared(next_miss) < length_squared(miss))) continue;
            better = true;
            beam = next;
            chain = moved;
            miss = next_miss;
            t = next_t;
        }
        if (!better) return std::nullopt;
    }
    return std::nullopt;
}

double SpecularChains::gain(const Chain& chain, const SourceWithoutExtent& source,
                            const Point3f& point) const {
    // As a path from y sees it: directions follow the shading normals.
    const Vec3d y(point);
    const Vec3d towards = normalize(chain.vertex[std::size_t(chain.vertices - 1)].chart.p - y);
    const Frame<double> frame = Frame<double>::around(towards);
    Differential ray{y, towards};
    ray.d_by = {frame.s, frame.t};
    double factor = 1;
    for (int i = chain.vertices; i-- > 0;) {
        const Vertex& v = chain.vertex[std::size_t(i)];
        SurfaceChart chart = v.chart;
        if (!v.reflects) {
            // From the other side, to the index that the light comes from.
            turn_against(chart, v.chart.ng);
            factor *= (1 - v.reflectance) / (v.eta * v.eta);
        } else {
            factor *= v.reflectance;
        }
        if (!pass(ray, chart, v.reflects, 1 / v.eta)) return NAN;
    }
    std::array<Vec3d, 2> moved = ray.d_by;
    if (!source.place.distant) {
        const double distance = length(source.place.place - ray.o);
        for (std::size_t k = 0; k < 2; ++k) moved[k] += ray.o_by[k] * (1 / distance);
    }
    return factor / std::abs(det(moved[0], moved[1], ray.d));
}

bool SpecularChains::same(const Chain& a, const Chain& b) const {
    if (a.light != b.light || a.vertices != b.vertices) return false;
    for (std::size_t i = 0; i < std::size_t(a.vertices); ++i)
        if (a.vertex[i].reflects != b.vertex[i].reflects ||
            a.vertex[i].at.shape != b.vertex[i].at.shape)
            return false;
    return length(a.vertex[0].chart.p - b.vertex[0].chart.p) < same_place * size_;
}

std::optional<SpecularChains::Chain> SpecularChains::draw(const Point3f& y, bool inside,
                                                          Random& random, RayCounts& counts) const {
    std::optional<Chain> chain = attempt(y, inside, random, counts);
    if (!chain) return chain;
    int trials = 1;
    for (; trials < most_trials; ++trials)
        if (const auto again = attempt(y, inside, random, counts); again && same(*again, *chain))
            break;
    chain->weight = trials;
    return chain;
}

}  // namespace nacre
