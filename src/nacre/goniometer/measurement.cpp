#include "nacre/goniometer/measurement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/math/random.h"

namespace nacre {

IncidenceMeasurement::IncidenceMeasurement(const DirectionCell& cell, const HemisphereBins& b)
    : incidence(cell), bins(b), of_bin(2 * b.size()) {}

MeasuredValue IncidenceMeasurement::share(const Sums& sums, int lane) const {
    if (rays == 0) return {};
    const double n = double(rays), mean = sums.sum[lane] / n;
    const double variance = std::max(0., sums.square[lane] / n - mean * mean);
    return {mean, std::sqrt(variance / std::max(1., n - 1.))};
}

MeasuredValue IncidenceMeasurement::density(std::size_t i, int lane) const {
    const MeasuredValue m = share(of_bin[i], lane);
    const double cosine = bins.cell(i % bins.size()).projected_solid_angle();
    return {m.value / cosine, m.error / cosine};
}

double IncidenceMeasurement::noise(const Wavelengths& wavelengths) const {
    double worst = 0.;
    for (int lane = 0; lane < 4; ++lane) {
        if (wavelengths.weight[lane] == 0.f) continue;
        double errors = 0.;
        for (const Sums& s : of_bin) errors += share(s, lane).error;
        const double all = reflected(lane).value + transmitted(lane).value;
        if (all > 0.) worst = std::max(worst, errors / all);
    }
    return worst;
}

namespace {

constexpr int most_reflections = 10'000;
constexpr std::uint64_t block_rays = 4096;

/// What became of one ray.
struct Arrival {
    enum class Where : std::uint8_t { nowhere, above, below, cut, gone } where = Where::nowhere;
    std::uint32_t bin = 0;
    Spectral weight{0.f};
};

class Tracer {
  public:
    Tracer(const Patch& patch, const MeasureOptions& options, const DirectionCell& incidence)
        : patch_(patch), options_(options), incidence_(incidence) {}

    Arrival trace(Random random) const {
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
        for (int reflections = 0; reflections < most_reflections;) {
            const Flight flight = fly(patch_, o, d);
            if (flight.fate == Fate::lost) break;
            if (flight.fate != Fate::meets) {
                const bool above = flight.fate == Fate::leaves_above;
                const std::size_t bin = options_.bins.index(turned(Vec3d(d), turn));
                return {above ? Arrival::Where::above : Arrival::Where::below, std::uint32_t(bin),
                        weight};
            }
            scratch.reset();
            const std::optional<BsdfSample> s = scatter(flight.at, d, random, scratch);
            if (!s) return {};
            if (!s->null) {
                if (options_.orders > 0 && reflections == options_.orders)
                    return {Arrival::Where::cut, 0, weight};
                ++reflections;
                weight *= s->weight;
            }
            d = s->wi;
            o = flight.at.spawn(d);
            if (reflections > 8) {  // Russian roulette
                const float most = std::min(1.f, max_lane(weight));
                if (!(random.next() < most)) return {};
                weight *= Spectral(1.f / most);
            }
        }
        return {Arrival::Where::gone, 0, weight};
    }

  private:
    static Vec3d turned(const Vec3d& w, double angle) {
        if (angle == 0.) return w;
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
    }

    /// The next direction, in world coordinates, with the weight of light that goes that way. The
    /// BSDF draws where light could come from; here light goes there, so the roles are exchanged.
    std::optional<BsdfSample> scatter(const SurfacePoint& at, const Vec3f& d, Random& random,
                                      BsdfScratch& scratch) const {
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
                s->weight =
                    bsdf.eval(in, out) * Spectral(std::abs(out.z) / (std::abs(in.z) * s->pdf));
        }
        if (!all(s->weight >= Spectral(0.f)) || !(max_lane(s->weight) < 1e30f))
            throw RunError("the material of the patch gives light that is no number");
        s->wi = normalize(world);
        return s;
    }

    const Patch& patch_;
    const MeasureOptions& options_;
    const DirectionCell& incidence_;
};

void check(const MeasureOptions& o, const DirectionCell& c) {
    if (o.bins.polar < 1 || o.bins.around < 1 || o.bins.size() > 1'000'000)
        throw InputError(fmt::format("{} by {} bins: from 1 to a million of them are possible",
                                     o.bins.polar, o.bins.around));
    if (!(o.noise >= 0.)) throw InputError("noise must not be negative");
    if (o.orders < 0) throw InputError("orders must not be negative");
    if (!(c.theta_low >= 0. && c.theta_high >= c.theta_low &&
          c.theta_high <= 0.5 * std::numbers::pi && c.theta() < 0.5 * std::numbers::pi))
        throw InputError(
            fmt::format("light from {:.6g} degrees does not meet the surface from above",
                        c.theta() * 180. / std::numbers::pi));
}

void add(IncidenceMeasurement& m, const Arrival& a) {
    switch (a.where) {
        case Arrival::Where::nowhere:
            return;
        case Arrival::Where::above:
            m.above.add(a.weight);
            m.of_bin[a.bin].add(a.weight);
            return;
        case Arrival::Where::below:
            m.below.add(a.weight);
            m.of_bin[m.bins.size() + a.bin].add(a.weight);
            return;
        case Arrival::Where::cut:
            m.cut.add(a.weight);
            return;
        case Arrival::Where::gone:
            m.gone.add(a.weight);
            return;
    }
}

}  // namespace

void measure(const Patch& patch, const MeasureOptions& options, IncidenceMeasurement& m,
             const Work& work, const std::function<void(const MeasureProgress&)>& progress) {
    check(options, m.incidence);
    const Tracer tracer(patch, options, m.incidence);
    // Rays come in blocks with random numbers of their own, which are added in their order.
    constexpr std::uint64_t at_once = 64;
    std::vector<std::vector<Arrival>> blocks(at_once);
    std::uint64_t aim = std::max<std::uint64_t>(options.least_rays, 1);
    while (m.rays < options.most_rays) {
        if (m.rays >= aim) {
            const double noise = m.noise(options.wavelengths);
            if (progress) progress({0, 1, m.rays, noise});
            if (noise <= options.noise) return;
            aim = 2 * m.rays;
        }
        const std::uint64_t first = m.rays / block_rays;
        const std::uint64_t wanted = std::min(aim, options.most_rays) - m.rays;
        const std::uint64_t count =
            std::clamp<std::uint64_t>((wanted + block_rays - 1) / block_rays, 1, at_once);
        tbb::parallel_for(std::uint64_t(0), count, [&](std::uint64_t b) {
            std::vector<Arrival>& arrivals = blocks[b];
            arrivals.clear();
            for (std::uint64_t i = 0; i < block_rays; ++i) {
                if (i % 256 == 0 && work.stopped()) return;
                arrivals.push_back(
                    tracer.trace(Random(stream_key(options.seed, first + b, i, 0x676f6e69))));
            }
        });
        for (std::uint64_t b = 0; b < count; ++b) {
            if (blocks[b].size() < block_rays) return;  // stopped: whole blocks only
            for (const Arrival& a : blocks[b]) add(m, a);
            m.rays += block_rays;
        }
        work.tell("measuring", double(m.rays) / double(aim));
    }
}

}  // namespace nacre
