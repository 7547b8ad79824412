#pragma once
// A lobe of directions around an axis, with the shape in which rough boundaries spread light: that
// of the GGX distribution of facet normals (reflectance/ggx.h).
#include <cmath>
#include <numbers>

#include "nacre/math/frame.h"

namespace nacre {

struct GuideLobe {
    Vec3f axis;
    float alpha2 = 1.f;  ///< squared tangent of the angle within which half of the directions lie

    /// Density per solid angle; 0 on the far side.
    float pdf(const Vec3f& d) const {
        const float c = dot(d, axis);
        if (!(c > 0.f)) return 0.f;
        const float r = c * c * alpha2 + std::max(0.f, 1.f - c * c);
        return alpha2 * c / (std::numbers::pi_v<float> * r * r);
    }
    Vec3f sample(Vec2f u) const {
        const float tan2 = alpha2 * u.x / (1.f - u.x);
        const float c = 1.f / std::sqrt(1.f + tan2), s = std::sqrt(tan2) * c;
        const float phi = 2.f * std::numbers::pi_v<float> * u.y;
        return Framef::around(axis).to_world({s * std::cos(phi), s * std::sin(phi), c});
    }
};

}  // namespace nacre
