#pragma once
// BRDFs made for tests of factorisation.
#include <functional>

#include "nacre/measured/factor/grid.h"
#include "nacre/measured/target.h"

namespace nacre::test {

/// Any function of the two directions, the same in all bands unless `colour` says otherwise.
class MadeTarget final : public Target {
  public:
    using Function = std::function<std::optional<double>(const Vec3d& wi, const Vec3d& wo)>;
    explicit MadeTarget(Function f, Vec3d colour = {1., 1., 1.})
        : f_(std::move(f)), colour_(colour) {}
    std::string name() const override { return "made"; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override {
        if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
        const auto f = f_(wi, wo);
        return f ? std::optional(colour_ * *f) : std::nullopt;
    }
    bool isotropic() const override { return false; }

  private:
    Function f_;
    Vec3d colour_;
};

/// A product of a function of the light and one of the viewer.
inline double product_in_out(const Vec3d& wi, const Vec3d& wo) {
    return (0.2 + wi.z + 0.1 * wi.x) * (0.3 + wo.z * wo.z - 0.2 * wo.y);
}
/// A product of a function of the half vector and one of the difference vector: an anisotropic
/// distribution of facets times Fresnel's reflectance.
inline double product_half_difference(const Vec3d& wi, const Vec3d& wo) {
    const Vec3d h = normalize(wi + wo);
    const double facets = std::exp(-(h.x * h.x / 0.09 + h.y * h.y / 0.36) / (h.z * h.z));
    return facets * (0.04 + 0.96 * std::pow(1. - dot(wi, h), 5.));
}

}  // namespace nacre::test
