#include "nacre/layers/layer_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/math/frame.h"
#include "nacre/math/random.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/phase_henyey_greenstein.h"

namespace nacre {

namespace {

// Below this weight a walk goes on with the given chance only, and its weight is raised in turn:
// early enough to save most of the time, late enough to add no noise to speak of.
constexpr double roulette_weight = 1e-3, roulette_survival = 0.1;

double uniform(Random& random) { return static_cast<double>(random.next_bits() >> 11) * 0x1p-53; }

class Tally {
  public:
    void add(double x) {
        sum_ += x;
        sum_of_squares_ += x * x;
    }
    Estimate estimate(std::uint64_t photons) const {
        const double n = static_cast<double>(photons), mean = sum_ / n;
        const double variance = std::max(0., sum_of_squares_ / n - mean * mean);
        return {mean, std::sqrt(variance / (n - 1.))};
    }

  private:
    double sum_ = 0., sum_of_squares_ = 0.;
};

class BinTally {
  public:
    BinTally(std::size_t cosines, std::size_t azimuths)
        : cosines_(cosines), azimuths_(azimuths), bins_(cosines * azimuths) {}

    void add(const Vec3d& d, double weight) {
        const double turn = std::atan2(d.y, d.x) / (2. * std::numbers::pi);
        const auto index = [](double x, std::size_t n) {
            return std::min(n - 1, static_cast<std::size_t>(x * static_cast<double>(n)));
        };
        const std::size_t row = index(std::abs(d.z), cosines_);
        bins_[row * azimuths_ + index(turn < 0. ? turn + 1. : turn, azimuths_)].add(weight);
    }
    AngularBins result(std::uint64_t photons) const {
        AngularBins result{cosines_, azimuths_, {}};
        for (const Tally& bin : bins_) result.share.push_back(bin.estimate(photons));
        return result;
    }

  private:
    std::size_t cosines_, azimuths_;
    std::vector<Tally> bins_;
};

// Directions have z downwards, with the depth.
struct Photon {
    Vec3d direction;
    double weight = 1.;
    std::size_t layer = 0;
    double depth = 0.;  // below the top of the layer, mm
    bool scattered = false;
};

enum class Flight { ends_in_collision, leaves_above, leaves_below };

class Walk {
  public:
    explicit Walk(const LayerStack& stack) : stack_(stack) {}

    /// Carries the photon to its next collision or out of the stack.
    Flight fly(Photon& p, Random& random) const {
        double left = -std::log(1. - uniform(random));  // mean free paths
        for (;;) {
            const Layer& l = stack_.layers[p.layer];
            const bool down = p.direction.z > 0.;
            const double to_boundary = (down ? l.thickness - p.depth : p.depth);
            const double steepness = std::abs(p.direction.z), sigma_t = l.sigma_t();
            if (left * steepness < sigma_t * to_boundary) {
                p.depth += left / sigma_t * p.direction.z;
                return Flight::ends_in_collision;
            }
            if (std::isinf(to_boundary)) return Flight::leaves_below;  // a clear half space
            left -= sigma_t * to_boundary / steepness;
            p.depth = down ? l.thickness : 0.;
            if (reflects(p, down, random)) continue;
            if (down ? p.layer + 1 == stack_.layers.size() : p.layer == 0)
                return down ? Flight::leaves_below : Flight::leaves_above;
            p.layer += down ? 1 : -1;
            p.depth = down ? 0. : stack_.layers[p.layer].thickness;
        }
    }

    void scatter(Photon& p, Random& random) const {
        const Layer& l = stack_.layers[p.layer];
        const double c = HenyeyGreensteinPhase<double>{l.g}.sample_cos(uniform(random));
        const double s = std::sqrt(std::max(0., 1. - c * c));
        const double phi = 2. * std::numbers::pi * uniform(random);
        p.direction = normalize(
            Frame<double>::around(p.direction).to_world({s * std::cos(phi), s * std::sin(phi), c}));
        p.scattered = true;
    }

