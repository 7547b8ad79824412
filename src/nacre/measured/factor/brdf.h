#pragma once
// A BRDF as a sum of products of textures, the form in which it is rendered.
#include <vector>

#include "nacre/measured/factor/grid.h"
#include "nacre/measured/target.h"

namespace nacre {

/// R x R texels in red, green and blue, texel R r1 + r2 as in grid.h.
using FactorTexture = std::vector<Vec3f>;

struct FactorTerm {
    FactorTexture g, h;  ///< of the row's direction (wi or h) and of the column's (wo or d)
};

/// f = max(0, sum_j g_j h_j), or exp(sum_j g_j h_j) of logarithmic ones, sr^-1. Textures are looked
/// up bilinearly between the middles of texels, around in phi; beyond the first and last middle of
/// theta their values hold.
class FactoredBrdf final : public Target {
  public:
    /// Throws InputError unless there is a term and each texture has the texels of the grid.
    FactoredBrdf(const FactorGrid& grid, std::vector<FactorTerm> terms, bool logarithmic,
                 std::string name, bool isotropic);

    std::string name() const override { return name_; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override;
    /// The same in single precision, for renderers.
    std::optional<Vec3f> value_float(const Vec3f& wi, const Vec3f& wo) const;
    /// What was said of the BRDF that was factored; lookups differ a little from one azimuth to
    /// another.
    bool isotropic() const override { return isotropic_; }

    const FactorGrid& grid() const { return grid_; }
    const std::vector<FactorTerm>& terms() const { return terms_; }
    bool logarithmic() const { return logarithmic_; }

  private:
    template <class T>
    std::optional<Vec3<T>> sum(const Vec3<T>& wi, const Vec3<T>& wo) const;

    FactorGrid grid_;
    std::vector<FactorTerm> terms_;
    bool logarithmic_;
    std::string name_;
    bool isotropic_;
};

}  // namespace nacre
