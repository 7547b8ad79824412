#include "nacre/goniometer/patch_tracer.h"

#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

// In clear geometry light that takes longer runs in circles; in a bright medium it may take long.
constexpr int most_reflections = 10'000, most_collisions = 1'000'000;

Vec3d turned(const Vec3d& w, double angle) {
    if (angle == 0.) return w;
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
}

Spectral decay(const Spectral& sigma, double length) {
    Spectral r;
    for (int k = 0; k < 4; ++k) r.set(k, std::exp(-sigma[k] * float(length)));
    return r;
}

}  // namespace

Arrival PatchTracer::trace(Random random) const {
    double turn = 0.;
    if (options_.turned) turn = 2. * std::numbers::pi * double(random.next());
    const Vec2f u = random.next2(), v = random.next2();
    Vec3f d(turned(incidence_.draw(u.x, u.y), -turn));
    d = -d;
    // Uniform over the tile at the top is uniform over the projected area of what is below.
    Point3f o{float(patch_.x + patch_.width * v.x), float(patch_.y + patch_.height * v.y),
              float(patch_.top)};
    Spectral weight(1.f);
    BsdfScratch scratch;
    int medium = -1;  // that the ray is in
    const int most = patch_.media.empty() ? most_reflections : most_collisions;
    for (int events = 0; events < most;) {
        const Flight flight =
            medium < 0 ? fly(patch_, o, d)
                       : fly_within(patch_.media[std::size_t(medium)], o, d, weight, random);
        if (flight.fate == Fate::lost) break;
        if (flight.fate == Fate::leaves_above || flight.fate == Fate::leaves_below) {
            const bool above = flight.fate == Fate::leaves_above;
            const std::size_t bin = options_.bins.index(turned(Vec3d(d), turn));
            return {above ? Arrival::Where::above : Arrival::Where::below, std::uint32_t(bin),
                    weight};
        }
        const auto is_cut = [&] { return options_.orders > 0 && events == options_.orders; };
        if (flight.fate == Fate::ends) {  // a collision
            if (is_cut()) return {Arrival::Where::cut, 0, weight};
            ++events;
            d = patch_.media[std::size_t(medium)].phase.sample(d, random.next2());
            o = flight.end;
        } else {
            scratch.reset();
            const std::optional<BsdfSample> s = scatter(flight.at, d, random, scratch);
            if (!s) return {};
            if (!s->null) {
                if (is_cut()) return {Arrival::Where::cut, 0, weight};
                ++events;
                weight *= s->weight;
            }
            d = s->wi;
            o = flight.at.spawn(d);
            if (!patch_.sides.empty() && patch_.sides[flight.at.shape].differ) {
                const PatchSides& sides = patch_.sides[flight.at.shape];
                medium = dot(d, flight.at.ng) > 0.f ? sides.outside : sides.inside;
            }
        }
        if (events > 8) {  // Russian roulette
            const float most_left = std::min(1.f, max_lane(weight));
            if (!(random.next() < most_left)) return {};
            weight *= Spectral(1.f / most_left);
        }
    }
    return {Arrival::Where::gone, 0, weight};
}

Flight PatchTracer::fly_within(const PatchMedium& medium, const Point3f& o, const Vec3f& d,
                               Spectral& weight, Random& random) const {
    const auto no_end = [&] {
        return InputError(
            fmt::format("light leaves the patch within the medium of '{}': close its shape, so "
                        "that the medium ends at a surface",
                        medium.name));
    };
    if (!(max_lane(medium.sigma_s) > 0.f)) {
        const Flight flight = fly(patch_, o, d);
        if (flight.fate == Fate::leaves_above || flight.fate == Fate::leaves_below) throw no_end();
        weight *= decay(medium.sigma_t, flight.length);
        return flight;
    }
    // The free path is drawn for one of the lanes, each as likely as its share of the light; what
    // any of them could have drawn counts. So the sum of the lanes' weights never grows.
    Spectral share;
    float sum = 0.f;
    for (int k = 0; k < 4; ++k) {
        share.set(k, options_.wavelengths.weight[k] > 0.f ? weight[k] : 0.f);
        sum += share[k];
    }
    if (!(sum > 0.f)) return {Fate::lost, {}, 0., {}};
    share *= Spectral(1.f / sum);
    const float choice = random.next();
    int lane = 0;
    float below = 0.f;
    for (int k = 0; k < 4; ++k) {
        if (share[k] > 0.f && choice >= below) lane = k;
        below += share[k];
    }
    const float sigma = medium.sigma_t[lane];
    const double path = sigma > 0.f ? -std::log(1. - double(random.next())) / double(sigma) : 1e30;
    const Flight flight = fly(patch_, o, d, path);
    if (flight.fate == Fate::leaves_above || flight.fate == Fate::leaves_below) throw no_end();
    const Spectral left = decay(medium.sigma_t, flight.length);
    const bool collides = flight.fate == Fate::ends;
    const Spectral density = collides ? medium.sigma_t * left : left;
    float all = 0.f;
    for (int k = 0; k < 4; ++k) all += share[k] * density[k];
    weight *= (collides ? medium.sigma_s * left : left) * Spectral(1.f / all);
    return flight;
}

// The BSDF draws where light could come from; here light goes there, so the roles are exchanged.
std::optional<BsdfSample> PatchTracer::scatter(const SurfacePoint& at, const Vec3f& d,
                                               Random& random, BsdfScratch& scratch) const {
    const Bsdf& bsdf = patch_.bsdf(at, options_.wavelengths, scratch);
    const Vec3f in = at.shading.to_local(-d);
    const float u1 = random.next();
    std::optional<BsdfSample> s = bsdf.sample(in, u1, random.next2());
    if (!s) return {};
    const Vec3f out = s->wi, world = at.shading.to_world(out);
    if (!s->null) {
        // Interpolated normals may see a direction that the surface does not.
        if ((dot(world, at.ng) > 0.f) != (out.z > 0.f) || (dot(d, at.ng) < 0.f) != (in.z > 0.f))
            return {};
        if (s->delta)
            s->weight *= Spectral(s->eta * s->eta);
        else
            s->weight = bsdf.eval(in, out) * Spectral(std::abs(out.z) / (std::abs(in.z) * s->pdf));
    }
    if (!all(s->weight >= Spectral(0.f)) || !(max_lane(s->weight) < 1e30f))
        throw RunError("the material of the patch gives light that is no number");
    s->wi = normalize(world);
    return s;
}

}  // namespace nacre
