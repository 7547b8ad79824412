#pragma once
// Integrators estimate the radiance that arrives along a camera ray.
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "nacre/math/work.h"
#include "nacre/render/sampler.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// Counts of what was traced, for benchmarks; each thread has its own.
struct RayCounts {
    std::uint64_t rays = 0;         ///< rays given to Embree, shadow rays included
    std::uint64_t scatterings = 0;  ///< real scattering events in media
    RayCounts& operator+=(const RayCounts& o) {
        rays += o.rays;
        scatterings += o.scatterings;
        return *this;
    }
};

/// What precomputation took and made: "two_pass points", 121787, "".
struct Statistic {
    std::string name;
    double value = 0.;
    std::string unit;
};
using Statistics = std::vector<Statistic>;

class Integrator {
  public:
    virtual ~Integrator() = default;
    /// One-sample estimate of the radiance along `ray` at the given wavelengths, already divided by
    /// nothing: the film divides by the wavelengths' density.
    virtual Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                              RayCounts& counts) const = 0;
    virtual Statistics statistics() const { return {}; }
};

/// The integrator named by scene.integrator. `scene` outlives it. Precomputation (distance grid)
/// happens here. Throws InputError for an unknown type, Stopped if `work` says so.
std::unique_ptr<Integrator> make_integrator(const Scene& scene, const Work& work = {});
/// One of another type than the scene names.
std::unique_ptr<Integrator> make_integrator(const Scene& scene, std::string_view type,
                                            const Work& work = {});

/// The types that make_integrator knows.
std::span<const std::string_view> integrator_types();

}  // namespace nacre
