#include "nacre/reflectance/blinn_torrance_sparrow.h"

namespace nacre {

void bring_below_mirror(NamedNumbers& numbers) {
    double kd = 0., beta = 15., form = 0.;
    double* ks = nullptr;
    for (auto& [name, value] : numbers) {
        if (name == "kd") kd = value;
        if (name == "beta") beta = value;
        if (name == "distribution") form = value;
        if (name == "ks") ks = &value;
    }
    const FacetDistribution kind = facets_of(BlinnDistribution(int(form)));
    const double m = width_of_half_height(kind, beta * std::numbers::pi / 180);
    const double peak = facet_detail::facet_peak(kind, m, facet_detail::gauss_constant(m));
    *ks = std::min(*ks, 0.25 * (1. - kd) * peak);
}

}  // namespace nacre
