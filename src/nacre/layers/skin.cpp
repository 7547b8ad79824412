#include "nacre/layers/skin.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "nacre/math/error.h"

namespace nacre {

namespace {

struct NamedLayer {
    std::string_view name;
    const SkinLayer& layer;
};

std::array<NamedLayer, 5> layers_of(const SkinParameters& skin) {
    return {{{"stratum corneum", skin.stratum_corneum},
             {"epidermis", skin.epidermis},
             {"papillary dermis", skin.papillary_dermis},
             {"reticular dermis", skin.reticular_dermis},
             {"hypodermis", skin.hypodermis}}};
}

void demand(bool holds, std::string_view where, std::string_view name, double value,
            std::string_view range) {
    if (!holds) throw InputError(fmt::format("{}: {} = {:g} must {}", where, name, value, range));
}

bool is_fraction(double x) { return x >= 0. && x <= 1.; }

Layer make_layer(const SkinParameters& skin, const SkinLayer& layer, double reduced_scattering,
                 double nm) {
    const double g = skin_anisotropy(nm);
    const double absorption =
        layer.melanin * melanin_absorption(nm, skin.melanin_model, skin.eumelanin) +
        layer.blood * blood_absorption(nm, skin.oxygenation, skin.haemoglobin) +
        (1. - layer.melanin - layer.blood) * baseline_absorption(nm, skin.baseline_model);
    return {.sigma_s = layer.scattering * reduced_scattering / (1. - g),
            .sigma_a = absorption,
            .g = g,
            .thickness = layer.thickness,
            .eta = layer.eta};
}

double reduced_scattering(const Layer& layer) { return (1. - layer.g) * layer.sigma_s; }

// Flux over fluence at the surface: see the header.
double surface_admittance(const LayerStack& stack) {
    double below = 0.;
    for (std::size_t i = stack.layers.size(); i-- > 0;) {
        const Layer& layer = stack.layers[i];
        const double sigma_t = reduced_scattering(layer) + layer.sigma_a;
        const double y = std::sqrt(layer.sigma_a / (3. * sigma_t));
        if (i + 1 == stack.layers.size()) {
            below = y;
        } else {
            const double t = std::tanh(std::sqrt(3. * layer.sigma_a * sigma_t) * layer.thickness);
            below = y * (below + y * t) / (y + below * t);
        }
    }
    return below;
}

}  // namespace

void check(const SkinParameters& skin) {
    for (const auto& [name, layer] : layers_of(skin)) {
        demand(layer.thickness > 0., name, "thickness", layer.thickness, "be positive");
        demand(std::isfinite(layer.thickness) || &layer == &skin.hypodermis, name, "thickness",
               layer.thickness, "be finite, except in the hypodermis");
        demand(layer.eta >= 1. && layer.eta <= 2., name, "eta", layer.eta, "lie within [1, 2]");
        demand(is_fraction(layer.melanin), name, "melanin", layer.melanin, "lie within [0, 1]");
        demand(is_fraction(layer.blood), name, "blood", layer.blood, "lie within [0, 1]");
        demand(layer.melanin + layer.blood <= 1., name, "melanin + blood",
               layer.melanin + layer.blood, "be at most 1");
        demand(layer.scattering > 0. && std::isfinite(layer.scattering), name, "scattering",
               layer.scattering, "be positive and finite");
    }
    demand(is_fraction(skin.oxygenation), "skin", "oxygenation", skin.oxygenation,
           "lie within [0, 1]");
    demand(skin.haemoglobin >= 0. && std::isfinite(skin.haemoglobin), "skin", "haemoglobin",
           skin.haemoglobin, "be finite and at least 0");
    demand(is_fraction(skin.eumelanin), "skin", "eumelanin", skin.eumelanin, "lie within [0, 1]");
}

LayerStack skin_stack(const SkinParameters& skin, double nm) {
    check(skin);
    const double upper = epidermis_reduced_scattering(nm, skin.scattering_model);
    const double lower = dermis_reduced_scattering(nm, skin.scattering_model);
    return {.layers = {make_layer(skin, skin.stratum_corneum, upper, nm),
                       make_layer(skin, skin.epidermis, upper, nm),
                       make_layer(skin, skin.papillary_dermis, lower, nm),
                       make_layer(skin, skin.reticular_dermis, lower, nm),
                       make_layer(skin, skin.hypodermis, lower, nm)},
            .eta_above = 1.,
            .eta_below = skin.hypodermis.eta};
}

Layer skin_coefficients(const SkinParameters& skin, double nm) {
    const LayerStack stack = skin_stack(skin, nm);
    const Layer& dermis = stack.layers[3];
    const double y = surface_admittance(stack), absorbed = 3. * y * y;  // 1 - reduced albedo
    return {.sigma_s = dermis.sigma_s,
            .sigma_a = reduced_scattering(dermis) * absorbed / (1. - absorbed),
            .g = dermis.g,
            .thickness = std::numeric_limits<double>::infinity(),
            .eta = skin.epidermis.eta};
}

}  // namespace nacre
