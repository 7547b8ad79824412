#include "nacre/layers/interfaces.h"

#include <cmath>

#include "nacre/layers/angular_grid.h"
#include "nacre/optics/fresnel.h"

namespace nacre {

std::vector<double> media_indices(const LayerStack& stack) {
    std::vector<double> eta{stack.eta_above};
    for (const Layer& l : stack.layers) eta.push_back(l.eta);
    const Layer& last = stack.layers.back();
    const bool endless = std::isinf(last.thickness) && last.sigma_t() == 0.;
    eta.push_back(endless ? last.eta : stack.eta_below);
    return eta;
}

UnscatteredLight unscattered_light(const LayerStack& stack, double cosine) {
    const std::vector<double> eta = media_indices(stack);
    const AngularNode beam{stack.eta_above, cosine};
    // From the bottom: what lies below interface k, between media k and k + 1, does to light there.
    UnscatteredLight u{0., 0., 1.};
    for (std::size_t k = eta.size() - 1; k-- > 0;) {
        const double c = beam.cosine_in(eta[k]);
        u.specular = c > 0. ? fresnel_dielectric(c, eta[k + 1] / eta[k]) : 1.;
        if (u.specular == 1.) {
            u = {1., 1., 0.};
        } else {
            const double series = (1. - u.specular) / (1. - u.specular * u.reflectance);
            u.reflectance = u.specular + (1. - u.specular) * series * u.reflectance;
            u.transmittance *= series;
        }
        if (k == 0 || c == 0.) continue;
        const double e = std::exp(-stack.layers[k - 1].optical_thickness() / c);
        u.reflectance *= e * e;
        u.transmittance *= e;
    }
    return u;
}

}  // namespace nacre
