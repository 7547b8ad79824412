#pragma once
// D_att: how many facets have the normal h. These are the unnormalised forms of the illumination
// models; the densities of facet normals are in the room `reflectance`.
//
//   J. F. Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH, gives
//   the first three, peak 1, and reduces their parameters to the angle beta at which D is one half.
//   R. Hall 1989, Illumination and Color in Computer Generated Imagery, gives the fourth.
//
// Errata of secondary literature: the Trowbridge-Reitz form is printed without its outer square;
// the Gaussian's C1 is sqrt(ln 2) / beta; the empirical m = (1 + sqrt(tan beta)) / (2 sqrt(pi)),
// recommended as better, is another rule: it keeps D(0) <= 1 and does not make D(beta) one half.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

/// Phong: (n.h)^Ns.
template <class D>
D distribution_phong(const Vec3<D>& h, D ns) {
    using std::pow;
    return pow(clamped(h.z), ns);
}

/// Torrance and Sparrow 1967: exp(-(C1 theta_h)^2).
template <class D>
D distribution_torrance_sparrow(const Vec3<D>& h, D c1) {
    using std::atan2, std::exp, std::sqrt;
    const D a = c1 * atan2(D(sqrt(h.x * h.x + h.y * h.y + D(1e-30))), h.z);
    return exp(-a * a);
}

/// Trowbridge and Reitz 1975: (C2^2 / (t^2 (C2^2 - 1) + 1))^2, t = n.h.
template <class D>
D distribution_trowbridge_reitz(const Vec3<D>& h, D c2) {
    const D s = c2 * c2, q = s / (h.x * h.x + h.y * h.y + h.z * h.z * s);
    return q * q;
}

/// Beckmann and Spizzichino 1963 with Hall's constant: exp(-tan^2/m^2) / (4 pi m^2 t^4), a quarter
/// of the normalised density. m > 0 is sqrt(2) times the standard deviation of the slopes.
template <class D>
D distribution_hall_beckmann(const Vec3<D>& h, D m) {
    using std::exp;
    const D z2 = at_least(D(h.z * h.z), 1e-8);
    const D tan2 = (h.x * h.x + h.y * h.y) / z2;
    return exp(-tan2 / (m * m)) / (D(4. * std::numbers::pi) * m * m * z2 * z2);
}

// From the half-height angle beta, radians in (0, pi/2), to each one's parameter.

/// Ns = -ln 2 / ln cos(beta)
template <class D>
D phong_exponent_of_beta(D beta) {
    using std::cos, std::log;
    return D(-std::numbers::ln2) / log(cos(beta));
}

/// C1 = sqrt(ln 2) / beta
template <class D>
D torrance_sparrow_of_beta(D beta) {
    return D(std::sqrt(std::numbers::ln2)) / beta;
}

/// C2 = sqrt((1 - cos^2) / (sqrt(2) - cos^2))
template <class D>
D trowbridge_reitz_of_beta(D beta) {
    using std::cos, std::sin, std::sqrt;
    const D c = cos(beta), s = sin(beta);
    return s / sqrt(D(std::numbers::sqrt2) - c * c);
}

/// m^2 = -tan^2 / ln(cos^4 / 2), where Beckmann's D is half of D(0). Above m = 1/sqrt(2) the peak
/// is not at the normal.
template <class D>
D beckmann_slope_of_beta(D beta) {
    using std::cos, std::log, std::sqrt, std::tan;
    const D c2 = cos(beta) * cos(beta);
    return tan(beta) / sqrt(-log(c2 * c2 / D(2)));
}

/// m = (1 + sqrt(tan beta)) / (2 sqrt(pi)), which makes Hall's D(0) = 1 / (1 + sqrt(tan beta))^2.
template <class D>
D unclipped_slope_of_beta(D beta) {
    using std::sqrt, std::tan;
    return (D(1) + sqrt(tan(beta))) / D(2. * std::sqrt(std::numbers::pi));
}

}  // namespace nacre::illumination
