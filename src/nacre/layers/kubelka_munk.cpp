#include "nacre/layers/kubelka_munk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nacre/math/error.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

namespace {

void demand(bool holds, std::string_view name, double value, std::string_view range) {
    if (!holds)
        throw InputError(fmt::format("Kubelka-Munk: {} = {:g} must be {}", name, value, range));
}

void check(const TwoStream& matter) {
    for (const auto& [name, value] : {std::pair{"S", matter.S}, {"K", matter.K}})
        demand(value >= 0. && std::isfinite(value), name, value, "finite and at least 0");
}

// b S = sqrt(K (K + 2 S)), the rate at which the streams decay.
double decay(const TwoStream& m) { return std::sqrt(m.K) * std::sqrt(m.K + 2. * m.S); }

}  // namespace

TwoStream two_stream(double sigma_s, double sigma_a, double g, TwoStreamMapping mapping) {
    const double reduced = sigma_s * (1. - g);
    switch (mapping) {
        case TwoStreamMapping::diffusion:
            return {std::max(0., 0.75 * reduced - 0.25 * sigma_a), 2. * sigma_a};
        case TwoStreamMapping::reduced:
            return {reduced, 2. * sigma_a};
        case TwoStreamMapping::plain:
            break;
    }
    return {sigma_s, sigma_a};
}

double kubelka_munk_infinite(const TwoStream& m) {
    check(m);
    return m.S > 0. ? m.S / (m.S + m.K + decay(m)) : 0.;
}

KubelkaMunkLayer kubelka_munk(const TwoStream& m, double d) {
    check(m);
    demand(d >= 0., "the thickness", d, "at least 0");
    if (m.S == 0. && m.K == 0.) return {0., 1., 0.};
    if (std::isinf(d)) {
        const double r = kubelka_munk_infinite(m);
        return {r, 0., 1. - r};
    }
    // Numerators and denominator times 2 exp(-t) / (b S), so that nothing overflows, divides by a
    // vanishing b or S, or cancels; A by its own sum, for the same reason:
    //   w = (1 - exp(-2 t)) / t, D = (S + K) d w + 1 + exp(-2 t),
    //   R = S d w / D,  T = 2 exp(-t) / D,  A = (K d w + (1 - exp(-t))^2) / D.
    const double t = decay(m) * d;
    const double w = t > 0. ? -std::expm1(-2. * t) / t : 2.;
    const double lost = -std::expm1(-t);
    const double denominator = (m.S + m.K) * d * w + 1. + std::exp(-2. * t);
    return {m.S * d * w / denominator, 2. * std::exp(-t) / denominator,
            (m.K * d * w + lost * lost) / denominator};
}

FluxLayer flux_layer(const KubelkaMunkLayer& l) {
    return {l.reflectance, l.reflectance, l.transmittance, l.transmittance};
}

FluxLayer stacked(const FluxLayer& upper, const FluxLayer& lower) {
    const double escaping = 1. - upper.reflectance_below * lower.reflectance_above;
    // Between two perfect mirrors there is no light, since none could come in.
    if (!(escaping > 0.)) return {upper.reflectance_above, lower.reflectance_below, 0., 0.};
    return {upper.reflectance_above + upper.transmittance_down * upper.transmittance_up *
                                          lower.reflectance_above / escaping,
            lower.reflectance_below + lower.transmittance_up * lower.transmittance_down *
                                          upper.reflectance_below / escaping,
            upper.transmittance_down * lower.transmittance_down / escaping,
            upper.transmittance_up * lower.transmittance_up / escaping};
}

double over_backing(const FluxLayer& layer, double backing) {
    demand(backing >= 0. && backing <= 1., "the backing's reflectance", backing, "within [0, 1]");
    return stacked(layer, {backing, backing, 0., 0.}).reflectance_above;
}

double Saunderson::over(double reflectance) const {
    return over_backing(flux_layer(*this), reflectance);
}

Saunderson saunderson(double eta, Entry entry) {
    demand(eta > 0. && std::isfinite(eta), "the index ratio", eta, "positive and finite");
    return {entry == Entry::normal ? normal_reflectance(eta) : diffuse_reflectance_external(eta),
            diffuse_reflectance_internal(eta)};
}

FluxLayer flux_layer(const Saunderson& s) { return {s.k1, s.k2, 1. - s.k1, 1. - s.k2}; }

LayerTotals kubelka_munk(const LayerStack& stack, TwoStreamMapping mapping, Entry entry) {
    check(stack);
    const Saunderson top = saunderson(stack.layers.front().eta / stack.eta_above, entry);
    FluxLayer all = flux_layer(top);
    for (std::size_t i = 0; i < stack.layers.size(); ++i) {
        const Layer& l = stack.layers[i];
        const TwoStream matter = two_stream(l.sigma_s, l.sigma_a, l.g, mapping);
        all = stacked(all, flux_layer(kubelka_munk(matter, l.thickness)));
        const double below =
            i + 1 < stack.layers.size() ? stack.layers[i + 1].eta : stack.eta_below;
        all = stacked(all, flux_layer(saunderson(below / l.eta)));
    }
    return {.reflectance = all.reflectance_above,
            .transmittance = all.transmittance_down,
            .absorptance = 1. - all.reflectance_above - all.transmittance_down,
            .specular = top.k1};
}

}  // namespace nacre
