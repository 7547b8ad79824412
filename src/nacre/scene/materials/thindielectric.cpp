// <bsdf type="thindielectric">: a pane so thin that light leaves it where it entered.
//
//   int_ior (bk7), ext_ior (air), specular_reflectance (1), specular_transmittance (1)
//
// With all reflections between the two faces the pane reflects R' = R + T R T + T R^3 T + ... = 2 R
// / (1 + R). What passes goes straight on, so shadow rays pass too, as in Mitsuba 3. An index that
// depends on wavelength changes R only.
#include "nacre/optics/fresnel.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class ThinDielectricBsdf final : public DeltaBsdf {
  public:
    ThinDielectricBsdf(const RelativeIndex& index, const Texture& reflectance,
                       const Texture& transmittance, Vec2f uv, const Wavelengths& w)
        : index_(index), reflectance_(reflectance), transmittance_(transmittance), uv_(uv), w_(w) {}

    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f) const override {
        const Spectral r = reflected(wo);
        BsdfSample s;
        s.delta = true;
        if (u1 < r[0]) {
            s.wi = {-wo.x, -wo.y, wo.z};
            s.pdf = r[0];
            s.weight = reflectance_.eval(uv_, w_) * r / s.pdf;
            return s;
        }
        if (!(r[0] < 1.f)) return std::nullopt;
        s.wi = -wo;
        s.pdf = 1.f - r[0];
        s.weight = transmittance_.eval(uv_, w_) * (1.f - r) / s.pdf;
        s.null = true;
        return s;
    }
    Spectral null_transmission(const Vec3f& wo) const override {
        return transmittance_.eval(uv_, w_) * (1.f - reflected(wo));
    }

  private:
    Spectral reflected(const Vec3f& wo) const {
        const Spectral r = fresnel_dielectric(std::abs(wo.z), index_.eval(w_));
        return 2.f * r / (1.f + r);
    }

    const RelativeIndex& index_;
    const Texture &reflectance_, &transmittance_;
    Vec2f uv_;
    Wavelengths w_;
};

class ThinDielectric final : public Material {
  public:
    ThinDielectric(RelativeIndex index, TexturePtr reflectance, TexturePtr transmittance)
        : index_(std::move(index)),
          reflectance_(std::move(reflectance)),
          transmittance_(std::move(transmittance)) {}

    unsigned flags() const override { return reflects | has_delta | has_null; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<ThinDielectricBsdf>(index_, *reflectance_, *transmittance_, point.uv,
                                                w);
    }
    bool is_spectral() const override {
        return index_.is_dispersive() || reflectance_->is_spectral() ||
               transmittance_->is_spectral();
    }

  private:
    RelativeIndex index_;
    TexturePtr reflectance_, transmittance_;
};

}  // namespace

MaterialPtr make_thindielectric(const SceneNode& node, BuildContext& context) {
    return std::make_shared<ThinDielectric>(
        RelativeIndex(node, "bk7"), get_reflectance(node, "specular_reflectance", 1.f, context),
        get_reflectance(node, "specular_transmittance", 1.f, context));
}

}  // namespace nacre
