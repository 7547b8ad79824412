#pragma once
// What a half space returns behind a rough boundary.
//
// Facets that see light once (Walter et al. 2007) lose some at every reflection, from inside too:
// behind a rough boundary even white matter returns only part of the light that entered, and how
// much depends on how often light met the boundary before. Matter that absorbs lets it meet it
// less often, and returns almost what it would behind a smooth boundary or, since facets let pass
// what a flat surface reflects totally, more. So no one factor serves all media.
//
// Here light goes to and fro between the boundary and the half space below it, order by order, as
// flux in intervals of the cosine: what the half space does is by adding and doubling
// (layers/adding_doubling.h), what the boundary does by samples of its material.
#include <span>
#include <vector>

#include "nacre/bssrdf/medium.h"
#include "nacre/math/work.h"
#include "nacre/render/object_boundary.h"

namespace nacre {

class RoughHalfSpace {
  public:
    /// Behind a rough boundary, whose rough_boundary_eta() is positive. Takes some 0.1 s.
    explicit RoughHalfSpace(const Material& boundary);

    /// The share of the even light that entered which leaves again, within [0, 1], to some 0.2 %;
    /// less accurate for narrow phase functions, of which `nodes` see the broad part. Azimuths are
    /// averaged. The medium's index is taken to be that of the boundary. Takes some 50 ms.
    double albedo(const ProfileMedium& medium) const;

    /// Nodes of adding and doubling.
    static constexpr int nodes = 32;

  private:
    std::size_t size() const { return cosine_.size(); }

    double eta_;
    std::vector<double> cosine_, width_;  ///< of the intervals, below the boundary
    std::vector<double> entered_;         ///< even light that has just entered, 1 in all
    std::vector<double> leaves_;          ///< the share of light from below that leaves
    std::vector<double> turned_;          ///< [to * size + from]: that the boundary sends back
};

/// For each medium, what it returns as a half space behind the boundary over what it returns behind
/// a smooth one of the same index: the factor of what techniques know of smooth boundaries. Both
/// have the same nodes, so that what those miss of a narrow phase function cancels. Empty if the
/// boundary is smooth. Throws InputError for media that `check` refuses, Stopped if `work` says so.
std::vector<double> rough_return(const ObjectBoundary& boundary,
                                 std::span<const ProfileMedium> media, const Work& work = {});

}  // namespace nacre
