#pragma once
// Importance sampling of a BSDF by patches: what the patch of the viewer is lit by is drawn patch by
// patch, and in a patch by the cosine. f cos(theta_i) over the density is then the same for all
// directions: the share of even light that reaches the viewer.
#include <optional>

#include "nacre/measured/klems.h"

namespace nacre {

class KlemsSampler {
  public:
    /// `data` must outlive it. Negative values count as 0.
    explicit KlemsSampler(const KlemsMeasured& data);

    /// Draws wi, on either side; nothing for a viewer that no light reaches.
    std::optional<Vec3f> sample(const Vec3f& wo, float u1, Vec2f u2) const;
    /// Density of `sample`, sr^-1.
    float pdf(const Vec3f& wi, const Vec3f& wo) const;

  private:
    /// Light that is reflected or passes, to a viewer of one side.
    struct Part {
        const KlemsMatrix* matrix = nullptr;
        bool from_front = true;
        std::vector<float> up_to;  ///< by exit patch: light of the incident patches up to each
        /// All that reaches the patch of wo; 0 of what is not in the file.
        float light(const Vec3f& wo) const;
        const float* row(const Vec3f& wo) const;
    };
    struct Side {
        Part reflected, passed;
    };
    static Part make_part(const KlemsMatrix& matrix, bool from_front);
    const Side& side_of(const Vec3f& wo) const { return wo.z > 0.f ? front_ : back_; }

    const KlemsMeasured* data_;
    Side front_, back_;
};

}  // namespace nacre
