#pragma once
// BSDFs by the patches of a Klems basis, for front and back.
//
//   J. H. Klems 1994, A New Method for Predicting the Solar Heat Gain of Complex Fenestration
//   Systems, ASHRAE Transactions 100(1).
//
// Rings of theta are divided into patches of phi, the first centred at phi = 0. A patch at (theta,
// phi) is the exit direction (sin theta cos phi, sin theta sin phi, +-cos theta), but light comes
// from (-sin theta cos phi, -sin theta sin phi, +-cos theta): so the diagonal of a matrix is what
// goes straight through, or is mirrored. The BSDF is constant over a pair of patches.
#include <array>
#include <memory>

#include "nacre/measured/formats.h"

namespace nacre {

struct KlemsBasis {
    struct Ring {
        double lower, upper;  ///< degrees
        int patches;
    };
    std::string name;
    std::vector<Ring> rings;

    int size() const;
    /// The patch that the direction (theta, phi) lies in; radians.
    int patch(double theta, double phi) const;
    /// That of a unit vector towards the light, or of an exit.
    int patch_of(const Vec3d& w, bool light) const;
    /// Its centre: radians.
    struct Angles {
        double theta, phi;
    };
    Angles centre(int patch) const;
    /// A place in it, evenly by solid angle times cosine for u and v in [0, 1).
    Angles within(int patch, double u, double v) const;
    /// The unit vector of it, towards the light or of an exit, on the side of z > 0 or the other.
    static Vec3d direction(Angles a, bool light, bool above);
    /// The integral of cos(theta) over it, sr.
    double projected_solid_angle(int patch) const;
};

/// sr^-1: rows are exits, columns incidences.
struct KlemsMatrix {
    KlemsBasis in, out;
    std::vector<double> value;  ///< empty: not in the file
};

class KlemsMeasured final : public Measured {
  public:
    enum Direction { transmission_front, transmission_back, reflection_front, reflection_back };

    KlemsMeasured(std::array<KlemsMatrix, 4> matrices, MeasuredInfo info);
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override;
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override;
    const KlemsMatrix& matrix(Direction d) const { return matrices_[d]; }

  private:
    std::array<KlemsMatrix, 4> matrices_;
};

}  // namespace nacre
