#pragma once
// A patch of microgeometry, one period of a surface that goes on for ever, and rays through it.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nacre/geometry/ray_scene.h"
#include "nacre/optics/phase.h"
#include "nacre/reflectance/bsdf.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// What the material does at a point of the patch; valid until the scratch is reset.
using SurfaceBsdf =
    std::function<const Bsdf&(const SurfacePoint&, const Wavelengths&, BsdfScratch&)>;

/// What fills the room on one side of a surface, for the wavelengths that are measured; per unit of
/// length of the patch.
struct PatchMedium {
    std::string name;  ///< of what it is in, for messages
    Spectral sigma_t{0.f}, sigma_s{0.f};
    PhaseFunction phase;
};

/// The media on both sides of a shape: positions in Patch::media, -1 for none.
struct PatchSides {
    bool differ =
        false;  ///< crossing the shape changes the medium; otherwise the others mean nothing
    int inside = -1, outside = -1;
};

/// The tile [x, x + width) x [y, y + height) of a surface whose mean normal is +z, repeated in both
/// directions. `rays` holds all that reaches into the tile, and best a little more: what crosses
/// the edge of the tile has to stand at the opposite edge too. Lengths in any one unit.
struct Patch {
    std::shared_ptr<const RayScene> rays;  ///< built
    double x = 0., y = 0., width = 1., height = 1.;
    double bottom = 0., top = 0.;  ///< everything lies between
    SurfaceBsdf bsdf;
    std::vector<PatchMedium> media = {};
    std::vector<PatchSides> sides = {};  ///< of each shape; empty: there are no media
};

/// A patch of built shapes over the tile that is given, or their whole extent in x and y if its
/// width is 0. Throws InputError if there is nothing to measure or the tile has no area.
Patch make_patch(std::shared_ptr<const RayScene> rays, SurfaceBsdf bsdf, double x = 0.,
                 double y = 0., double width = 0., double height = 0.);

/// How a flight through the patch ends. `lost`: after a hundred thousand periods, for a ray that
/// hardly rises. `ends`: after the length that it was given.
enum class Fate { meets, leaves_above, leaves_below, ends, lost };

struct Flight {
    Fate fate = Fate::lost;
    SurfacePoint at;     ///< where it meets the surface; within the tile or next to its edge
    double length = 0.;  ///< until it meets, leaves or ends
    Point3f end;         ///< of one that ends: a point in the tile
};

/// From `origin`, in the tile, along the unit vector `direction`, period after period, `longest` at
/// most.
Flight fly(const Patch& patch, Point3f origin, const Vec3f& direction, double longest = 1e30);

}  // namespace nacre
