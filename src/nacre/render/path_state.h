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
// A walk of n collisions and length l has density sigma_k^n exp(-sigma_k l), so nothing spectral
// needs doing at its steps.
#include <cmath>

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

/// Coefficients of a homogeneous medium at a path's wavelengths.
struct MediumLanes {
    Spectral sigma_t, albedo, log_ratio;  ///< log_ratio = log(sigma_t / sigma_t of the hero)
    float hero_sigma = 0.f;
    bool grey = false;  ///< the same extinction in all lanes

    MediumLanes(const MediumCoefficients& c, const Wavelengths& wavelengths, int hero)
        : sigma_t(c.sigma_t) {
        // An unused lane must not bring infinities into means; it follows its neighbour.
        if (wavelengths.mode == ColorMode::rgb_bands) sigma_t.set(3, sigma_t[2]);
        albedo = select(c.sigma_t > Spectral(0.f), c.sigma_s / max(c.sigma_t, Spectral(1e-30f)),
                        Spectral(0.f));
        hero_sigma = sigma_t[hero];
        grey = all(sigma_t == Spectral(hero_sigma));
        if (!grey)
            log_ratio =
                log(max(sigma_t, Spectral(1e-30f)) / Spectral(std::max(hero_sigma, 1e-30f)));
    }

    /// Extinction of the lane in which light gets farthest.
    float least_sigma() const { return min_lane(sigma_t); }
    /// exp(-sigma_t s)
    Spectral transmittance(float s) const {
        return grey ? Spectral(std::exp(-hero_sigma * s)) : exp(-sigma_t * Spectral(s));
    }
    /// Densities of n collisions over a length, relative to the largest lane.
    Spectral walk_density(std::uint32_t n, float length) const {
        if (grey) return Spectral(1.f);
        Spectral e = Spectral(static_cast<float>(n)) * log_ratio -
                     (sigma_t - Spectral(hero_sigma)) * Spectral(length);
        return exp(e - Spectral(max_lane(e)));
    }
    /// albedo^n
    Spectral survival(std::uint32_t n) const {
        Spectral base = albedo, result(1.f);
        for (; n; n >>= 1, base *= base)
            if (n & 1) result *= base;
        return result;
    }
};

}  // namespace nacre
