#include "nacre/layers/hanrahan_krueger.h"

#include "nacre/math/quadrature.h"

namespace nacre {

namespace {

/// Mean over the azimuth of Henyey and Greenstein's function of s_i s_o cos(phi) + m, by
/// integral of (a + b cos)^(-3/2) over a turn = 4 E(k) / ((a - b) sqrt(a + b)), k^2 = 2 b / (a +
/// b).
double azimuthal_mean(double g, double m, double sines) {
    const double a = 1. + g * g - 2. * g * m, b = 2. * std::abs(g) * sines;
    const double k = std::sqrt(std::clamp(2. * b / (a + b), 0., 1.));
    return (1. - g * g) * std::comp_ellint_2(k) /
           (2. * std::numbers::pi * std::numbers::pi * (a - b) * std::sqrt(a + b));
}

/// Fresnel's reflectance, without the rounding of its formula where there is no boundary.
double mirrored(double cosine, double eta) {
    return eta == 1. ? 0. : fresnel_dielectric(cosine, eta);
}

double sine_of(double cosine) { return std::sqrt(std::max(0., 1. - cosine * cosine)); }

/// Integral from a to b on panels that shrink towards a, where f may bend as a root does.
template <class F>
double integrate_from(double a, double b, F&& f) {
    static const GaussLegendre rule(16);
    double sum = 0., far = b - a;
    for (int panel = 0; panel < 15; ++panel, far *= 0.2)
        sum += rule.integrate(a + 0.2 * far, a + far, f);
    return sum + rule.integrate(a, a + far, f);
}

}  // namespace

/// A beam on its way into the stack: for each layer its cosine there and the share of radiance, up
/// to the factor n^2, that reaches the layer's face.
struct HanrahanKruegerStack::Beam {
    std::vector<double> cosine, reaches;
    double passes = 1.;  ///< what leaves on the far side
};

HanrahanKruegerStack::HanrahanKruegerStack(LayerStack stack) : stack_(std::move(stack)) {
    check(stack_);
}

/// `momentum` is n sin(theta), the same in every layer.
HanrahanKruegerStack::Beam HanrahanKruegerStack::enter(double momentum, bool above) const {
    const auto& layers = stack_.layers;
    Beam beam{std::vector<double>(layers.size(), 1.), std::vector<double>(layers.size(), 0.)};
    double eta = above ? stack_.eta_above : stack_.eta_below, power = 1.;
    const auto cross = [&](double next) {
        const double sine = momentum / eta;
        power *= 1. - mirrored(std::sqrt(std::max(0., 1. - sine * sine)), next / eta);
        eta = next;
    };
    for (std::size_t step = 0; step < layers.size() && power > 0.; ++step) {
        const std::size_t k = above ? step : layers.size() - 1 - step;
        cross(layers[k].eta);
        if (!(power > 0.)) break;
        beam.cosine[k] = std::sqrt(std::max(0., 1. - momentum * momentum / (eta * eta)));
        beam.reaches[k] = power;
        if (layers[k].optical_thickness() > 0.)
            power *= std::exp(-layers[k].optical_thickness() / beam.cosine[k]);
    }
    if (power > 0.) cross(above ? stack_.eta_below : stack_.eta_above);
    beam.passes = power;
    return beam;
}

/// `phase(layer, m_i m_o with the sign of the turn, s_i s_o)` is the layer's phase function.
template <class P>
double HanrahanKruegerStack::sum(const Beam& i, const Beam& o, bool same, double eta_out,
                                 P&& phase) const {
    double f = 0.;
    for (std::size_t k = 0; k < stack_.layers.size(); ++k) {
        const Layer& l = stack_.layers[k];
        const double reaches = i.reaches[k] * o.reaches[k];
        if (!(reaches > 0.) || !(l.sigma_s > 0.)) continue;
        const double mi = i.cosine[k], mo = o.cosine[k], ratio = eta_out / l.eta;
        f += reaches * ratio * ratio * l.albedo() *
             single_scattering(mi, mo, l.optical_thickness(), same ? 1. : 0.) *
             phase(l, same ? -mi * mo : mi * mo, sine_of(mi) * sine_of(mo));
    }
    return f;
}

double HanrahanKruegerStack::eval(const Vec3d& wi, const Vec3d& wo) const {
    if (wi.z == 0. || wo.z == 0.) return 0.;
    const bool from_above = wi.z > 0., to_above = wo.z > 0.;
    const double eta_i = from_above ? stack_.eta_above : stack_.eta_below;
    const double eta_o = to_above ? stack_.eta_above : stack_.eta_below;
    const double sine_i = std::hypot(wi.x, wi.y), sine_o = std::hypot(wo.x, wo.y);
    const double sines = sine_i * sine_o;
    // Both directions point away from the stack, so light that keeps its azimuth has opposite ones.
    const double turn = sines > 0. ? -(wi.x * wo.x + wi.y * wo.y) / sines : 0.;
    return sum(
        enter(eta_i * sine_i, from_above), enter(eta_o * sine_o, to_above), from_above == to_above,
        eta_o, [=](const Layer& l, double m, double s) {
            return HenyeyGreensteinPhase<double>{l.g}.eval(std::clamp(m + s * turn, -1., 1.));
        });
}

/// Integral of f cos over all directions above or below, for a beam from above.
double HanrahanKruegerStack::scattered(const Beam& i, double momentum, bool above) const {
    const double eta = above ? stack_.eta_above : stack_.eta_below;
    // Where the integrand bends or peaks: grazing and normal directions, critical angles of rarer
    // layers, the cosine of the beam itself.
    std::vector<double> bends{0., 1.};
    const auto add = [&](double n) {
        if (n < eta) bends.push_back(sine_of(n / eta));
    };
    for (const Layer& l : stack_.layers) add(l.eta);
    add(above ? stack_.eta_below : stack_.eta_above);
    add(momentum);
    std::sort(bends.begin(), bends.end());

    const auto flux = [&](double cosine) {
        const Beam o = enter(eta * sine_of(cosine), above);
        return cosine * sum(i, o, above, eta, [](const Layer& l, double m, double s) {
                   return azimuthal_mean(l.g, m, s);
               });
    };
    double total = 0.;
    for (std::size_t k = 1; k < bends.size(); ++k) {
        const double low = bends[k - 1], high = bends[k], middle = 0.5 * (low + high);
        if (high - low > 1e-14)
            total += integrate_from(low, middle, flux) - integrate_from(high, middle, flux);
    }
    return 2. * std::numbers::pi * total;
}

LayerTotals HanrahanKruegerStack::totals(double cosine) const {
    const double momentum = stack_.eta_above * sine_of(cosine);
    const Beam i = enter(momentum, true);
    LayerTotals t;
    t.specular = mirrored(cosine, stack_.layers.front().eta / stack_.eta_above);
    t.unscattered = i.passes;
    t.reflectance = t.specular + scattered(i, momentum, true);
    t.transmittance = t.unscattered + scattered(i, momentum, false);
    t.absorptance = 1. - t.reflectance - t.transmittance;
    return t;
}

}  // namespace nacre
