#pragma once
// A radial profile as a compact table of floats for renderers: values, cumulative amounts and
// importance sampling of the radius, for one channel or the four lanes of a path.
//
// The variable is x = r^2, so that no root is taken. Nodes divide each octave of x into eight equal
// parts and the exponent and upper bits of the float x are the number of its part: near the source
// the grid is as fine as the profile, far away as coarse, and no logarithm is taken. Within a part
// ln R is a cubic through values and slopes at both ends. From 1e-4 of the profile's length scale,
// nearer than which R is held constant, to where an octave adds less than 1e-6 of the light, at
// most 1e4 scales, beyond which R is 0. The relative error within this range is below 1e-4 (tested
// for every profile). A channel takes 24 bytes for each of 280 to 440 nodes.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nacre/bssrdf/profile.h"
#include "nacre/math/lanes.h"

namespace nacre {

/// V is float (RadialTable) or Spectral (SpectralRadialTable).
template <class V>
class BasicRadialTable {
  public:
    static constexpr int channels = sizeof(V) / sizeof(float);

    /// One profile a channel, at most as many as V has; the channels that are left are black.
    /// Throws InputError if there are more or none.
    explicit BasicRadialTable(std::span<const RadialProfile* const> profiles);
    explicit BasicRadialTable(const RadialProfile& profile)
        : BasicRadialTable(std::array{&profile}) {}

    /// R at squared distance r2 >= 0 (mm^2), mm^-2.
    V eval(float r2) const;
    /// Integral of R over the disk of squared radius r2, to the error of the values.
    V cumulative(float r2) const;
    /// Over all that is tabulated: with absorption within 1e-6 of the profile's total, without it
    /// short of the total by what lies beyond 1e4 scales, 3e-4 at most.
    V total() const { return nodes_.back().within; }

    /// Radius (mm) from u in [0, 1), distributed after one channel with the density `pdf` exactly.
    /// 0 for a black channel.
    float sample(float u, int channel = 0) const;
    /// Density per area (mm^-2) of radii sampled after each channel: R / total to within 1 %, since
    /// it is linear in x within a part. Its integral over the plane is 1 for every channel that is
    /// not black.
    V pdf(float r2) const;

    std::size_t size_in_bytes() const { return nodes_.size() * sizeof(Node); }

  private:
    struct Node {
        V cubic[4];  ///< ln R over the part that begins here, in t in [0, 1)
        V value;     ///< R
        V within;    ///< integral up to here
    };
    struct Place {
        std::size_t part;
        float t;
    };
    /// Part and fraction of x, which lies on the grid.
    Place find(float x) const;
    float position(std::size_t node) const;
    void fill(const RadialProfile& profile, int channel);

    std::uint32_t first_ = 0;  ///< bits of the first node's x
    float begin_ = 0.f, end_ = 0.f;
    std::vector<Node> nodes_;
};

using RadialTable = BasicRadialTable<float>;
using SpectralRadialTable = BasicRadialTable<Spectral>;

extern template class BasicRadialTable<float>;
extern template class BasicRadialTable<Spectral>;

}  // namespace nacre
