// <bsdf type="null">: no surface at all, only a boundary between media of the same index.
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class NullBsdf final : public DeltaBsdf {
  public:
    std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f) const override {
        BsdfSample s;
        s.wi = -wo;
        s.weight = Spectral(1.f);
        s.pdf = 1.f;
        s.delta = s.null = true;
        return s;
    }
    Spectral null_transmission(const Vec3f&) const override { return Spectral(1.f); }
};

class Null final : public Material {
  public:
    unsigned flags() const override { return has_null; }
    const Bsdf& at(const SurfacePoint&, const Wavelengths&, BsdfScratch&) const override {
        return everywhere_;
    }

  private:
    NullBsdf everywhere_;
};

}  // namespace

MaterialPtr make_null(const SceneNode&, BuildContext&) { return std::make_shared<Null>(); }

}  // namespace nacre
