#pragma once
// One path of the path tracer, from the camera or a surface to its end.
#include "nacre/render/path_tracer.h"

namespace nacre {

class SurfacePath {
  public:
    SurfacePath(const PathTracer& tracer, Sampler& sampler, const Wavelengths& wavelengths,
                RayCounts& counts)
        : tracer_(tracer),
          scene_(tracer.scene_),
          sampler_(sampler),
          wavelengths_(wavelengths),
          counts_(counts) {}

    /// The radiance along a ray.
    Spectral trace(const Ray& ray);
    /// The radiance that a material sends towards `wo`.
    Spectral trace_from(const SurfacePoint& at, const Material& material, const Vec3f& wo);

  private:
    template <class Path, class Follow>
    friend void split_at_first_boundary(Path&, float, float, Follow&&);

    // Follows the ray, and what becomes of it, to the end.
    void follow();
    // Each meets one thing and turns the ray to where the path goes on; false ends the path.
    bool at_surface(SurfacePoint& at);
    bool at_translucent(const SurfacePoint& at, const Translucency& below, const Vec3f& wo);
    bool at_rough(const SurfacePoint& at, const Translucency& below, const Material& rough,
                  const Vec3f& wo);
    // Goes below a translucent surface and on from where the light came in.
    bool enter(const SurfacePoint& at, const Translucency& below, const Vec3f& wo);
    bool scatter(const SurfacePoint& at, const Material& material, const Vec3f& wo);
    bool reflect(const SurfacePoint& at, const Vec3f& wo);

    void add_emission(const Light& light, const SurfacePoint* on_light);
    Spectral direct_light(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                          const Vec3f* above = nullptr);
    void leave(const SurfacePoint& at, const Vec3f& direction);
    bool within_depth(int more) const {
        const int max_depth = scene_.integrator.max_depth;
        return max_depth < 0 || depth_ + more < max_depth;
    }
    // Ends the segment: Russian roulette, one segment more.
    bool goes_on();

    const PathTracer& tracer_;
    const Scene& scene_;
    Sampler& sampler_;
    const Wavelengths& wavelengths_;
    RayCounts& counts_;

    Ray ray_;
    Spectral result_{0.f}, throughput_{1.f};
    float eta_ = 1.f;
    int depth_ = 0;
    bool single_wavelength_ = false;
    // Split off at the first boundary (first_boundary.h), and not yet put to the roulette.
    bool split_reflection_ = false;
    // How the ray got its direction: density of the last smooth choice, and the point it was made
    // at. After the camera and after mirrors, `specular_bounce_`, light samples had no part.
    bool specular_bounce_ = true;
    float pdf_ = 0.f;
    Point3f from_;
};

}  // namespace nacre
