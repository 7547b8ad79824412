#include "nacre/subsurface/diffusion_light.h"

#include <cmath>

#include "nacre/math/random.h"
#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel.h"
#include "nacre/subsurface/daylight.h"

namespace nacre {
namespace {

constexpr std::size_t cuts_at_a_time = 4096;

/// The boundary as a "reflector" of what it lets pass, T cos, that takes light from one strategy
/// only and remembers its direction: both weighted as if they were combined, so their sum is the
/// power that enters, and each is a ray of it.
class EntryProbe final : public Material {
  public:
    enum class Strategy { lights, chance };
    EntryProbe(const ObjectBoundary& boundary, Strategy strategy)
        : boundary_(boundary), strategy_(strategy) {}

    unsigned flags() const override { return reflects | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths&,
                   BsdfScratch& scratch) const override {
        return scratch.make<Lobe>(*this, point);
    }
    const Vec3f& direction() const { return direction_; }

  private:
    class Lobe final : public Bsdf {
      public:
        Lobe(const EntryProbe& probe, const SurfacePoint& at) : probe_(probe), at_(at) {}

        Spectral eval(const Vec3f& wi, const Vec3f&) const override {
            if (probe_.strategy_ != Strategy::lights) return Spectral(0.f);
            probe_.direction_ = wi;
            return Spectral(value(wi));
        }
        float pdf(const Vec3f& wi, const Vec3f&) const override {
            return wi.z > 0.f ? cosine_hemisphere_pdf(wi.z) : 0.f;
        }
        std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f u2) const override {
            if (probe_.strategy_ != Strategy::chance) return std::nullopt;
            BsdfSample s;
            s.wi = square_to_cosine_hemisphere(u2);
            s.pdf = pdf(s.wi, wo);
            const float f = value(s.wi);
            if (!(s.pdf > 0.f) || !(f > 0.f)) return std::nullopt;
            s.weight = Spectral(f / s.pdf);
            probe_.direction_ = s.wi;
            return s;
        }

      private:
        float value(const Vec3f& wi) const {
            return EntryLobe::is_outside(at_, wi) ? probe_.boundary_.transmittance(wi.z) * wi.z
                                                  : 0.f;
        }
        const EntryProbe& probe_;
        SurfacePoint at_;
    };

    const ObjectBoundary& boundary_;
    Strategy strategy_;
    mutable Vec3f direction_;
};

/// Power that arrives in a cell (`volume`) or at a cut (`surface`).
struct Deposit {
    std::uint32_t where;
    BandDoubles power;
};

class Walk {
  public:
    Walk(const EntryInput& in, const DiffusionMatter& matter, std::vector<Deposit>& deposits,
         BandDoubles& passed)
        : in_(in), matter_(matter), deposits_(deposits), passed_(passed) {}

    /// Light of that power goes straight on from `p` along the unit vector `d`, scattered and
    /// absorbed on its way, until the surface ends it.
    void go(const Point3f& p, const Vec3f& d, double end, BandDoubles power) {
        const GridFrame& f = in_.grid.frame();
        const Vec3d origin(p), direction(d);
        CellPlace at;
        Vec3d next, step;
        for (std::size_t a = 0; a < 3; ++a) {
            const double x = (origin[a] - f.origin[a]) / f.h;
            at[a] = std::int32_t(std::floor(x));
            const double up = direction[a] >= 0. ? 1. : 0.;
            const double slope = std::max(std::abs(direction[a]), 1e-12);
            step[a] = f.h / slope;
            next[a] = std::abs(double(at[a]) + up - x) * step[a];
        }
        std::uint32_t last = CellGrid::none;
        for (double s = 0.; s < end;) {
            const std::size_t a =
                next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
            const double until = std::min(end, next[a]);
            const std::uint32_t cell = in_.grid.at(at);
            // Slivers that are no cells count to the one before.
            if (cell != CellGrid::none) last = cell;
            if (last != CellGrid::none) power = pass(last, until - s, power);
            if (!(max_lane(power) > 1e-9 * start_)) return;
            s = until;
            next[a] += step[a];
            at[a] += direction[a] >= 0. ? 1 : -1;
        }
        passed_ += power;
    }
    void start(double power) { start_ = power; }

  private:
    BandDoubles pass(std::uint32_t cell, double length, BandDoubles power) {
        const BandDoubles sigma = BandDoubles(1. / 3.) / to_double(matter_.diffusion_at(cell));
        BandDoubles kept;
        for (int b = 0; b < BandDoubles::size; ++b) kept.set(b, std::exp(-sigma[b] * length));
        const BandDoubles scattered =
            BandDoubles(1.) - to_double(matter_.absorption_at(cell)) / sigma;
        deposits_.push_back({cell, power * (BandDoubles(1.) - kept) * scattered});
        return power * kept;
    }

