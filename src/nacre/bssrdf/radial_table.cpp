#include "nacre/bssrdf/radial_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "nacre/bssrdf/radial_integral.h"
#include "nacre/math/error.h"
#include "nacre/math/lanes_math.h"

namespace nacre {

namespace {

constexpr double pi = std::numbers::pi;

// A float has 23 bits of mantissa; three of them number the parts of an octave.
constexpr int shift = 20;
constexpr std::size_t parts = 8;

constexpr double nearest = 1e-4, farthest = 1e4, negligible = 1e-6;
// Stands for ln 0: e^-200 is 0 as a float.
constexpr double log_of_nothing = -200.;

float lane(float v, int) { return v; }
float lane(Spectral v, int c) { return v[c]; }
void set_lane(float& v, int, double value) { v = float(value); }
void set_lane(Spectral& v, int c, double value) { v.set(c, float(value)); }

// What is left of a part of linear density from a to b, at fraction t: its share and its density
// over the mean.
template <class V>
V share_of_linear(V a, V b, float t) {
    const V sum = a + b;
    const auto some = sum > V(0.f);
    const V safe = select(some, sum, V(1.f));
    return select(some, V(V(t) * (a + a + (b - a) * V(t)) / safe), V(t));
}
template <class V>
V linear_over_mean(V a, V b, float t) {
    const V sum = a + b;
    const auto some = sum > V(0.f);
    const V safe = select(some, sum, V(1.f));
    return select(some, V(V(2.f) * (a + (b - a) * V(t)) / safe), V(1.f));
}

double log_value(const RadialProfile& profile, double x) {
    const double r = profile.eval(std::sqrt(x));
    return r > 0. ? std::max(std::log(r), log_of_nothing) : log_of_nothing;
}

// Slope of ln R over x, times x, by a central difference: 1e-4 balances its two errors, the
// profile's own noise and curvature.
double log_slope(const RadialProfile& profile, double x) {
    constexpr double h = 1e-4;
    return (log_value(profile, x * (1. + h)) - log_value(profile, x * (1. - h))) / (2. * h);
}

// Where the table of a profile may end: the light that an octave of x adds has become negligible.
double end_of(const RadialProfile& profile, double begin) {
    const double scale2 = profile.scale() * profile.scale();
    const auto value = [&](double r) { return profile.eval(r); };
    double sum = profile.cumulative(std::sqrt(begin)), x = begin;
    while (x < farthest * farthest * scale2) {
        const double added = ring_integral(std::sqrt(x), std::sqrt(2. * x), value);
        sum += added;
        x *= 2.;
        if (x > scale2 && added <= negligible * sum) break;
    }
    return x;
}

}  // namespace

template <class V>
BasicRadialTable<V>::BasicRadialTable(std::span<const RadialProfile* const> profiles) {
    if (profiles.empty() || profiles.size() > std::size_t(channels))
        throw InputError(fmt::format("a table of {} channel{} cannot hold {} profiles", channels,
                                     channels == 1 ? "" : "s", profiles.size()));
    double scale = profiles[0]->scale();
    for (const RadialProfile* p : profiles) scale = std::min(scale, p->scale());
    const double begin = std::exp2(std::floor(2. * std::log2(nearest * scale)));
    double end = begin;
    for (const RadialProfile* p : profiles) end = std::max(end, end_of(*p, begin));

    begin_ = float(begin);
    end_ = float(end);
    first_ = std::bit_cast<std::uint32_t>(begin_);
    nodes_.resize(((std::bit_cast<std::uint32_t>(end_) - first_) >> shift) + 1);
    for (Node& n : nodes_)
        for (V& c : n.cubic) c = V(0.f);
    for (Node& n : nodes_) n.cubic[0] = V(float(log_of_nothing));
    for (int c = 0; c < int(profiles.size()); ++c) fill(*profiles[std::size_t(c)], c);
}

template <class V>
float BasicRadialTable<V>::position(std::size_t node) const {
    return std::bit_cast<float>(first_ + (std::uint32_t(node) << shift));
}

template <class V>
void BasicRadialTable<V>::fill(const RadialProfile& profile, int channel) {
    static const GaussLegendre rule(4);
    double within = profile.cumulative(std::sqrt(double(begin_)));
    double x = begin_, value = log_value(profile, x), slope = log_slope(profile, x);
    for (std::size_t i = 0;; ++i) {
        Node& n = nodes_[i];
        set_lane(n.value, channel, std::exp(value));
        set_lane(n.within, channel, within);
        if (i + 1 == nodes_.size()) break;
        const double next = position(i + 1), width = next - x;
        const double next_value = log_value(profile, next);
        const double next_slope = log_slope(profile, next);
        // Hermite's cubic in powers of t.
        const double rise = next_value - value, m0 = slope * width / x,
                     m1 = next_slope * width / next;
        const double cubic[4] = {value, m0, 3. * rise - 2. * m0 - m1, m0 + m1 - 2. * rise};
        for (int k = 0; k < 4; ++k) set_lane(n.cubic[k], channel, cubic[k]);
        within +=
            pi * rule.integrate(x, next, [&](double y) { return profile.eval(std::sqrt(y)); });
        x = next, value = next_value, slope = next_slope;
    }
}

template <class V>
auto BasicRadialTable<V>::find(float x) const -> Place {
    const std::uint32_t offset = std::bit_cast<std::uint32_t>(x) - first_;
    return {offset >> shift, float(offset & ((1u << shift) - 1u)) * (1.f / float(1u << shift))};
}

template <class V>
V BasicRadialTable<V>::eval(float r2) const {
    using std::exp;
    if (!(r2 < end_)) return V(0.f);
    const auto [part, t] = find(std::max(r2, begin_));
    const Node& n = nodes_[part];
    const V s(t);
    return exp(V(n.cubic[0] + s * (n.cubic[1] + s * (n.cubic[2] + s * n.cubic[3]))));
}

template <class V>
V BasicRadialTable<V>::cumulative(float r2) const {
    if (!(r2 < end_)) return total();
    if (r2 < begin_) return nodes_.front().within * V(r2 / begin_);
    const auto [part, t] = find(r2);
    const Node &a = nodes_[part], &b = nodes_[part + 1];
    return a.within + (b.within - a.within) * share_of_linear(a.value, b.value, t);
}

template <class V>
V BasicRadialTable<V>::pdf(float r2) const {
    if (!(r2 < end_)) return V(0.f);
    const auto lit = total() > V(0.f);
    const V over_total = V(float(1. / pi)) / select(lit, total(), V(1.f));
    if (r2 < begin_) return nodes_.front().within * over_total / V(begin_);
    const auto [part, t] = find(r2);
    const Node &a = nodes_[part], &b = nodes_[part + 1];
    return (b.within - a.within) * over_total * linear_over_mean(a.value, b.value, t) /
           V(position(part + 1) - position(part));
}

template <class V>
float BasicRadialTable<V>::sample(float u, int channel) const {
    const float target = u * lane(total(), channel);
    const auto above = std::partition_point(nodes_.begin(), nodes_.end(), [&](const Node& n) {
        return lane(n.within, channel) <= target;
    });
    if (above == nodes_.begin()) {
        const float inner = lane(nodes_.front().within, channel);
        return std::sqrt(begin_ * (target / inner));
    }
    if (above == nodes_.end()) return lane(total(), channel) > 0.f ? std::sqrt(end_) : 0.f;
    const std::size_t part = std::size_t(above - nodes_.begin()) - 1;
    const Node &from = nodes_[part], &to = nodes_[part + 1];
    const float low = lane(from.within, channel);
    const float share = (target - low) / (lane(to.within, channel) - low);
    // Inverse of share_of_linear, in the form that loses no digits for equal ends.
    const float a = lane(from.value, channel), b = lane(to.value, channel);
    const float root = a + std::sqrt(a * a + share * (b * b - a * a));
    const float t = root > 0.f ? share * (a + b) / root : share;
    const float x = position(part);
    return std::sqrt(x + t * (position(part + 1) - x));
}

template class BasicRadialTable<float>;
template class BasicRadialTable<Spectral>;

}  // namespace nacre
