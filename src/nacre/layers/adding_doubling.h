#pragma once
// Adding and doubling: reflectance and transmittance of a stack of layers, exact but for a
// quadrature over the direction cosine.
// H. C. van de Hulst 1980, Multiple Light Scattering; S. A. Prahl, M. J. C. van Gemert, A. J. Welch
// 1993, Determining the optical properties of turbid media by using the adding-doubling method,
// Applied Optics 32(4).
//
// Light is unpolarised, its azimuth averaged. Every medium from the one above to the one below may
// have its own index of refraction: interfaces reflect by Fresnel and refract by Snell. The peak of
// the phase function that the quadrature cannot resolve counts as unscattered (delta-M; W. J.
// Wiscombe 1977).
#include <span>
#include <vector>

#include "nacre/layers/layer.h"

namespace nacre {

struct AddingDoublingOptions {
    /// Wanted error of the totals, from 1e-9 to 0.01; decides the number of nodes.
    double accuracy = 1e-4;
    /// Quadrature nodes over the hemisphere of a medium, and moments of the phase function, from 4
    /// to 512; 0 takes `adding_doubling_nodes`. The work grows with the cube.
    int nodes = 0;
};

/// The number of nodes that reaches `accuracy`: 24 or, for narrow phase functions, more (at 1e-6 36
/// for g = 0.8, 76 for g = 0.9, 157 for g = 0.95), up to 256.
int adding_doubling_nodes(const LayerStack& stack, double accuracy = 1e-4);

struct AddingDoublingResult {
    /// A collimated beam at each of the incident cosines.
    std::vector<LayerTotals> collimated;
    /// Diffuse light, the same radiance from every direction above. The radiance that it gives to
    /// direction o, over that of a white diffuser, is the reflectance of a beam from o.
    LayerTotals diffuse;
    /// Scattered light in sr^-1 without the cosine, averaged over azimuth, at [i * outgoing.size()
    /// + o]: radiance reflected or transmitted to outgoing cosine o over the irradiance from
    /// incident cosine i. Light that only interfaces have turned is left out.
    std::vector<double> brdf, btdf;
};

/// Cosines are those outside, in (0, 1]: the incident in the medium above, the outgoing in the one
/// above (brdf) and the one below (btdf). An infinitely thick clear last layer is the medium below.
///
/// Totals conserve energy to rounding for any number of nodes; their error is below `accuracy` on
/// slabs with published values, where |g| <= 0.9. Distributions are less accurate near the forward
/// direction, where the peak that delta-M cuts off is missing. Half spaces hold to 1e-8 for albedos
/// up to 1 - 1e-15, and at 1. Throws InputError for a stack that `check` refuses and for cosines or
/// nodes out of range.
AddingDoublingResult adding_doubling(const LayerStack& stack, std::span<const double> incident,
                                     std::span<const double> outgoing = {},
                                     const AddingDoublingOptions& options = {});

}  // namespace nacre
