#pragma once
// A piecewise bilinear function on the unit square that depends on parameters: looked up, and as a
// density sampled and inverted exactly.
//
//   J. Dupuy, W. Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and
//   Rendering, ACM Transactions on Graphics 37(6), section 4: the marginal density of the rows is
//   piecewise linear, and so is the density within a row; both are inverted in closed form. Tables
//   for neighbouring values of the parameters are mixed linearly, cumulative sums as well.
//
// In single precision, and without allocation once made: renderers use it.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nacre {

/// Up to four slices of a table and their weights, which sum to 1; the weights beyond are 0.
struct SliceMix {
    int count = 1;
    std::array<std::uint32_t, 4> slice{};
    std::array<float, 4> weight{1.f};
};

/// The values of two parameters at which a table has slices; the second runs fastest.
class ParameterGrid {
  public:
    ParameterGrid() = default;
    /// Both ascending, at least one value each.
    ParameterGrid(std::vector<float> slow, std::vector<float> fast);

    /// The slices around; beyond the first and last value these hold.
    SliceMix at(float slow, float fast) const;
    std::size_t size() const { return slow_.size() * fast_.size(); }
    const std::vector<float>& slow() const { return slow_; }
    const std::vector<float>& fast() const { return fast_; }

  private:
    std::vector<float> slow_{0.f}, fast_{0.f};
};

/// Values at the nodes of slices of width x height nodes, which span the unit square; x runs
/// fastest.
class BilinearTable {
  public:
    BilinearTable() = default;
    /// At least 2 x 2 nodes; `values` has slices * height * width of them.
    BilinearTable(int width, int height, std::vector<float> values);
    /// x and y in [0, 1].
    float eval(float x, float y, const SliceMix& mix) const;
    int width() const { return width_; }
    int height() const { return height_; }
    const std::vector<float>& values() const { return values_; }

  private:
    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

class MarginalWarp {
  public:
    MarginalWarp() = default;
    /// Every slice is scaled to a density; one that is 0 everywhere becomes uniform. Values must
    /// not be negative.
    MarginalWarp(int width, int height, std::vector<float> values);

    struct Point {
        float x = 0.f, y = 0.f;
        float density = 0.f;  ///< of (x, y) on the unit square, where the warp leads
    };
    /// Where the uniform numbers u and v in [0, 1) go: x and y with the density there.
    Point sample(float u, float v, const SliceMix& mix) const;
    /// The uniform numbers that go to (x, y) in [0, 1]^2, and the density at (x, y).
    Point invert(float x, float y, const SliceMix& mix) const;
    float density(float x, float y, const SliceMix& mix) const;
    int width() const { return width_; }
    int height() const { return height_; }
    /// Of each node: the density over (width - 1) (height - 1), and the integral over its row up to
    /// it; of each row the integral up to it.
    const std::vector<float>& values() const { return values_; }
    const std::vector<float>& along() const { return along_; }
    const std::vector<float>& rows() const { return rows_; }

  private:
    template <int N>
    struct Slices;
    template <int N>
    Point sample_of(float u, float v, const SliceMix& mix) const;
    template <int N>
    Point invert_of(float x, float y, const SliceMix& mix) const;

    int width_ = 0, height_ = 0;
    std::vector<float> values_;  ///< scaled so that the mean over patches sums to 1
    std::vector<float> along_;   ///< at each node, the integral over its row up to it
    std::vector<float> rows_;    ///< at each row, the integral up to it
};

}  // namespace nacre
