#pragma once
// Measurements at directions that follow no grid, and what is said between them.
//
// Coordinates in which distances are taken, of half vector h and difference angle theta_d:
//   isotropic    sqrt(2 theta_h / pi), 2 theta_d / pi, sin(theta_h) sin(theta_d) cos(phi_d)
//   otherwise    sqrt(2 theta_h / pi) (cos(phi_h), sin(phi_h)), and x and y of (wi - wo)/2
// Those of isotropic surfaces are the same for a pair turned about the normal or mirrored at the
// plane of incidence. theta_h is stretched at 0, where highlights are.
//
// Between measurements the eight nearest are mixed with the weights ((R - d)/(R d))^2, R the
// distance of the ninth: R. Franke, G. Nielson 1980, Smooth Interpolation of Large Sets of
// Scattered Data, International Journal for Numerical Methods in Engineering 15. At a measured pair
// the value is the measured one exactly. Nothing is said farther than `reach` from the nearest
// one, nor for angles to the normal that exceed the largest measured one by more than one degree.
#include <memory>

#include "nacre/measured/formats.h"
#include "nacre/measured/point_tree.h"

namespace nacre {

/// The coordinates above of a pair with wi above the horizon; light that goes through is placed by
/// its mirror image in the surface.
PointTree::Point scattered_place(const Vec3d& wi, const Vec3d& wo, bool isotropic);

class ScatteredMeasured final : public Measured {
  public:
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;

  private:
    friend class ScatteredBuilder;
    struct Pair {
        Vec3d wi, wo;
        SampleState state;
    };
    /// The measured pairs with the exit on one side.
    struct Side {
        PointTree tree;
        std::vector<std::uint32_t> pair;
        double least_in = 0., least_out = 0.;  ///< heights above the horizon that count as measured
    };
    const Side& side_of(const Vec3d& wo) const { return wo.z > 0. ? reflection_ : transmission_; }
    Side make_side(bool reflection) const;

    std::vector<Pair> pairs_;
    std::vector<double> values_;  ///< sr^-1, `channels` a pair
    Side reflection_, transmission_;
    double reach_ = 0.;
};

/// Collects what a reader finds.
class ScatteredBuilder {
  public:
    /// All but what is counted of samples, and the sides.
    explicit ScatteredBuilder(MeasuredInfo info);
    /// wi above the horizon, wo on either side. A NaN among the values, or a `known` of false, makes
    /// it missing.
    void add(const Vec3d& wi, const Vec3d& wo, std::span<const double> value, bool known = true);
    std::size_t size() const { return data_->pairs_.size(); }
    MeasuredInfo& info();
    /// Throws InputError if there is no measurement.
    std::unique_ptr<Measured> build(const MeasuredSource& source, double reach);

  private:
    std::unique_ptr<ScatteredMeasured> data_;
};

}  // namespace nacre