    const EntryInput& in_;
    const DiffusionMatter& matter_;
    std::vector<Deposit>& deposits_;
    BandDoubles& passed_;
    double start_ = 0.;
};

/// A place of the surface near the middle of a cut, spread like the cut's own area.
std::optional<SurfacePoint> place_near(const EntryInput& in, const CutCell& cut, Vec2f u) {
    const double a = length(cut.area_vector);
    const Framef frame =
        Framef::around(a > 0. ? Vec3f(cut.area_vector * (1. / a)) : Vec3f(0.f, 0.f, 1.f));
    const double r = std::sqrt(double(u.x) * cut.area / std::numbers::pi),
                 phi = 2. * std::numbers::pi * double(u.y);
    const Vec3f offset = frame.to_world({float(r * std::cos(phi)), float(r * std::sin(phi)), 0.f});
    const auto hit = in.scene.rays.closest(Point3f(cut.centroid) + offset,
                                           float(4. * in.grid.frame().h), in.shape);
    if (!hit) return std::nullopt;
    return in.scene.rays.surface_point({}, *hit);
}

BandDoubles used_lanes(Spectral s, const Bands& bands, int g) {
    const int used = std::min(4, bands.count() - 4 * g);
    for (int i = used; i < 4; ++i) s.set(i, s[used - 1]);
    return to_double(s);
}

}  // namespace

EnteredLight entered_light(const EntryInput& in, const PathTracer& light,
                           const DiffusionMatter& matter, const Bands& bands, int g,
                           EntrySource source) {
    const CellGrid& grid = in.grid;
    const double h = grid.frame().h;
    const Wavelengths w = bands.group(g);
    EnteredLight result;
    const bool volume = source == EntrySource::volume;
    (volume ? result.power : result.flux)
        .assign(volume ? grid.size() : grid.cuts().size(), BandDoubles(0.));
    const std::size_t cuts = grid.cuts().size();
    WorkPhase phase(in.work, "light that enters", cuts);
    const Sampler prototype(Sampler::Kind::independent, in.seed + 2, 1);
    constexpr std::size_t parts = 64;
    struct Part {
        std::vector<Deposit> deposits;
        BandDoubles entered{0.}, passed{0.};
    };
    std::vector<Part> all(parts);
    const float eta = in.boundary.eta();
    const auto sample_cut = [&](std::size_t c, Part& part) {
        const CutCell& cut = grid.cuts()[c];
        // As many as the area says, the fraction by chance.
        Random random(stream_key(in.seed, 3, c, std::uint64_t(g)));
        const double wanted = in.samples * cut.area / (h * h);
        const double paths = std::max(1., std::floor(wanted + double(random.next2().x)));
        Walk walk(in, matter, part.deposits, part.passed);
        RayCounts counts;
        for (int i = 0; i < int(paths); ++i) {
            const auto at = place_near(in, cut, random.next2());
            if (!at) continue;
            for (const auto strategy :
                 {EntryProbe::Strategy::lights, EntryProbe::Strategy::chance}) {
                const EntryProbe probe(in.boundary, strategy);
                Sampler sampler = prototype;
                sampler.start(
                    (std::uint64_t(c) * 2 + std::uint64_t(strategy)) * 8 + std::uint64_t(g),
                    std::uint32_t(i));
                const Spectral flux =
                    light.reflected(*at, probe, {0.f, 0.f, 1.f}, sampler, w, counts);
                if (!(max_lane(flux) > 0.f) || !std::isfinite(sum(flux))) continue;
                const BandDoubles power =
                    used_lanes(flux / daylight(w), bands, g) * BandDoubles(cut.area / paths);
                part.entered += power;
                if (!volume) {
                    part.deposits.push_back({std::uint32_t(c), power});
                    continue;
                }
                const Vec3f inwards = at->shading.to_world(
                    eta == 1.f ? probe.direction() * -1.f
                               : refract(probe.direction(), {0.f, 0.f, 1.f}, eta));
                if (!(dot(inwards, at->ng) < 0.f)) continue;
                const Ray ray{at->spawn(inwards), inwards};
                const auto hit = in.scene.rays.intersect(ray);
                walk.start(double(max_lane(power)));
                walk.go(ray.o, inwards, hit ? double(hit->t) : 0., power);
            }
        }
        phase.advance();
    };
    for (std::size_t begin = 0; begin < cuts; begin += cuts_at_a_time) {
        const std::size_t end = std::min(cuts, begin + cuts_at_a_time);
        tbb::parallel_for(std::size_t(0), parts, [&](std::size_t p) {
            all[p] = {};
            const std::size_t n = end - begin;
            for (std::size_t c = begin + n * p / parts; c < begin + n * (p + 1) / parts; ++c)
                sample_cut(c, all[p]);
        });
        for (Part& part : all) {
            for (const Deposit& d : part.deposits)
                (volume ? result.power : result.flux)[d.where] += d.power;
            result.entered += part.entered;
            result.passed += part.passed;
        }
    }
    if (!volume)
        for (std::size_t c = 0; c < cuts; ++c)
            if (grid.cuts()[c].area > 0.) result.flux[c] *= BandDoubles(1. / grid.cuts()[c].area);
    return result;
}

}  // namespace nacre
