#pragma once
// What a camera ray sees first: one sample of the auxiliary images (auxiliary.h).
#include <optional>

#include "nacre/render/sampler.h"
#include "nacre/scene/scene.h"

namespace nacre {

struct FirstSight {
    Vec3f albedo, normal;
    std::optional<float> depth;  ///< none: the ray met no surface
};

/// Follows the ray, and what is mirrored and refracted, to the first surface that scatters.
class AuxiliaryPath {
  public:
    AuxiliaryPath(const Scene& scene, Sampler& sampler)
        : scene_(scene), sampler_(sampler), wavelengths_(Wavelengths::rgb_bands()) {}

    FirstSight trace(const Ray& ray);

  private:
    /// A ray on its way, and how much of the picture it stands for.
    struct Branch {
        Ray ray;
        const Medium* medium = nullptr;
        Spectral weight{1.f};
        float normal_weight = 1.f;
        Vec3f entrance{0.f, 0.f, 0.f};  ///< normal of the boundary through which the medium is seen
        int depth = 0;                  ///< mirrors and boundaries so far
    };
    void follow(Branch branch);
    // The medium between the branch and the next surface; false: nothing is seen through it.
    bool pass_medium(Branch& branch, float distance);
    bool pass_homogeneous(Branch& branch, float distance);
    bool pass_heterogeneous(Branch& branch, float distance);
    // The surface; false: it ends the branch.
    bool meet(Branch& branch, SurfacePoint at);
    bool see(Branch& branch, const SurfacePoint& at, const Material& material);
    bool split(Branch& branch, const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo);
    // A share of the branch shows a surface with this normal.
    void add_normal(const Branch& branch, float share, const Vec3f& normal);
    // Turns the branch into another direction.
    void leave(Branch& branch, const SurfacePoint& at, const Vec3f& local) const;

    const Scene& scene_;
    Sampler& sampler_;
    const Wavelengths wavelengths_;
    Spectral albedo_{0.f};
    Vec3f normal_{0.f, 0.f, 0.f};
    std::optional<float> depth_;
};

}  // namespace nacre
