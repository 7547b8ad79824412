#pragma once
// One path of the complete simulation, from the camera to its end.
#include <optional>

#include "nacre/render/path_state.h"
#include "nacre/render/volume_path_tracer.h"

namespace nacre {

struct Walker;

class VolumePath {
  public:
    VolumePath(const VolumePathTracer& tracer, const Ray& ray, Sampler& sampler,
               const Wavelengths& wavelengths, RayCounts& counts);
    /// Follows the path to its end; the radiance that it found.
    Spectral trace();

  private:
    enum class Event { surface, escaped, collision, ended };

    // Moves the path through its medium to the next surface or collision.
    Event travel();
    Event travel_homogeneous();
    Event travel_heterogeneous();
    // What happens at the places that `travel` leads to; false ends the path.
    bool at_surface();
    bool at_collision();
    // Goes on from a surface in the direction of `sample`.
    bool follow(const SurfacePoint& at, const Material& material, const Vec3f& wo,
                const MaterialSample& sample);

    void add_emission(const Light& light, const SurfacePoint* on_light);
    // Next-event estimation at a surface (material set) or a collision (null), with the density of
    // the path's own choice of that direction; see `connect` for the shadow ray.
    void connect_to_light(const SurfacePoint* at, const Material* material, const Vec3f& wo);
    // Light that gets from p along direction over a distance: per lane kept, and density of the
    // path's own way there.
    struct Connection {
        Spectral kept, density;
    };
    Connection connection(Point3f p, const Vec3f& direction, float distance, const Medium* medium);
    // Called by the walk: proposes an exit towards a light at a collision.
    struct WalkSurroundings;
    void guided_exit(const ExitGuide::Proposal& proposal, const Walker& walker,
                     const MediumLanes& lanes, Random& random);
    // Called when the path leaves through the boundary by itself: notes with what density a
    // proposal would have done so.
    void expect_guided_exit(float transmittance);

    bool within_depth(int more) const { return max_depth_ < 0 || depth_ + more < max_depth_; }
    // What the path carries, relative to its start: the largest lane, factors of refraction taken
    // out.
    float relative_weight() const;
    // Survives with the probability of its relative weight, but at most `most`.
    bool roulette(float u, float most);
    float mean_of(const Spectral& s) const { return mean(s, wavelengths_); }
    void leave(const SurfacePoint& at, const Vec3f& direction);

    const VolumePathTracer& tracer_;
    const Scene& scene_;
    Sampler& sampler_;
    const Wavelengths& wavelengths_;
    RayCounts& counts_;
    const int max_depth_;
    int hero_;

    Ray ray_;
    const Medium* medium_;
    std::optional<Hit> hit_;
    Spectral result_{0.f}, throughput_{1.f}, density_{1.f};
    int depth_ = 0;
    float eta_ = 1.f;
    bool single_wavelength_ = false;
    bool faint_ = false;  // a reflection split off at the first surface, not yet put to roulette

    // The other strategy that could have made the present segment: none after cameras and mirrors.
    enum class Partner { none, light_sampling, guided_exit } partner_ = Partner::none;
    Spectral partner_density_{
        0.f};  // of the path up to the last vertex; times the guide's density for guided exits
    Point3f vertex_;  // where the present direction was chosen
    float vertex_pdf_ = 0.f;

    // The last collision of a walk that reached a surface without another event, for the density of
    // a guided exit.
    struct LastCollision {
        bool valid = false;
        Point3f p;
        Vec3f d_in;
        Spectral density;
    } last_collision_;
};

}  // namespace nacre
