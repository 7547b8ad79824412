// <bsdf type="null">: no surface at all, only a boundary between media of the same index.
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class Null final : public Material {
  public:
    unsigned flags() const override { return has_null; }
    Spectral eval(const SurfacePoint&, const Vec3f&, const Vec3f&,
                  const Wavelengths&) const override {
        return Spectral(0.f);
    }
    float pdf(const SurfacePoint&, const Vec3f&, const Vec3f&, const Wavelengths&) const override {
        return 0.f;
    }
    std::optional<MaterialSample> sample(const SurfacePoint&, const Vec3f& wo, float, Vec2f,
                                         const Wavelengths&) const override {
        MaterialSample s;
        s.wi = -wo;
        s.weight = Spectral(1.f);
        s.pdf = 1.f;
        s.delta = s.null = true;
        return s;
    }
    Spectral null_transmission(const SurfacePoint&, const Vec3f&,
                               const Wavelengths&) const override {
        return Spectral(1.f);
    }
};

}  // namespace

MaterialPtr make_null(const SceneNode&, BuildContext&) { return std::make_shared<Null>(); }

}  // namespace nacre
