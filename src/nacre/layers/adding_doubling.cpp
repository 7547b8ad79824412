#include "nacre/layers/adding_doubling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#pragma GCC diagnostic push
// g++ 12 takes the deliberately undefined registers of its own AVX-512 headers for mistakes.
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Dense>
#pragma GCC diagnostic pop

#include "nacre/layers/angular_grid.h"
#include "nacre/layers/interfaces.h"
#include "nacre/math/error.h"
#include "nacre/optics/fresnel.h"

namespace nacre {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a part of the stack does to radiance on the nodes of the medium above it and of the one
/// below: column j of `down` reflectance is what comes back up where node j shines down on it.
struct Operator {
    MatrixXd reflect_down, reflect_up, transmit_down, transmit_up;
};

MatrixXd identity(Index n) { return MatrixXd::Identity(n, n); }

MatrixXd solve(const MatrixXd& a, const MatrixXd& b) { return a.partialPivLu().solve(b); }

/// `upper` on top of `lower`: the geometric series of reflections between the two.
Operator add(const Operator& upper, const Operator& lower) {
    const Index n = upper.reflect_up.rows();
    const MatrixXd down =
        solve(identity(n) - upper.reflect_up * lower.reflect_down, upper.transmit_down);
    const MatrixXd up =
        solve(identity(n) - lower.reflect_down * upper.reflect_up, lower.transmit_up);
    return {upper.reflect_down + upper.transmit_up * (lower.reflect_down * down),
            lower.reflect_up + lower.transmit_down * (upper.reflect_up * up),
            lower.transmit_down * down, upper.transmit_up * up};
}

/// The nodes that travel in one medium: the first `cosine.size()` of all, in order of p.
struct Medium {
    double eta;
    VectorXd cosine, weight;  // d(cosine)
};

Medium medium(const std::vector<AngularNode>& nodes, double eta, double reach) {
    Index n = 0;
    while (n < Index(nodes.size()) && nodes[std::size_t(n)].cosine_in(reach) > 0.) ++n;
    Medium m{eta, VectorXd(n), VectorXd(n)};
    for (Index i = 0; i < n; ++i) {
        const AngularNode& node = nodes[std::size_t(i)];
        m.cosine[i] = node.cosine_in(eta);
        m.weight[i] = node.weight / (eta * eta * m.cosine[i]);
    }
    return m;
}

Operator interface(const Medium& above, const Medium& below) {
    const Index n = above.cosine.size(), m = below.cosine.size();
    Operator o{identity(n), identity(m), MatrixXd::Zero(m, n), MatrixXd::Zero(n, m)};
    for (Index i = 0; i < std::min(n, m); ++i) {
        const double r = fresnel_dielectric(above.cosine[i], below.eta / above.eta);
        o.reflect_down(i, i) = o.reflect_up(i, i) = r;
        o.transmit_down(i, i) = o.transmit_up(i, i) = 1. - r;
    }
    return o;
}

Operator symmetric(const MatrixXd& r, const MatrixXd& t) { return {r, r, t, t}; }

/// (h(mu, mu') w') for two directions in the same and in opposite hemispheres: the azimuthal mean
/// of the phase function, sum over l of (2 l + 1) chi_l P_l(mu) P_l(mu'), from the moments chi_l.
struct PhaseMatrices {
    MatrixXd same, opposite;
};

PhaseMatrices phase_matrices(const Medium& m, const VectorXd& chi) {
    const Index n = m.cosine.size(), moments = chi.size();
    MatrixXd p(moments, n);
    p.row(0).setOnes();
    if (moments > 1) p.row(1) = m.cosine.transpose();
    for (Index l = 1; l + 1 < moments; ++l) {
        const double k = double(l);
        p.row(l + 1) = ((2. * k + 1.) * m.cosine.transpose().array() * p.row(l).array() -
                        k * p.row(l - 1).array()) /
                       (k + 1.);
    }
    VectorXd even = chi, odd = chi;
    for (Index l = 0; l < moments; ++l) (l % 2 ? even : odd)[l] = 0.;
    const VectorXd factor = VectorXd::LinSpaced(moments, 1., 2. * double(moments) - 1.);
    const MatrixXd a = p.transpose() * even.cwiseProduct(factor).asDiagonal() * p;
    const MatrixXd b = p.transpose() * odd.cwiseProduct(factor).asDiagonal() * p;
    PhaseMatrices h{(a + b) * m.weight.asDiagonal(), (a - b) * m.weight.asDiagonal()};
    // What the quadrature makes of the integral of the phase function differs from 1 by its error:
    // the forward direction takes the difference, so that no energy is made or lost.
    h.same.diagonal() += 2. * VectorXd::Ones(n) - (h.same + h.opposite).rowwise().sum();
    return h;
}

/// A homogeneous scattering layer.
Operator scattering_layer(const Layer& layer, const Medium& m, int moments) {
    const Index n = m.cosine.size();
    // Delta-M: the share f of the phase function is a forward peak, and no scattering at all.
    const double g = layer.g, f = std::pow(g, moments), albedo = layer.albedo();
    const double a = albedo * (1. - f) / (1. - albedo * f);
    const double tau = (1. - albedo * f) * layer.optical_thickness();
    VectorXd chi(moments);
    for (int l = 0; l < moments; ++l) chi[l] = (std::pow(g, l) - f) / (1. - f);
    const PhaseMatrices h = phase_matrices(m, chi);

    // With u = down + up and v = down - up, du/dt = -x v, dv/dt = -y u.
    const auto rate = m.cosine.cwiseInverse().asDiagonal();
    const MatrixXd x = rate * (identity(n) - 0.5 * a * (h.same - h.opposite));
    const MatrixXd y = rate * (identity(n) - 0.5 * a * (h.same + h.opposite));

    // A slice so thin that the power series below converge to rounding with the last term.
    const double thin = 0.5 * m.cosine.minCoeff();
    double t = tau;
    int doublings = 0;
    if (std::isinf(tau)) t = thin;
    for (; t > thin; t *= 0.5) ++doublings;
    // z = x y t^2; cu = cosh(sqrt(z)) - 1, su = sinh(sqrt(z)) / sqrt(z) x t; cv and sv are the same
    // of y x, which y (x y)^k x = (y x)^(k + 1) gives without further series.
    const MatrixXd z = t * t * x * y;
    const auto series = [&](double first) {
        // sum over k >= 0 of z^k first! / (first + 2 k)!, by Horner's rule
        MatrixXd sum = identity(n);
        for (int k = 8; k > 0; --k)
            sum = identity(n) + z * sum / ((first + 2. * k) * (first + 2. * k - 1.));
        return sum;
    };
    const MatrixXd sinh = t * series(1.), cosh = 0.5 * series(2.);
    const MatrixXd cu = z * cosh, cv = t * t * y * (cosh * x);
    const MatrixXd su = sinh * x, sv = y * sinh;
    // up and down at the bottom of the slice by those at its top
    const MatrixXd to_down = 0.5 * (cu + cv - su - sv), to_up = 0.5 * (cv - cu + su - sv);
    MatrixXd r = solve(identity(n) + 0.5 * (cu + cv + su + sv), to_up);
    // t - 1 in place of t as long as the layer is thin: no digit of a weak absorption gets lost.
    MatrixXd s = to_down + 0.5 * (cu - cv + su - sv) * r;
    MatrixXd transmit;
    const auto twice = [&] {
        if (s.size() > 0) transmit = identity(n) + s;
        const MatrixXd rt = r * transmit;
        const MatrixXd between = solve(identity(n) - r * r, rt);
        const MatrixXd turned = r * between;
        r += transmit * between;
        t *= 2.;
        if (s.size() > 0 && t < 0.1)
            s += transmit * (s + turned);
        else {
            transmit = transmit * (transmit + turned);
            s.resize(0, 0);
        }
    };
    if (std::isfinite(tau)) {
        for (; doublings > 0; --doublings) twice();
        return symmetric(r, s.size() > 0 ? MatrixXd(identity(n) + s) : transmit);
    }
    // A half space: until nothing gets through. Without absorption that never happens, but then
    // reflectance misses by what is transmitted (van de Hulst 1980, the diffusion domain).
    MatrixXd last = MatrixXd::Zero(n, n);
    for (int k = 0; k < 100; ++k) {
        twice();
        if (s.size() > 0) continue;
        if (layer.sigma_a > 0.) {
            if (transmit.cwiseAbs().maxCoeff() < 1e-17) break;
        } else {
            const MatrixXd all = r + transmit;
            const bool done = (all - last).cwiseAbs().maxCoeff() < 1e-14;
            last = all;
            if (done) break;
        }
    }
    if (layer.sigma_a == 0.) r = last;
    return symmetric(r, MatrixXd::Zero(n, n));
}

/// The layer between its interfaces: scattering, or only a filter.
Operator layer_operator(const Layer& layer, const Medium& m, int moments) {
    if (layer.sigma_s > 0.) return scattering_layer(layer, m, moments);
    const Index n = m.cosine.size();
    const VectorXd t = (-layer.optical_thickness() / m.cosine.array()).exp();
    return symmetric(MatrixXd::Zero(n, n), t.asDiagonal());
}

/// How far in p light gets into each medium: up to its index where there is scattering, or light
/// from outside; else up to what the neighbours send. What only interfaces could trap has no nodes.
std::vector<double> reach(const LayerStack& stack, const std::vector<double>& eta) {
    const std::size_t n = eta.size();
    const auto source = [&](std::size_t k) {
        return k == 0 || k + 1 == n || stack.layers[k - 1].sigma_s > 0.;
    };
    std::vector<double> from_above(eta), from_below(eta), r(n);
    for (std::size_t k = 1; k < n; ++k)
        if (!source(k)) from_above[k] = std::min(eta[k], from_above[k - 1]);
    for (std::size_t k = n - 1; k-- > 0;)
        if (!source(k)) from_below[k] = std::min(eta[k], from_below[k + 1]);
    for (std::size_t k = 0; k < n; ++k) r[k] = std::max(from_above[k], from_below[k]);
    return r;
}

void check_cosines(std::span<const double> cosines, const char* which) {
    for (const double c : cosines)
        if (!(c > 0. && c <= 1.))
            throw InputError(
                fmt::format("the {} cosine {:g} must be above 0 and at most 1", which, c));
}

}  // namespace

