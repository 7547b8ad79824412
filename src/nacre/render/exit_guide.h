#pragma once
// Guided exits: at a collision below a dielectric boundary, a direction that leads out of the
// object towards a light, for the connection that next-event estimation cannot make because the
// boundary refracts.
//
// The proposal chooses one of four planes that stand for the boundary nearby, a light, and a
// direction outside towards that light as seen from the collision, and refracts it inwards through
// the plane. The path so proposed is traced for real; the proposal only has to have a density, and
// the density of the random walk's own exits is combined with it by the balance heuristic. Proposal
// and probability of proposing are functions of the collision's position alone, never of the path's
// history, so that the density can be evaluated for exits that the walk found by itself.
//
// Below a rough boundary the direction only has to lead to where the boundary shows the light:
// there the light is drawn by next-event estimation. Directions outside are spread about each light
// as the boundary spreads them, and some of those inside are left to chance.
//
// Unpublished; near relatives are Walter et al. 2009 (Single Scattering in Refractive Media with
// Triangle Mesh Boundaries) and manifold next-event estimation (Hanika, Droske, Fascione 2015),
// which solve for the exact connection.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nacre/math/random.h"
#include "nacre/render/distance_grid.h"
#include "nacre/render/guide_lobe.h"
#include "nacre/render/guide_sky.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// Surfaces of one index through which paths are guided out of a medium.
struct ExitBoundary {
    std::vector<std::uint32_t> shapes;  ///< the medium is inside of each
    float eta = 1.f;                    ///< index inside over outside, > 1
    /// 0: smooth; else rough, spreading light that leaves by about so much (tangent of the angle).
    float spread = 0.f;
    /// Other boundaries of the matter: where those are nearer, paths are not guided.
    std::vector<std::uint32_t> others{};
    /// Lights that are in the matter, where straight lines reach them.
    std::vector<LightPtr> lights_inside{};
};

/// What directions are proposed towards: an area that shines, the bright part of an environment or,
/// below rough boundaries, a light that is a point. A stand-in for the light; it need not match its
/// shape.
struct GuideTarget {
    Point3f center;
    Vec3f u, v;        ///< half axes of a parallelogram; both zero for a sphere
    Vec3f normal;      ///< unit normal of the parallelogram, on the side that shines
    float radius = 0;  ///< of the sphere
    float radiance = 0;
    std::shared_ptr<const GuideSky> sky;  ///< instead of the area
    const Light* point = nullptr;         ///< instead of the area

    float area() const;
    /// Towards the middle of an area or point as seen from y; zero where it does not shine.
    Vec3f towards(const Point3f& y) const;
    /// Directions towards an area or point that a rough boundary spreads by `spread`.
    GuideLobe lobe(const Point3f& y, float spread) const;
    /// Density per solid angle, from y, of `sample`; not of points.
    float pdf(const Point3f& y, const Vec3f& direction) const;
    Vec3f sample(const Point3f& y, Random& random) const;
};

class ExitGuide {
  public:
    ExitGuide() = default;
    /// Guides paths in `medium` out through `boundary`. Marks the cells of `grid` near it, with
    /// indices from `first_index` on. Without lights worth guiding to, `active` is false. Throws
    /// Stopped if `work` says so.
    ExitGuide(const Scene& scene, const Medium& medium, const ExitBoundary& boundary,
              DistanceGrid& grid, GuideSkies& skies, const Work& work = {},
              std::int32_t first_index = 0);

    bool active() const { return !cells_.empty() && !targets_.empty(); }
    bool rough() const { return spread_ > 0.f; }
    /// So many indices are its own.
    std::int32_t size() const { return static_cast<std::int32_t>(cells_.size()); }
    std::size_t memory() const { return cells_.size() * sizeof(Cell); }

    static constexpr int max_targets = 4;

    /// The proposal at one collision.
    class Proposal {
      public:
        /// Probability of making a proposal at all.
        float probability() const { return probability_; }
        /// A direction inside, towards the boundary; empty if the proposal failed (its density is
        /// then lost, which is part of the density and needs no correction).
        std::optional<Vec3f> sample(Random& random) const;
        /// Density of `sample` per solid angle inside.
        float pdf(const Vec3f& direction) const;

      private:
        friend class ExitGuide;
        const ExitGuide* guide_ = nullptr;
        const Vec3f* normals_ = nullptr;
        Point3f y_;
        float probability_ = 0.f;
        std::array<float, max_targets> choice_{};   // probability of each target
        std::array<GuideLobe, max_targets> lobes_;  // of rough boundaries, but for the sky's
    };
    /// `cell` is the index that the grid holds for the cell of y, less the guide's first; it must
    /// not be negative.
    Proposal at(const Point3f& y, std::int32_t cell) const;

  private:
    static constexpr int planes = 4;
    /// The nearest plane counts most; the others catch light that leaves through the facets around
    /// it.
    static constexpr std::array<float, planes> plane_weight{0.4f, 0.2f, 0.2f, 0.2f};

    struct Cell {
        std::array<Vec3f, planes> normals;
        float offset;  // of the nearest plane: dot(normal, x) on it
        // What each target could bring at the surface, and how fast that falls with depth. Taken at
        // the cell's centre: a proposal may be any function of position, and a constant is the
        // cheapest.
        std::array<float, max_targets> strength, fall;
    };
    // What `target` could bring to a point at the surface, in the units of `reference_`; and the
    // cosine inside.
    float strength(const GuideTarget& target, const Point3f& at, const Vec3f& normal,
                   float& cos_in) const;

    std::vector<Cell> cells_;
    std::vector<GuideTarget> targets_;
    float eta_ = 1.f, spread_ = 0.f;
    float reference_ = 1.f;  // strength at which a proposal is certain
};

}  // namespace nacre
