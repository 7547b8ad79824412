#pragma once
// The directions over which a BRDF is factored: a matrix whose rows and columns each stand for a
// direction of the hemisphere, and the textures that its factors become.
//
//   J. Kautz, M. D. McCool 1999, Interactive Rendering with Arbitrary BRDFs using Separable
//   Approximations, Eurographics Workshop on Rendering: f(wi, wo) = sum_j g_j(x) h_j(y).
//
// A texture has R x R texels, column r1 and row r2 counted from 0; texel k = R r1 + r2 stands for
// the direction at its middle: phi = 2 pi (r1 + 1/2)/R, theta = (pi/2) t, t = (r2 + 1/2)/R.
//   in_out           x = wi, y = wo.
//   half_difference  x = h = (wi + wo)/|wi + wo|, y = d: wi in the frame of h, whose x axis is the
//                    surface's tangent made perpendicular to h (Gram and Schmidt), so that the frame
//                    turns with no azimuth at the normal. Here theta_h = (pi/2) t^2: highlights are
//                    narrow about the normal. Pairs of which one direction is below the horizon
//                    have no value.
#include <string_view>

#include "nacre/math/vec.h"
#include "nacre/measured/half_angle.h"

namespace nacre {

enum class FactorParameters { in_out, half_difference };

/// "in_out", "half_difference".
std::string_view name_of(FactorParameters parameters);

struct FactorGrid {
    static constexpr int least_side = 2, most_side = 64;

    FactorParameters parameters = FactorParameters::in_out;
    int side = 32;  ///< R

    int count() const { return side * side; }  ///< N: rows, and columns, of the matrix
    /// The direction of a row (wi or h) and of a column (wo or d), unit vectors.
    Vec3d row(int k) const;
    Vec3d column(int l) const;
    /// Solid angle of the texel, exact, times the cosine at its middle.
    double row_weight(int k) const;
    double column_weight(int l) const;
    /// What a pair of row and column stands for: wi and wo, either perhaps below the horizon.
    DirectionPair pair(const Vec3d& row, const Vec3d& column) const;
    /// cos(theta_i) cos(theta_o) dwi dwo of the pair; 0 below the horizon.
    double measure(int k, int l) const;
};

/// A place in a texture: (0, 0) and (1, 1) are its corners, x goes with phi and y with theta.
template <class T>
struct FactorPlaces {
    Vec2<T> row, column;
};
/// Where two unit vectors above the horizon are looked up; for float and double.
template <class T>
FactorPlaces<T> factor_places(FactorParameters parameters, const Vec3<T>& wi, const Vec3<T>& wo);

}  // namespace nacre