int adding_doubling_nodes(const LayerStack& stack, double accuracy) {
    double g = 0.;
    for (const Layer& l : stack.layers)
        if (l.sigma_s > 0.) g = std::max(g, std::abs(l.g));
    if (g == 0.) return 24;
    // Measured: the error of totals is 0.001 to 0.003 times |g|^nodes.
    const double n = std::log(accuracy / 0.003) / std::log(g);
    return int(std::clamp(std::ceil(n), 24., 256.));
}

AddingDoublingResult adding_doubling(const LayerStack& stack, std::span<const double> incident,
                                     std::span<const double> outgoing,
                                     const AddingDoublingOptions& options) {
    check(stack);
    check_cosines(incident, "incident");
    check_cosines(outgoing, "outgoing");
    if (!(options.accuracy >= 1e-9 && options.accuracy <= 0.01))
        throw InputError(fmt::format("accuracy {:g} must be from 1e-9 to 0.01", options.accuracy));
    if (options.nodes != 0 && (options.nodes < 4 || options.nodes > 512))
        throw InputError(
            fmt::format("{} quadrature nodes: must be from 4 to 512, or 0 for the "
                        "default",
                        options.nodes));
    const int moments =
        options.nodes ? options.nodes : adding_doubling_nodes(stack, options.accuracy);

    const std::vector<double> eta = media_indices(stack);
    // Wanted directions are nodes without weight, which neither disturb the others nor meet
    // themselves: one for each purpose, even if they are equal.
    constexpr double no_weight = 1e-30;
    std::vector<AngularNode> nodes = angular_grid(eta, moments);
    const auto ask = [&](std::span<const double> cosines, double index) {
        for (const double c : cosines) nodes.push_back({index, c, no_weight});
    };
    ask(incident, eta.front());
    ask(outgoing, eta.front());
    ask(outgoing, eta.back());
    const std::size_t regular = nodes.size() - incident.size() - 2 * outgoing.size();
    std::vector<std::size_t> order(nodes.size()), place(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return nodes[i].invariant2(); });
    std::vector<AngularNode> sorted;
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        sorted.push_back(nodes[order[i]]);
    }

    const std::vector<double> reached = reach(stack, eta);
    std::vector<Medium> media;
    for (std::size_t k = 0; k < eta.size(); ++k)
        media.push_back(medium(sorted, eta[k], reached[k]));
    Operator all = interface(media[0], media[1]);
    for (std::size_t k = 1; k + 1 < eta.size(); ++k) {
        all = add(all, layer_operator(stack.layers[k - 1], media[k], moments));
        all = add(all, interface(media[k], media[k + 1]));
    }

    const auto flux = [&](const VectorXd& radiance) {
        double sum = 0.;
        for (Index i = 0; i < radiance.size(); ++i)
            sum += sorted[std::size_t(i)].weight * radiance[i];
        return sum;
    };
    AddingDoublingResult result;
    // Light on the nodes of weight `in`.
    const auto totals = [&](const VectorXd& in) {
        const double power = flux(in);
        LayerTotals t;
        t.reflectance = flux(all.reflect_down * in) / power;
        t.transmittance = flux(all.transmit_down * in) / power;
        t.absorptance = 1. - t.reflectance - t.transmittance;
        for (Index i = 0; i < in.size(); ++i) {
            if (in[i] == 0.) continue;
            const AngularNode& node = sorted[std::size_t(i)];
            const double share = node.weight * in[i] / power;
            const UnscatteredLight u = unscattered_light(stack, node.cosine_in(eta[0]));
            t.specular += share * u.specular;
            t.unscattered += share * u.transmittance;
        }
        return t;
    };
    const Index above = media.front().cosine.size();
    for (std::size_t i = 0; i < incident.size(); ++i)
        result.collimated.push_back(totals(VectorXd::Unit(above, Index(place[regular + i]))));
    VectorXd uniform = VectorXd::Ones(above);
    for (std::size_t i = regular; i < nodes.size(); ++i)
        if (Index(place[i]) < above) uniform[Index(place[i])] = 0.;
    result.diffuse = totals(uniform);

    const auto distribution = [&](const MatrixXd& m, double index, std::size_t first) {
        std::vector<double> values;
        const double unit = index * index / (2. * std::numbers::pi * no_weight);
        for (std::size_t i = 0; i < incident.size(); ++i)
            for (std::size_t o = 0; o < outgoing.size(); ++o) {
                const Index in = Index(place[regular + i]), out = Index(place[first + o]);
                values.push_back(in < m.cols() && out < m.rows() ? unit * m(out, in) : 0.);
            }
        return values;
    };
    const std::size_t reflected = regular + incident.size();
    result.brdf = distribution(all.reflect_down, eta.front(), reflected);
    result.btdf = distribution(all.transmit_down, eta.back(), reflected + outgoing.size());
    return result;
}

}  // namespace nacre
