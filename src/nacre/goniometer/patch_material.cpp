#include "nacre/goniometer/patch_material.h"

#include "nacre/math/error.h"
#include "nacre/reflectance/registry.h"

namespace nacre {
namespace {

class Mirror final : public DeltaBsdf {
  public:
    std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        return BsdfSample{
            .wi = {-wo.x, -wo.y, wo.z}, .weight = Spectral(1.f), .pdf = 1.f, .delta = true};
    }
};

}  // namespace

SurfaceBsdf surface_bsdf(std::string_view text, const Wavelengths& wavelengths) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    const Settings settings = parse_settings(text.substr(end));
    if (name == "mirror") {
        if (!settings.empty())
            throw InputError(
                fmt::format("mirror: unknown parameter '{}'; it has none", settings.front().name));
        static const Mirror mirror;
        return [](const SurfacePoint&, const Wavelengths&, BsdfScratch&) -> const Bsdf& {
            return mirror;
        };
    }
    const AnyModel model = make_model(name, settings);
    return [&evaluator = model.evaluator(), values = model.values(wavelengths)](
               const SurfacePoint&, const Wavelengths&, BsdfScratch& scratch) -> const Bsdf& {
        return evaluator.bind(values, scratch);
    };
}

Patch make_patch(Microgeometry geometry, SurfaceBsdf bsdf) {
    auto rays = std::make_shared<RayScene>();
    rays->add(std::make_shared<Mesh>(std::move(geometry.mesh)), true);
    rays->build();
    return make_patch(std::move(rays), std::move(bsdf), 0., 0., geometry.width, geometry.height);
}

}  // namespace nacre
