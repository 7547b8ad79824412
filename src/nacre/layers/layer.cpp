#include "nacre/layers/layer.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "nacre/math/error.h"

namespace nacre {

void check(const LayerStack& stack) {
    if (stack.layers.empty()) throw InputError("a stack needs at least one layer");
    for (std::size_t i = 0; i < stack.layers.size(); ++i) {
        const Layer& l = stack.layers[i];
        const auto demand = [&](bool holds, std::string_view name, double value,
                                std::string_view range) {
            if (!holds)
                throw InputError(
                    fmt::format("layer {}: {} = {:g} must be {}", i + 1, name, value, range));
        };
        demand(l.sigma_s >= 0. && std::isfinite(l.sigma_s), "sigma_s", l.sigma_s,
               "finite and at least 0");
        demand(l.sigma_a >= 0. && std::isfinite(l.sigma_a), "sigma_a", l.sigma_a,
               "finite and at least 0");
        demand(l.g > -1. && l.g < 1., "g", l.g, "between -1 and 1");
        demand(l.thickness > 0., "thickness", l.thickness, "positive");
        demand(std::isfinite(l.thickness) || i + 1 == stack.layers.size(), "thickness", l.thickness,
               "finite, except in the last layer");
        demand(l.eta > 0. && std::isfinite(l.eta), "eta", l.eta, "positive and finite");
    }
    for (const auto& [name, eta] :
         {std::pair{"above", stack.eta_above}, {"below", stack.eta_below}})
        if (!(eta > 0.) || !std::isfinite(eta))
            throw InputError(
                fmt::format("the index of refraction {} the layers is {:g}; it must be positive "
                            "and finite",
                            name, eta));
}

}  // namespace nacre
