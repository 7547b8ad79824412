#pragma once
// Direct connections to lights that no path meets by chance (point, spot, directional) through one
// smooth boundary: every way on which light of such a light comes to a point below the boundary,
// refracted once.
//
// Each facet of the boundary that a light shines on sends a narrow beam into the matter below it.
// The beams are known before rendering, since they do not depend on where they are seen from; a
// tree of boxes around pieces of them tells which may hold a point, and Newton's method finds the
// place on the facet from where light comes to it, with interpolated normals as with flat ones. So
// all ways are found, and the estimate is exact but for
//   - beams longer than `cut_in_free_paths`, whose light is less than e^-20;
//   - second solutions within one facet: facets over which the refracted direction turns by more
//     than `widest_turn` are divided, so there is one but where such a small piece is focused.
//
// Nishita, Nakamae 1994 (Method of Displaying Optical Effects within Water using Accumulation
// Buffer) and Iwasaki et al. 2001 draw such beams; Walter, Zhao, Holzschuch, Bala 2009 (Single
// Scattering in Refractive Media with Triangle Mesh Boundaries) ask the question the other way
// round and search all facets for each point.
#include <array>
#include <vector>

#include "nacre/geometry/box_tree.h"
#include "nacre/math/work.h"
#include "nacre/render/refraction.h"
#include "nacre/scene/scene.h"

namespace nacre {

class LightBeams {
  public:
    LightBeams() = default;
    /// Of all lights of `scene` that are points or directions, through all smooth dielectric
    /// boundaries of relative index above 1. Throws Stopped if `work` says so.
    explicit LightBeams(const Scene& scene, const Work& work = {});

    bool empty() const { return tree_.empty(); }
    std::size_t facets() const { return facets_.size(); }
    std::size_t pieces() const { return tree_.size(); }

    /// A way from a point to a light. Whether something lies on it is not known.
    struct Way {
        const Light* light;
        SurfacePoint at;  ///< where light enters
        Vec3f inside;     ///< from the point to `at`
        float length;     ///< of that
        float gain;       ///< irradiance at the point, facing `inside`, for an irradiance of 1 at
                          ///< `at`, facing the light: Fresnel transmittance and refraction_gain
    };
    /// All ways to `y` that are no longer than `reach` inside. `ways` and `scratch` are overwritten.
    void find(const Point3f& y, float reach, std::vector<Way>& ways,
              std::vector<std::uint32_t>& scratch) const;

    static constexpr float cut_in_free_paths = 20.f;
    static constexpr double widest_turn = 0.1;

  private:
    struct Facet {
        std::array<Point3f, 3> p;  // corners, and the light's directions below them
        std::array<Vec3f, 3> d;
        ChartTriangle piece;
        // How far surface and directions leave the interpolation, in heights of the facet.
        float bulge, spread;
        std::uint32_t source;
    };
    // A cone around a beam: what a point must lie in to be worth a closer look.
    struct Cone {
        Point3f p;
        Vec3f d;
        float radius, spread;  // at p, and growing by this along d
    };
    class Builder;
    // Where on the facet light to y enters, first by interpolation, then exactly.
    static bool near(const Facet& facet, const Point3f& y, double& a, double& b);
    bool solve(const Facet& facet, const Point3f& y, double a, double b, Way& way) const;
    bool complete(const Facet& facet, const Vec3d& y, double a, double b, Way& way) const;

    const Scene* scene_ = nullptr;
    std::vector<SourceWithoutExtent> sources_;
    std::vector<Facet> facets_;
    std::vector<Cone> cones_;              // one for each facet
    std::vector<std::uint32_t> facet_of_;  // each box
    BoxTree tree_;
};

}  // namespace nacre
