#pragma once
// The bright part of an environment, as what paths are guided to: what stands out of the mean. The
// even rest is met by the walk itself, with a better density than any proposal would have.
//
//   O. Karlik, M. Sik, P. Vevoda, T. Skrivan, J. Krivanek 2019, MIS Compensation: Optimizing
//   Sampling Techniques in Multiple Importance Sampling, TOG 38(6).
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "nacre/math/random.h"
#include "nacre/scene/light.h"

namespace nacre {

/// Directions in cells on the faces of a cube, side x side on each.
struct DirectionCube {
    int side = 1;

    std::size_t size() const { return 6 * std::size_t(side) * std::size_t(side); }
    std::size_t cell(const Vec3f& d) const;
    /// The direction at (u, v) in [0, 1]^2 of a cell.
    Vec3f direction(std::size_t cell, Vec2f uv) const;
    Vec3f center(std::size_t cell) const { return direction(cell, {0.5f, 0.5f}); }
    /// Density per solid angle, at the unit vector `d`, of a density of 1 over the cells in (u, v):
    /// 1 / solid angle of a cell that is small.
    float per_solid_angle(const Vec3f& d) const;
};

/// A density over the cells of a cube; within a cell it is uniform on the cube's face.
class CubeDensity {
  public:
    CubeDensity() = default;
    CubeDensity(DirectionCube cube, const std::vector<float>& weights);
    Vec3f sample(float u, Vec2f within) const;
    float pdf(const Vec3f& d) const { return share_[cube_.cell(d)] * cube_.per_solid_angle(d); }

  private:
    DirectionCube cube_;
    std::vector<float> share_;          // of each cell
    std::vector<std::uint32_t> cells_;  // those with a share
    std::vector<float> cumulative_;     // over them
};

class GuideSky {
  public:
    /// Null if `light`, which is infinite, is too even. `eta` > 1 is the boundary's
    /// index inside over outside; `spread` the tangent of the angle by which a rough boundary
    /// spreads light that leaves, 0 for a smooth one.
    static std::shared_ptr<const GuideSky> of(const Light& light, float eta, float spread);

    Vec3f sample(Random& random) const;
    float pdf(const Vec3f& direction) const;
    /// Integral of its luminance over all directions.
    float flux() const { return flux_; }

    /// What it brings through a boundary of that normal: the integral of the luminance over the
    /// solid angle inside times the transmittance; and the mean cosine inside.
    struct Strength {
        float value = 0.f, cos_in = 1.f;
    };
    const Strength& strength(const Vec3f& normal) const {
        return strengths_[normals_.cell(normal)];
    }
    /// The largest strength of all normals, and what the rest of the sky would bring, were it even.
    float most() const { return most_; }
    float rest() const { return rest_; }

  private:
    float flux_ = 0.f, most_ = 0.f, rest_ = 0.f, fine_share_ = 0.f;
    CubeDensity fine_, wide_;
    DirectionCube normals_;
    std::vector<Strength> strengths_;
};

/// Those that were made before: many objects may be below one sky.
class GuideSkies {
  public:
    /// As GuideSky::of.
    std::shared_ptr<const GuideSky> of(const Light& light, float eta, float spread);

  private:
    std::map<std::tuple<const Light*, float, float>, std::shared_ptr<const GuideSky>> made_;
};

}  // namespace nacre
