#pragma once
// Kubelka and Munk 1931, Ein Beitrag zur Optik der Farbanstriche, Zeitschrift fuer technische
// Physik 12: diffuse light in a layer as two streams, i downwards and j upwards.
//
//   di/dz = -(S + K) i + S j,   -dj/dz = -(S + K) j + S i
//   a = (S + K) / S, b = sqrt(a^2 - 1), t = b S d:
//   R = sinh t / (a sinh t + b cosh t),   T = b / (a sinh t + b cosh t),   R_infinity = a - b
//   K = 0: R = S d / (1 + S d), T = 1 / (1 + S d);   S = 0: R = 0, T = exp(-K d)
//
// S and K are coefficients of the two streams, mm^-1, not those of the radiative transfer equation;
// `TwoStreamMapping` names the ways from the latter to the former. There is no direction, no
// collimated light and no lateral spread in it, and it is a poor theory for K/S above about 0.3.
#include "nacre/layers/layer.h"

namespace nacre {

struct TwoStream {
    double S = 0.;  ///< scattering from one stream into the other, mm^-1, >= 0
    double K = 0.;  ///< absorption, mm^-1, >= 0
};

/// S and K from scattering sigma_s, absorption sigma_a and mean cosine g.
enum class TwoStreamMapping {
    /// K = 2 sigma_a, S = 3/4 sigma_s (1 - g) - 1/4 sigma_a: agrees with diffusion theory for weak
    /// absorption. S is 0 where this would be negative (sigma_a > 3 sigma_s (1 - g)): such a layer
    /// only absorbs.
    diffusion,
    reduced,  ///< K = 2 sigma_a, S = sigma_s (1 - g)
    plain,    ///< K = sigma_a, S = sigma_s: texts that write sigma for the two-stream coefficients
};

TwoStream two_stream(double sigma_s, double sigma_a, double g, TwoStreamMapping mapping);

struct KubelkaMunkLayer {
    double reflectance = 0., transmittance = 1.;
    double absorptance = 0.;  ///< not by difference: keeps its digits where little is absorbed
};

/// R, T and A of a layer of `thickness` mm, >= 0, which may be infinite; a clear layer of any
/// thickness has T = 1. Finite and exact to rounding for every size of the arguments. Throws
/// InputError unless S, K and thickness are at least 0 and S and K are finite.
KubelkaMunkLayer kubelka_munk(const TwoStream& matter, double thickness);

/// Reflectance of an infinitely thick layer, a - b.
double kubelka_munk_infinite(const TwoStream& matter);

/// A layer or interface whose two sides differ. With an index step the transmittances differ as
/// well (those of diffuse light by the square of the index), hence four numbers.
struct FluxLayer {
    double reflectance_above = 0., reflectance_below = 0.;  ///< of light from above, from below
    double transmittance_down = 1., transmittance_up = 1.;
};

FluxLayer flux_layer(const KubelkaMunkLayer& layer);

/// `upper` on `lower`, with all reflections between the two. P. Kubelka 1954, New Contributions to
/// the Optics of Intensely Light-Scattering Materials, Part II: Nonhomogeneous Layers, JOSA 44(4):
///   R_above = R_above,1 + T_down,1 T_up,1 R_above,2 / (1 - R_below,1 R_above,2), and so on.
FluxLayer stacked(const FluxLayer& upper, const FluxLayer& lower);

/// Reflectance from above over a surface of reflectance R_g in [0, 1]:
///   R + T_down T_up R_g / (1 - R_below R_g).
double over_backing(const FluxLayer& layer, double backing);

/// What light enters the first surface.
enum class Entry {
    diffuse,  ///< the same from all directions: k1 = 2 C_1 from outside
    normal,   ///< a beam along the normal: k1 = F(0)
};

/// Surface of an index step. J. L. Saunderson 1942, Calculation of the Color of Pigmented Plastics,
/// JOSA 32(12).
struct Saunderson {
    double k1 = 0.;  ///< reflectance of light that enters
    double k2 = 0.;  ///< reflectance of diffuse light that leaves, exact (fresnel_moments.h)

    /// R_m = k1 + (1 - k1) (1 - k2) R / (1 - k2 R) of matter of reflectance R under the surface.
    double over(double reflectance) const;
};

/// `eta` is the index below over that above.
Saunderson saunderson(double eta, Entry entry = Entry::diffuse);

FluxLayer flux_layer(const Saunderson& surface);

/// A whole stack: layers by Kubelka and Munk, index steps by Saunderson, above, between and below
/// the layers; `entry` concerns the topmost surface only. `specular` is k1 of that surface.
/// `unscattered` is 0: two streams do not tell light that was scattered forwards from light that
/// was not scattered. Throws as `check` does.
LayerTotals kubelka_munk(const LayerStack& stack,
                         TwoStreamMapping mapping = TwoStreamMapping::diffusion,
                         Entry entry = Entry::diffuse);

}  // namespace nacre
