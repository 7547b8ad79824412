#include "nacre/render/shading_normal.h"

#include <algorithm>

namespace nacre {

namespace {

// Turned normals keep viewer and mirrored direction this far (cosine) above the surface, less where
// the viewer is no higher himself.
constexpr float clearance = 0.01f;

}  // namespace

bool turn_to_viewer(SurfacePoint& at, const Vec3f& to_viewer, bool mirrors) {
    const float side = dot(to_viewer, at.ng) < 0.f ? -1.f : 1.f;
    const Vec3f ng = at.ng * side, n = at.shading.n * side;
    const float height = dot(to_viewer, ng), cosine = dot(to_viewer, n);
    if (!(height > 0.f)) return false;
    const float least = std::min(clearance, 0.9f * height);
    const Vec3f mirrored = n * (2.f * cosine) - to_viewer;
    const float below = dot(mirrored, ng);
    if (mirrors ? below >= 0.f : cosine > 0.f) return false;

    // The direction along the surface that is nearest to the mirrored one, a little raised; the
    // normal that mirrors the viewer there lies between the two.
    Vec3f turned = n + to_viewer * (least - cosine);
    if (mirrors) {
        const Vec3f along = mirrored - ng * below;
        const float length_along = length(along);
        if (length_along > 1e-6f)
            turned = to_viewer + normalize(along * (1.f / length_along) + ng * least);
        // Straight back from whence it came.
        if (!(dot(turned, ng) > 0.f) || !(dot(turned, turned) > 1e-12f)) turned = ng;
    }
    at.shading = Framef::with_tangent(normalize(turned) * side, at.shading.s);
    return true;
}

}  // namespace nacre
