#pragma once
// The pieces that a medium is in: shapes around and in each, and the lights inside. What can be
// known of one object (a grid, guided exits, which lights a straight line reaches) so does not hang
// on what the same medium is used for elsewhere in the scene.
#include <cstdint>
#include <span>
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

struct MediumPiece {
    std::vector<std::uint32_t> around;  ///< shapes whose inside it is
    std::vector<std::uint32_t> within;  ///< shapes in it, whose outside it is
    Box3f bounds;                       ///< of `around`
};

/// All shapes of a medium as one.
MediumPiece whole_of(const Scene& scene, const Medium& medium);
/// The pieces of `whole`; shapes whose boxes overlap belong together. None if the medium has no
/// bounds that could be known: it is outside of a shape that lies in none of the pieces.
std::vector<MediumPiece> pieces_of(const Scene& scene, const MediumPiece& whole);

/// Whether a shape encloses something by itself.
bool is_closed(const RayScene& rays, std::uint32_t shape);

/// Lights of which some of 16 points (or the place, of lights without extent) may lie inside of the
/// shapes around a piece. Of closed shapes those are the ones that have such a point; where one is
/// open, all lights without extent within the bounds.
std::vector<LightPtr> lights_inside(const Scene& scene, const MediumPiece& piece);

/// Whether the box of some light and the piece's overlap.
bool light_overlaps(const Scene& scene, const MediumPiece& piece);

/// Whether light from outside may come straight into a medium: it is around everything, a boundary
/// lets pass straight on, or a light shines within its bounds.
bool is_open(const Scene& scene, const Medium& medium);

}  // namespace nacre
