#pragma once
// The random walk of a path through a homogeneous medium: free paths, collisions, changes of
// direction, until it meets a surface. A renderer of translucent objects spends its time here, so
// this is small and knows nothing of scenes: the surroundings are a template argument.
//
// The free path is drawn first and bounds the ray that is traced; tracing first, as most renderers
// do, needs unbounded rays and takes several times as long. Where the surroundings know that no
// surface is nearer than the free path, no ray is traced at all. Both leave the distribution of
// paths, even each single path, unchanged.
#include <cstdint>

#include "nacre/math/fast.h"
#include "nacre/math/random.h"
#include "nacre/optics/phase.h"

namespace nacre {

struct Walker {
    Point3f p;   ///< the last collision, or the start
    Vec3f d;     ///< direction of travel, unit vector
    Vec3f d_in;  ///< direction before the last collision
    Random random;
    std::uint32_t collisions = 0;
    float length = 0.f;     ///< of all segments between start and last collision
    float free_path = 0.f;  ///< from the last collision to the surface that ended the walk
};

/// So many collisions a walk makes at a time, before anything else (roulette, spectral weights) is
/// thought about.
inline constexpr std::uint32_t walk_chunk = 64;

/// Farther than any surface.
inline constexpr float no_surface = 1e30f;

enum class WalkEnd {
    surface,  ///< a surface ends the segment that starts at `p` along `d`
    paused,   ///< the allowed number of collisions was made; `d` is still the direction before the
              ///< last one
    escaped,  ///< passed, and no surface ended the segment
    lost,     ///< left the region that the surroundings know: through a leak in a mesh, say
};

/// Walks until one of these ends. `sigma_t` is the extinction for which free paths are drawn, each
/// time with the given chance, else the walk passes to the next surface however far; absorption is
/// not drawn but left to the caller, as a weight per collision and passage.
///
/// Surroundings provide
///   Place locate(const Point3f&)     with the members `clearance` (a lower bound of the distance to
///                                    any surface) and `outside` (the walk is lost)
///   bool surface(p, d, s, float& t)  is there a surface within s of p along d, and where
///   void collided(const Walker&, const Place&)
///                                    called at each collision, before the direction changes
template <class Surroundings>
WalkEnd walk(Walker& w, float sigma_t, const PhaseFunction& phase, std::uint32_t max_collisions,
             Surroundings& surroundings, float chance = 1.f) {
    const float inverse_chance = 1.f / chance;
    const float mean_free_path = 1.f / sigma_t;
    const bool isotropic = phase.kind() == PhaseFunction::Kind::isotropic;
    auto place = surroundings.locate(w.p);
    for (;;) {
        const float drawn = 1.f - w.random.next();
        const bool passes = drawn > chance;
        const float s = passes ? no_surface : -fast_log(drawn * inverse_chance) * mean_free_path;
        if (s >= place.clearance && surroundings.surface(w.p, w.d, s, w.free_path))
            return WalkEnd::surface;
        if (passes) {
            w.free_path = s;
            return WalkEnd::escaped;
        }
        w.p += w.d * s;
        w.length += s;
        ++w.collisions;
        place = surroundings.locate(w.p);
        if (place.outside) return WalkEnd::lost;
        surroundings.collided(w, place);
        if (w.collisions == max_collisions) return WalkEnd::paused;
        w.d_in = w.d;
        const Vec2f u = w.random.next2();
        w.d = isotropic ? fast_uniform_sphere(u) : phase.sample(w.d, u);
    }
}

}  // namespace nacre
