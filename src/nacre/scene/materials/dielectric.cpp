// <bsdf type="dielectric">: a smooth boundary between two clear media.
//
//   int_ior  (bk7)   index inside, that is, away from the normal; see index.h
//   ext_ior  (air)   index outside
//   specular_reflectance, specular_transmittance (1)  factors without physical meaning
//
// Fresnel's equations choose between reflection and refraction. Radiance changes by 1/eta^2 when it
// crosses the boundary (F. E. Nicodemus 1963, Radiance, American Journal of Physics 31(5)). Where
// the index depends on wavelength, the refracted direction belongs to the first lane alone.
#include "nacre/optics/fresnel.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class DielectricBsdf final : public DeltaBsdf {
  public:
    DielectricBsdf(const RelativeIndex& index, const Texture& reflectance,
                   const Texture& transmittance, Vec2f uv, const Wavelengths& w)
        : index_(index), reflectance_(reflectance), transmittance_(transmittance), uv_(uv), w_(w) {}

    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f) const override {
        const bool outside = wo.z >= 0.f;
        const Spectral inner = index_.eval(w_), eta = outside ? inner : 1.f / inner;
        const Spectral fresnel = fresnel_dielectric(std::abs(wo.z), eta);
        const float reflected = fresnel[0];

        BsdfSample s;
        s.delta = true;
        if (u1 < reflected) {
            s.wi = {-wo.x, -wo.y, wo.z};
            s.pdf = reflected;
            s.weight = reflectance_.eval(uv_, w_) * fresnel / reflected;
            return s;
        }
        s.eta = eta[0];
        s.wi = refract(wo, Vec3f{0.f, 0.f, outside ? 1.f : -1.f}, s.eta);
        s.pdf = 1.f - reflected;
        if (s.wi.z == 0.f) return std::nullopt;
        s.weight = transmittance_.eval(uv_, w_) / (s.eta * s.eta);
        s.single_wavelength = index_.is_dispersive() && w_.mode == ColorMode::spectral;
        if (s.single_wavelength) s.weight = Spectral(s.weight[0], 0.f, 0.f, 0.f);
        return s;
    }

  private:
    const RelativeIndex& index_;
    const Texture &reflectance_, &transmittance_;
    Vec2f uv_;
    Wavelengths w_;
};

class Dielectric final : public Material {
  public:
    Dielectric(RelativeIndex index, TexturePtr reflectance, TexturePtr transmittance)
        : index_(std::move(index)),
          reflectance_(std::move(reflectance)),
          transmittance_(std::move(transmittance)) {}

    unsigned flags() const override { return reflects | transmits | has_delta; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<DielectricBsdf>(index_, *reflectance_, *transmittance_, point.uv, w);
    }
    float smooth_boundary_eta() const override {
        return index_.is_dispersive() || !is_one(*reflectance_) || !is_one(*transmittance_)
                   ? 0.f
                   : index_.nominal();
    }
    bool is_spectral() const override {
        return index_.is_dispersive() || reflectance_->is_spectral() ||
               transmittance_->is_spectral();
    }

  private:
    static bool is_one(const Texture& t) { return t.max() == 1.f && t.mean() == 1.f; }

    RelativeIndex index_;
    TexturePtr reflectance_, transmittance_;
};

}  // namespace

MaterialPtr make_dielectric(const SceneNode& node, BuildContext& context) {
    return std::make_shared<Dielectric>(
        RelativeIndex(node, "bk7"), get_reflectance(node, "specular_reflectance", 1.f, context),
        get_reflectance(node, "specular_transmittance", 1.f, context));
}

}  // namespace nacre
