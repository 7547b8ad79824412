#pragma once
// The book-keeping of a path that carries four wavelengths at once.
//
// A path is drawn with the probabilities of one lane, the hero, but could have been drawn with
// those of any: the one-sample balance heuristic over the lanes (Wilkie et al. 2014; Miller,
// Georgiev, Jarosz 2019) weights it. Kept are, for lane k,
//
//   throughput_k   integrand over the lane's own density: what an analogue path of it would carry
//   density_k      density of the path under lane k, up to a factor that is common to all
//
// so that emitted radiance L contributes
//
//   throughput_k density_k L_k / mean(density + other)
//
// where `other` is the density with which the other strategy that ends at lights (next-event
// estimation at the last vertex, or a guided exit) could have made the same path.
// With a chance c_k (tracking_chance) a path draws a free path by the extinction; else it passes to
// the next surface whatever the distance, so that light which comes straight through an absorber is
// not cut short but weakened. Over a walk of n collisions and length l, and over a piece of length s
// that is passed,
//
//   integrand     sigma_s,k^n exp(-sigma_t,k l)         exp(-sigma_t,k s)
//   density_k     (c_k sigma_t,k)^n exp(-sigma_t,k l)   passing_k = 1 - c_k + c_k exp(-sigma_t,k s)
//   throughput_k  (albedo_k / c_k)^n                    exp(-sigma_t,k s) / passing_k
//
// so nothing spectral needs doing at its steps. What is left of light falls by exp(-sigma_t,k s),
// the density of the path's own way by passing_k: every formula that combines densities goes by the
// latter.
#include <cmath>
#include <optional>

#include "nacre/math/lanes_math.h"
#include "nacre/render/sampler.h"
#include "nacre/scene/medium.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// The lane whose probabilities make the decisions of a path. In spectral mode the wavelengths are
/// rotated at random, so any lane will do; among fixed bands it must be drawn.
inline int draw_hero(const Wavelengths& wavelengths, const Sampler& sampler) {
    if (wavelengths.mode == ColorMode::spectral) return 0;
    // Successive samples of a pixel take turns; the pixel's key makes the order its own.
    return static_cast<int>((sampler.sample_index() + sampler.pixel_key()) % 3u);
}

/// The chance of drawing a free path in a lane, in matter of some optical thickness. Of 1, scattered
/// light is sampled as its density is; of 0, light that comes straight through has no noise. Were
/// the two as bright as their shares, sqrt(albedo) would weigh both alike; the factors leave walks as
/// they are where scattering prevails or next to nothing comes through (docs/benchmarks.md).
inline Spectral tracking_chance(const Spectral& albedo, const Spectral& thickness) {
    const Spectral through = exp(Spectral(-0.25f) * thickness);
    return sqrt(min(Spectral(1.f), albedo * Spectral(2.f) / max(through, Spectral(1e-6f))));
}

/// Coefficients of a homogeneous medium at a path's wavelengths.
struct MediumLanes {
    Spectral sigma_t;
    Spectral chance{1.f};  ///< of drawing a free path
    Spectral albedo;       ///< over `chance`: what a collision leaves
    Spectral log_ratio;    ///< log of density_k over density of the hero, for a collision
    float hero_sigma = 0.f, hero_chance = 1.f;
    bool grey = false;   ///< the same extinction in all lanes
    bool alike = false;  ///< and the same chance
    bool always = true;  ///< chance is 1 in all lanes

    /// Free paths are drawn with `tracking_chance` if `size`, the smallest extent of the matter, is
    /// given (0 where it is not known), else always.
    MediumLanes(const MediumCoefficients& c, const Wavelengths& wavelengths, int hero,
                std::optional<float> size = {})
        : sigma_t(c.sigma_t) {
        albedo = select(c.sigma_t > Spectral(0.f), c.sigma_s / max(c.sigma_t, Spectral(1e-30f)),
                        Spectral(0.f));
        if (size && any(albedo < Spectral(0.5f)))
            chance = select(c.sigma_t > Spectral(0.f),
                            tracking_chance(albedo, c.sigma_t * Spectral(*size)), chance);
        // An unused lane must not bring infinities into means; it follows its neighbour.
        if (wavelengths.mode == ColorMode::rgb_bands) {
            sigma_t.set(3, sigma_t[2]);
            chance.set(3, chance[2]);
        }
        always = all(chance == Spectral(1.f));
        if (!always)
            albedo = select(chance > Spectral(0.f), albedo / max(chance, Spectral(1e-30f)),
                            Spectral(0.f));
        hero_sigma = sigma_t[hero];
        hero_chance = chance[hero];
        grey = all(sigma_t == Spectral(hero_sigma));
        alike = grey && all(chance == Spectral(hero_chance));
        if (!alike)
            log_ratio = log(max(chance * sigma_t, Spectral(1e-30f)) /
                            Spectral(std::max(hero_chance * hero_sigma, 1e-30f)));
    }

    /// So many collisions that leave a hundredth of the light, or `most` if that is less.
    std::uint32_t chunk(std::uint32_t most) const {
        if (always) return most;
        const float n = -4.6f / std::log(std::clamp(max_lane(albedo * chance), 1e-4f, 0.9999f));
        return n < static_cast<float>(most) ? 1 + static_cast<std::uint32_t>(n) : most;
    }
    /// Extinction of the lane in which light gets farthest.
    float least_sigma() const { return min_lane(sigma_t); }
    /// exp(-sigma_t s): what is left of light.
    Spectral transmittance(float s) const {
        return grey ? Spectral(std::exp(-hero_sigma * s)) : exp(-sigma_t * Spectral(s));
    }
    /// Density of passing without a collision, where `transmittance` is left.
    Spectral passing(const Spectral& transmittance) const {
        return always ? transmittance : Spectral(1.f) - chance + chance * transmittance;
    }
    /// Densities of n collisions over a length, relative to the largest lane.
    Spectral walk_density(std::uint32_t n, float length) const {
        if (alike) return Spectral(1.f);
        Spectral e = Spectral(static_cast<float>(n)) * log_ratio -
                     (sigma_t - Spectral(hero_sigma)) * Spectral(length);
        return exp(e - Spectral(max_lane(e)));
    }
    /// What n collisions leave of the throughput: (albedo / chance)^n
    Spectral survival(std::uint32_t n) const {
        Spectral base = albedo, result(1.f);
        for (; n; n >>= 1, base *= base)
            if (n & 1) result *= base;
        return result;
    }
};

}  // namespace nacre
