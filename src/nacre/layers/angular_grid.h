#pragma once
// Directions of a quadrature that hold in every medium of a stack at once. Refraction keeps
// p = eta sin(theta), so a node is a value of p; it travels in the media whose index is larger.
#include <span>
#include <vector>

namespace nacre {

/// One direction, stored by its cosine where that is closest to grazing, which keeps the digits of
/// p near the index there.
struct AngularNode {
    double eta = 1., cosine = 1.;
    double weight =
        0.;  ///< p dp: pi weight is a share of the flux of unit basic radiance L / eta^2

    /// Cosine in a medium of index `other`; 0 where total reflection keeps the node out.
    double cosine_in(double other) const;
    double invariant2() const { return eta * eta * (1. - cosine * cosine); }  ///< p^2
};

/// Gauss-Legendre nodes for p from 0 to the largest index, in increasing order. [0, largest] is cut
/// at every index; each part takes as its variable the cosine in the medium where it ends, in which
/// radiance and Fresnel's reflectance are smooth. `nodes` is for the whole range of a cosine;
/// parts that cover less of it get fewer.
std::vector<AngularNode> angular_grid(std::vector<double> indices, int nodes);

}  // namespace nacre
