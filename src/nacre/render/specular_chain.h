#pragma once
// Ways of light without extent over several smooth boundaries to a point: caustics behind glass,
// and light that enters matter and is reflected inside before it is scattered.
//
// A trial throws a ray of the light at a random point of a smooth boundary, lets chance decide at
// each boundary whether it is refracted or reflected, and bends the chain by Newton's method until
// its last leg meets the point. Which solution is found depends on where the trial began; its
// probability, which the estimate is divided by, is found by repeating trials until the same
// solution comes again: their number is an unbiased estimate of the reciprocal (Zeltner, Georgiev,
// Jakob 2020, Specular Manifold Sampling for Rendering High-Frequency Caustics and Glints, sec.
// 4.3). Newton's method is that of Jakob, Marschner 2012 (Manifold Exploration), but over the two
// coordinates of the light's ray with ray differentials (Igehy 1999) instead of all vertices.
#include <array>
#include <optional>
#include <vector>

#include "nacre/math/random.h"
#include "nacre/render/integrator.h"
#include "nacre/render/refraction.h"

namespace nacre {

class SpecularChains {
  public:
    SpecularChains() = default;
    /// Of all lights of `scene` that are points or directions, over all smooth dielectric boundaries
    /// of relative index above 1.
    explicit SpecularChains(const Scene& scene);

    bool empty() const { return sources_.empty() || boundaries_.empty(); }

    static constexpr int most_vertices = 6;

    struct Vertex {
        SurfacePoint at;
        SurfaceChart chart;  ///< with its normals against the light's ray
        double eta = 1;      ///< of the side that the light comes from over the other
        double reflectance = 0;
        bool reflects = false;
    };
    struct Chain {
        const Light* light = nullptr;
        int vertices = 0;
        std::array<Vertex, most_vertices> vertex;  ///< from the light on
        /// Irradiance at the point, facing the last vertex, for an irradiance of 1 at the first,
        /// facing the light; Fresnel's factors included, matter between not.
        double gain = 0;
        /// Reciprocal of the probability with which the chain was drawn, an unbiased estimate.
        double weight = 0;
    };
    /// One of the chains to `y`, if a trial finds one: of more than one refraction, or a reflection.
    /// `inside`: y is in the matter of a boundary, else either.
    std::optional<Chain> draw(const Point3f& y, bool inside, Random& random,
                              RayCounts& counts) const;

  private:
    struct Beam;
    std::optional<Chain> attempt(const Point3f& y, bool inside, Random& random,
                                 RayCounts& counts) const;
    bool trace(Beam& beam, Chain& chain, bool inside, Random* random, RayCounts& counts) const;
    double gain(const Chain& chain, const SourceWithoutExtent& source, const Point3f& y) const;
    bool same(const Chain& a, const Chain& b) const;

    const Scene* scene_ = nullptr;
    std::vector<SourceWithoutExtent> sources_;
    std::vector<std::uint32_t> boundaries_;
    std::vector<double> area_;  // cumulative
    float size_ = 0.f;          // of the scene
};

}  // namespace nacre
