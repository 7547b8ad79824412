#pragma once
// The hierarchy of the two-pass technique: what many surface points together send to one.
//
//   H. W. Jensen, J. Buhler 2002, A Rapid Hierarchical Rendering Technique for Translucent
//   Materials, SIGGRAPH (ACM TOG 21(3)), section 3.
//   M(x_o) = sum_i R_d(|x_o - x_i|) Phi_i,  Phi_i = E_i A_i, the power that enters at point i.
// A group of points counts as one at its power-weighted centre if it is seen under a solid angle
// A / d^2 of less than epsilon and x_o lies outside of it; else its members are looked at.
//
// The paper's octree holds eight cells a node. Here a node holds as many groups as the processor
// has lanes (16 or 8), so that one test and one evaluation serve all of them; groups are made by
// halving boxes at the median, which fills every node. Groups of unequal size do no harm, because
// nodes hold sums: averages over children, as in some programs, would be biased.
#include <cstdint>
#include <span>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// R_d of a dipole in one band, as a function of the squared distance:
///     sum over both sources s of  exp(-sigma_tr d) / d (p_s + q_s (1 + sigma_tr d) / d^2),
///     d^2 = r^2 + z_s^2.
/// Jensen et al. 2001: p = 0, q = alpha' z / (4 pi). d'Eon 2012: p = +- alpha'^2 C_phi / (4 pi D),
/// q = alpha'^2 C_E z / (4 pi).
struct DipoleKernel {
    float sigma_tr = 0.f;
    struct Source {
        float z2 = 0.f, p = 0.f, q = 0.f;
    } real, image;
};

class IrradianceTree {
  public:
    IrradianceTree() = default;
    /// `power`: of point i in band b at i * bands + b, bands <= `max_bands`. `area`: share of the
    /// surface of each point. `epsilon` > 0 in steradians; 0 sums over all points.
    IrradianceTree(std::span<const Point3f> points, std::span<const float> area,
                   std::span<const float> power, int bands, float epsilon);

    /// M at `at` in each band, one kernel a band. Thread-safe.
    void gather(const Point3f& at, std::span<const DipoleKernel> kernels, float* exitance) const;

    static constexpr int max_bands = 24;
    int bands() const { return bands_; }
    std::size_t bytes() const { return data_.size() * sizeof(float) + child_.size() * 4; }

  private:
    struct Builder;
    // Node n at data_[n * stride]: x, y, z, acceptance distance squared, power of each band, each
    // of as many floats as lanes; child_[n * lanes] its children, -1 for points and groups of none.
    std::vector<float> data_;
    std::vector<std::int32_t> child_;
    int bands_ = 0;
    std::size_t stride_ = 0;
};

}  // namespace nacre
