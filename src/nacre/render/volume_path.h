#pragma once
// One path of the complete simulation, from the camera to its end.
#include <optional>

#include "nacre/render/path_state.h"
#include "nacre/render/shadow_ray.h"
#include "nacre/render/volume_path_tracer.h"
#include "nacre/render/volume_tracking.h"

namespace nacre {

class VolumePath {
  public:
    VolumePath(const VolumePathTracer& tracer, const Ray& ray, Sampler& sampler,
               const Wavelengths& wavelengths, RayCounts& counts);
    /// Follows the path to its end; the radiance that it found.
    Spectral trace();

  private:
    template <class Path, class Follow>
    friend void split_at_first_boundary(Path&, float, float, Follow&&);

    enum class Event { surface, escaped, collision, ended };

    // Moves the path through its medium to the next surface or collision.
    Event travel();
    Event travel_homogeneous();
    Event travel_heterogeneous();
    // Over a piece of a homogeneous medium without a collision.
    void pass(const MediumLanes& lanes, float length);
    // What happens at the places that `travel` leads to; false ends the path.
    bool at_surface();
    bool at_collision();
    // Goes on from a rough boundary, seen first and from outside, both ways that one facet sends
    // light.
    bool split_at_rough_boundary(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                                 float eta, Vec2f u);
    // Goes on from a surface in the direction of `sample`.
    bool follow(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                const BsdfSample& sample);

    void add_emission(const Light& light, const SurfacePoint* on_light);
    // Next-event estimation at a surface (`at` and `bsdf` set) or a collision (null), with the
    // density of the path's own choice of that direction; see `connection` for the shadow ray.
    void connect_to_light(const SurfacePoint* at, const Bsdf* bsdf, const Vec3f& wo);
    // What is left of the light that comes to a shadow ray's origin, and the density of the path's
    // own way to the light, both per lane. `medium` is that at the origin.
    struct Connection {
        Spectral kept{0.f}, density{0.f};
    };
    struct WayToLight;
    Connection connection(const ShadowRay& shadow, const Medium* medium, Random& random);
    // A collision at `p` of a path that came along `d`. The walk's own collisions since the path's
    // weights were brought up to date are told apart; lanes are null in heterogeneous media.
    struct Collision {
        Point3f p;
        Vec3f d;
        const MediumLanes* lanes = nullptr;
        std::uint32_t collisions = 0;
        float length = 0.f;
    };
    // What a chord from it to the boundary carries, per lane: the path's weights at the collision,
    // what the chord keeps of light, and the density of passing it.
    struct Carried {
        Spectral throughput, density, kept, passing;
    };
    Carried carried(const Collision& from, const Ray& chord, float length, Random& random);
    struct WalkSurroundings;
    // Called at collisions: proposes an exit towards a light, and takes it if chance says so.
    void guided_exit(const Collision& from, std::int32_t cell, Random& random);
    // Where its direction leads to: out through a smooth boundary to what is met there, or to
    // a rough one, where a light is drawn. `guided` is the density of proposing the chord.
    void exit_smoothly(const Collision& from, const Ray& chord, float length,
                       const SurfacePoint& at, float guided, Random& random);
    void exit_roughly(const Collision& from, const Ray& chord, float length, const SurfacePoint& at,
                      float guided, Random& random);
    // The density of a proposal at the last collision in the direction that the walk took.
    float guided_density() const;
    // With what density a proposal at the last collision would have led to the rough boundary
    // `at`, to which the walk came by itself.
    Spectral guided_arrival(const SurfacePoint& at, const Vec3f& wo) const;
    // Called when the path leaves through the boundary by itself: notes with what density a
    // proposal would have done so.
    void expect_guided_exit(const SurfacePoint& at, float transmittance);
    // At a collision of a heterogeneous medium: what the walk does by itself in homogeneous ones.
    void meet_lights_through_boundary();
    // Connect a vertex to lights that cannot be met, through one smooth boundary (light_beams.h).
    // `weight`: what the path carries there, lanes weighted. Ways longer than a reach drawn for the
    // collision are left out: the chance that a way is kept falls with its length as its light
    // does, so that most collisions, which are deep, cost nothing.
    struct Reach {
        float length = 1e30f, sigma = 0.f;
        float chance(float way) const;  // that a way of this length is kept
    };
    static Reach draw_reach(const MediumLanes& lanes, Random& random);
    void connect_surface_through_boundary(const SurfacePoint& at, const Bsdf& bsdf,
                                          const Vec3f& wo);
    void connect_collision_through_boundary(const Point3f& p, const Vec3f& d_in,
                                            const Spectral& weight, const Reach& reach,
                                            Random& random);
    void connect_collision_by_chain(const Point3f& p, const Vec3f& d_in, const Spectral& weight,
                                    const Reach& reach, Random& random);
    // What comes to the start of such a way, with what lies on it.
    Spectral arriving(const LightBeams::Way& way, const Point3f& origin, const Medium* medium,
                      Random& random);
    // The same over several boundaries (specular_chain.h).
    Spectral arriving(const SpecularChains::Chain& chain, const Point3f& origin,
                      const Medium* medium, Random& random);

    MediumLanes lanes_of(const Medium& medium, const Point3f& p) const {
        return {medium.coefficients(p, wavelengths_), wavelengths_, hero_,
                tracer_.info(&medium).size};
    }
    bool within_depth(int more) const { return max_depth_ < 0 || depth_ + more < max_depth_; }
    // What the path carries, as the roulette weighs it.
    float relative_weight() const;
    float mean_of(const Spectral& s) const { return mean(s, wavelengths_); }
    // Of the lights that a collision of this piece is connected to.
    const LightChooser& reachable() const {
        return piece_->reachable ? *piece_->reachable : tracer_.lights_;
    }
    void leave(const SurfacePoint& at, const Vec3f& direction);

    const VolumePathTracer& tracer_;
    const Scene& scene_;
    Sampler& sampler_;
    const Wavelengths& wavelengths_;
    RayCounts& counts_;
    const int max_depth_;
    int hero_;

    std::vector<LightBeams::Way> ways_;  // kept for their memory
    std::vector<std::uint32_t> boxes_;

    Ray ray_;
    const Medium* medium_;
    const VolumePathTracer::Piece* piece_;  // of the medium; of no meaning without one
    std::optional<Hit> hit_;
    Spectral result_{0.f}, throughput_{1.f}, density_{1.f};
    int depth_ = 0;
    float eta_ = 1.f;
    bool single_wavelength_ = false;
    // Split off at the first boundary (first_boundary.h), and not yet put to the roulette.
    bool split_reflection_ = false;

    // The other strategy of multiple importance sampling that could have made the present segment;
    // after cameras and mirrors there is none. Its density is that of the path up to the last
    // vertex, for guided exits times that of the guide.
    enum class Strategy { none, light_sampling, guided_exit } other_strategy_ = Strategy::none;
    Spectral other_density_{0.f};
    Point3f vertex_;  // where the present direction was chosen
    float vertex_pdf_ = 0.f;
    const LightChooser* vertex_lights_ = nullptr;  // from which one was drawn there

    // Density of guided connections to lights at the present surface (guided_arrival).
    Spectral guided_{0.f};

    // The last collision before a surface, without another event, for the density of a guided exit.
    struct LastCollision {
        bool valid = false;
        Point3f p;
        Vec3f d_in;
        Spectral density;
    } last_collision_;
};

}  // namespace nacre