  private:
    /// Mirrors or refracts the direction at the boundary that the photon has reached.
    bool reflects(Photon& p, bool down, Random& random) const {
        const double near = stack_.layers[p.layer].eta;
        const bool last = down ? p.layer + 1 == stack_.layers.size() : p.layer == 0;
        const double far = !last  ? stack_.layers[down ? p.layer + 1 : p.layer - 1].eta
                           : down ? stack_.eta_below
                                  : stack_.eta_above;
        if (near == far) return false;
        Vec3d& d = p.direction;
        const double eta = far / near, cosine = std::abs(d.z);
        if (uniform(random) < fresnel_dielectric(cosine, eta)) {
            d.z = -d.z;
            return true;
        }
        d = {d.x / eta, d.y / eta, std::copysign(refracted_cosine(cosine, eta), d.z)};
        return false;
    }

    const LayerStack& stack_;
};

void check(const LayerStack& stack, const LayerWalkOptions& o) {
    nacre::check(stack);
    if (o.photons < 2)
        throw InputError(
            fmt::format("a walk needs at least 2 photons for a standard error; got {}", o.photons));
    if (!(o.cosine > 0. && o.cosine <= 1.))
        throw InputError(
            fmt::format("the cosine of incidence must lie within (0, 1]; got {:g}", o.cosine));
    if (o.cosine_bins < 1 || o.azimuth_bins < 1)
        throw InputError(
            fmt::format("there must be at least one bin of cosine and azimuth; got {} "
                        "and {}",
                        o.cosine_bins, o.azimuth_bins));
    const Layer& last = stack.layers.back();
    if (std::isinf(last.thickness) && last.sigma_s > 0. && last.sigma_a == 0.)
        throw InputError(fmt::format(
            "layer {}: without absorption, walks in an infinitely thick layer may never end; give "
            "it a finite thickness or some sigma_a",
            stack.layers.size()));
}

}  // namespace

double AngularBins::solid_angle() const {
    return 2. * std::numbers::pi / static_cast<double>(cosines * azimuths);
}

LayerTotals LayerWalkResult::totals() const {
    return {.reflectance = specular + reflectance.mean,
            .transmittance = transmittance.mean,
            .absorptance = absorptance.mean,
            .specular = specular,
            .unscattered = unscattered.mean};
}

LayerWalkResult layer_walk(const LayerStack& stack, const LayerWalkOptions& options) {
    check(stack, options);
    const Walk walk(stack);
    const double eta = stack.layers.front().eta / stack.eta_above;
    Tally specular, reflectance, transmittance, absorptance, unscattered;
    BinTally reflected(options.cosine_bins, options.azimuth_bins);
    BinTally transmitted = reflected;
    for (std::uint64_t i = 0; i < options.photons; ++i) {
        Random random(stream_key(options.seed, i));
        const double cosine = options.diffuse ? std::sqrt(1. - uniform(random)) : options.cosine;
        const double mirrored = eta == 1. ? 0. : fresnel_dielectric(cosine, eta);
        specular.add(mirrored);
        if (mirrored == 1.) continue;
        Photon p;
        // From azimuth 0 the light travels towards -x.
        const double inner = refracted_cosine(cosine, eta);
        p.direction = {-std::sqrt(1. - inner * inner), 0., inner};
        p.weight = 1. - mirrored;
        double absorbed = 0.;
        while (p.weight > 0.) {
            const Flight flight = walk.fly(p, random);
            if (flight != Flight::ends_in_collision) {
                const bool below = flight == Flight::leaves_below;
                (below ? transmittance : reflectance).add(p.weight);
                if (p.scattered)
                    (below ? transmitted : reflected).add(p.direction, p.weight);
                else if (below)
                    unscattered.add(p.weight);
                break;
            }
            const double albedo = stack.layers[p.layer].albedo();
            absorbed += p.weight * (1. - albedo);
            p.weight *= albedo;
            if (p.weight < roulette_weight)
                p.weight = uniform(random) < roulette_survival ? p.weight / roulette_survival : 0.;
            walk.scatter(p, random);
        }
        absorptance.add(absorbed);
    }
    const std::uint64_t n = options.photons;
    return {.specular = specular.estimate(n).mean,
            .reflectance = reflectance.estimate(n),
            .transmittance = transmittance.estimate(n),
            .absorptance = absorptance.estimate(n),
            .unscattered = unscattered.estimate(n),
            .reflected = reflected.result(n),
            .transmitted = transmitted.result(n)};
}

}  // namespace nacre
