#pragma once
// A sum of models, each in all bands or in some: what a fit of several lobes gives.
#include "nacre/measured/target.h"

namespace nacre {

struct ModelTerm {
    AnyModel model;
    Settings settings;         ///< those of the model
    Vec3d weight{1., 1., 1.};  ///< factors of its value in red, green and blue
};

class ModelSum final : public Target {
  public:
    ModelSum(std::vector<ModelTerm> terms, std::string name);

    std::string name() const override { return name_; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override;
    Vec3d mirror(const Vec3d& w) const override;
    /// Whether all of its terms are.
    bool isotropic() const override;
    const std::vector<ModelTerm>& terms() const { return terms_; }

  private:
    std::vector<ModelTerm> terms_;
    std::vector<ModelTarget> targets_;  ///< one a term
    std::string name_;
};

}  // namespace nacre
