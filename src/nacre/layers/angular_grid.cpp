#include "nacre/layers/angular_grid.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/quadrature.h"

namespace nacre {

double AngularNode::cosine_in(double other) const {
    if (other == eta) return cosine;
    const double scaled = eta * cosine;
    const double square = (other - eta) * (other + eta) + scaled * scaled;
    return square > 0. ? std::sqrt(square) / other : 0.;
}

std::vector<AngularNode> angular_grid(std::vector<double> indices, int nodes) {
    std::ranges::sort(indices);
    std::vector<AngularNode> grid;
    double low = 0.;
    for (const double high : indices) {
        const double widest = std::sqrt(std::max(0., 1. - (low / high) * (low / high)));
        // Equal indices, or so close that the part holds less than 1e-8 of the flux.
        if (widest < 1e-4) continue;
        const int count = std::max(nodes / 4, int(std::ceil(nodes * widest)));
        const GaussLegendre rule(static_cast<std::size_t>(count));
        for (std::size_t i = rule.node.size(); i-- > 0;) {  // p grows as the cosine falls
            const double cosine = 0.5 * widest * (1. + rule.node[i]);
            const double weight = 0.5 * widest * rule.weight[i];
            grid.push_back({high, cosine, high * high * cosine * weight});
        }
        low = high;
    }
    return grid;
}

}  // namespace nacre
