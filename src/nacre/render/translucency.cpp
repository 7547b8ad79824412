#include "nacre/render/translucency.h"

#include "nacre/math/sampling.h"

namespace nacre {
namespace {

class EntryBsdf final : public Bsdf {
  public:
    EntryBsdf(const ObjectBoundary& boundary, const SurfacePoint& at)
        : boundary_(boundary), at_(at) {}

    Spectral eval(const Vec3f& wi, const Vec3f&) const override {
        if (!EntryLobe::is_outside(at_, wi)) return Spectral(0.f);
        return Spectral((boundary_.transmittance(wi.z)) * cosine_hemisphere_pdf(wi.z));
    }
    float pdf(const Vec3f& wi, const Vec3f&) const override { return cosine_hemisphere_pdf(wi.z); }
    std::optional<BsdfSample> sample(const Vec3f&, float, Vec2f u2) const override {
        BsdfSample s;
        s.wi = square_to_cosine_hemisphere(u2);
        s.pdf = cosine_hemisphere_pdf(s.wi.z);
        if (!(s.pdf > 0.f) || !EntryLobe::is_outside(at_, s.wi)) return std::nullopt;
        s.weight = Spectral(boundary_.transmittance(s.wi.z));
        return s;
    }

  private:
    const ObjectBoundary& boundary_;
    SurfacePoint at_;
};

}  // namespace

const Bsdf& EntryLobe::at(const SurfacePoint& point, const Wavelengths&,
                          BsdfScratch& scratch) const {
    return scratch.make<EntryBsdf>(boundary_, point);
}

}  // namespace nacre
