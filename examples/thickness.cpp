// "thickness": light that comes straight through, by how thick the object is there.
//
//   S. Green 2004, Real-Time Approximations to Subsurface Scattering, GPU Gems, chapter 16.
//
// A share of the light that leaves at a point came in at the point behind it, along the normal, and
// was weakened on its way by e^(-thickness / length); the rest came in where it leaves. Green looks
// the thickness up in a map seen from the light; here a ray finds it.
#include <cmath>

#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

/// The technique's own parameters.
struct Options {
    double share = 0.5;  ///< of the light that comes through
    double length = 1.;  ///< in transport mean free paths
};

class Thickness final : public Translucency {
  public:
    Thickness(const ShapeInput& in, const Options& options)
        : Translucency(in.boundary),
          scene_(in.scene),
          shape_(in.shape),
          bands_(in.scene.mode),
          share_(float(options.share)),
          total_(profile_tables(in)),
          exit_scale_(exit_scale(in)) {
        for (const ProfileMedium& m : medium_in_bands(in.medium(), in.eta(), bands_))
            per_length_.push_back(float(m.sigma_t_prime() / options.length));
    }

    Emergence emerge(const SurfacePoint& exit, const Vec3f&, Sampler& sampler, const Wavelengths& w,
                     RayCounts& counts) const override {
        const Spectral all = total_->total(w) * Spectral(exit_scale_);
        // Drawn with the probability that is its share: no weight but its own.
        if (sampler.next1d() >= share_) return {Spectral(0.f), exit, all};
        const Vec3f inwards = -exit.ng;
        const Ray ray{exit.spawn(inwards), inwards};
        ++counts.rays;
        const auto hit = scene_.rays.intersect(ray);
        if (!hit || hit->shape != shape_) return {};
        const Spectral depth = bands_.at(per_length_.data(), w) * Spectral(hit->t);
        Spectral kept;
        for (int i = 0; i < Spectral::size; ++i) kept.set(i, std::exp(-depth[i]));
        return {Spectral(0.f), scene_.rays.surface_point(ray, *hit), all * kept};
    }

  private:
    const Scene& scene_;
    std::uint32_t shape_;
    Bands bands_;
    float share_;
    std::shared_ptr<const ProfileTables> total_;
    float exit_scale_;
    std::vector<float> per_length_;  // of each band
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& thickness_technique() {
    static const TechniqueDescription description{
        .name = "thickness",
        .title = "attenuation by thickness",
        .authors = "S. Green",
        .year = 2004,
        .paper = "Real-Time Approximations to Subsurface Scattering, GPU Gems",
        .how = "a share of the light came in straight behind the point where it leaves",
        .precomputes = "the profile's total",
        .keeps = {.view = true, .light = true, .geometry = true},
        .parameters = {profile_parameter(),
                       exit_fresnel_parameter(),
                       {.name = "share",
                        .meaning = "of the light that comes from behind",
                        .otherwise = Options().share},
                       {.name = "length",
                        .meaning = "on which it fades, in transport mean free paths",
                        .low = 0.,
                        .high = 1000.,
                        .above_low = true,
                        .otherwise = Options().length}},
        .variants = "share=0.3|share=0.6",
        .prepare = prepare_path_technique,
        .below = [](const ShapeInput& in) -> TranslucencyPtr {
            return std::make_shared<Thickness>(in, Options{.share = in.options.number("share"),
                                                           .length = in.options.number("length")});
        }};
    return description;
}

}  // namespace nacre
