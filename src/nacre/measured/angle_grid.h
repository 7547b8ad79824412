#pragma once
// Measurements at all combinations of some theta_i, phi_i, theta_o and phi_o: linear between them.
#include <array>
#include <memory>

#include "nacre/measured/measured.h"

namespace nacre {

/// A row of a table: radians, theta_o above pi/2 for light that goes through.
struct AngleRow {
    double theta_i, phi_i, theta_o, phi_o;
};

/// Nodes of one angle and where between them others lie.
class AngleAxis {
  public:
    AngleAxis() = default;
    /// Of the values that occur; an azimuth goes round.
    AngleAxis(std::vector<double> values, bool azimuth);

    struct Place {
        int low, high;
        double part;  ///< share of `high`
    };
    /// Nothing where the nodes say nothing: between azimuths that do not go round, and more than half
    /// a step beyond the ends.
    std::optional<Place> place(double x) const;
    int size() const { return int(nodes_.size()); }
    /// The position of a value that occurs.
    int find(double value) const;
    /// Whether there are several nodes, in steps short enough to be linear between: 60 degrees of
    /// azimuth, 20 of theta.
    bool fine_enough() const;
    /// One half of the circle stands for the other, too.
    void fold() { folded_ = half_circle_; }

  private:
    std::vector<double> nodes_;
    bool azimuth_ = false;
    bool round_ = false;  ///< from the last node on to the first
    bool half_circle_ = false, folded_ = false;
    double largest_step_ = 0.;
};

class GridMeasured final : public Measured {
  public:
    /// Null if the rows are no full grid, or one too coarse. `values` has info.channels a row; NaN
    /// is missing. Of an isotropic surface phi_o - phi_i counts.
    static std::unique_ptr<Measured> make(const std::vector<AngleRow>& rows,
                                          const std::vector<double>& values,
                                          const MeasuredInfo& info);

    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;

  private:
    std::array<AngleAxis, 4> axis_;
    std::vector<AngleRow> rows_;
    std::vector<std::size_t> cell_;  ///< of each row
    std::vector<double> values_;     ///< by cell, the last axis fastest, then by channel
};

}  // namespace nacre
