#pragma once
// The distribution of facets that a BRDF's retro-reflection suggests, on the square of half vectors
// (half_vector_square.h), and what follows from it: what the adaptive parameterisation of RGL's files
// needs (rgl_brdf.h).
//
//   J. Dupuy, W. Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and
//   Rendering, ACM Transactions on Graphics 37(6), section 3: of facets that mirror alike,
//     f(w, w) cos(theta) = F D(w) / (4 sigma(w)),  sigma(w) = integral of D(m) max(w m, 0) dm,
//   so D is the first eigenvector of a positive operator, which powers of it find.
//
// A part of the light goes by even facets instead, so that D is nowhere 0 and every half vector has
// its place in the table.
#include <functional>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

class FacetDistribution {
  public:
    static constexpr double even_part = 0.1;

    /// `retro` is f(w, w) of any unit for half vectors w, negative values count as 0; called from
    /// many threads. width x height nodes span the square; of isotropic surfaces one row is asked.
    FacetDistribution(const std::function<double(const Vec3d& w)>& retro, bool isotropic, int width,
                      int height);

    int width() const { return width_; }
    int height() const { return height_; }
    /// D(h), sr^-1, and sigma at the nodes, by rows; the integral of D cos(theta) is 1.
    const std::vector<float>& ndf() const { return ndf_; }
    const std::vector<float>& sigma() const { return sigma_; }
    /// The density on the square of the normals visible from w, not normalised, at the nodes.
    std::vector<float> visible(const Vec3d& w) const;

  private:
    std::vector<double> projected(const std::vector<double>& d) const;

    int width_, height_;
    bool isotropic_;
    std::vector<Vec3d> half_;       ///< at the nodes
    std::vector<double> jacobian_;  ///< solid angle over area of the square
    std::vector<double> weight_;    ///< of the nodes in integrals over the hemisphere, sr
    std::vector<float> ndf_, sigma_;
};

}  // namespace nacre
