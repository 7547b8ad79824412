#include "nacre/measured/rgl_brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/measured/half_vector_square.h"

namespace nacre {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

}  // namespace

/// A given direction, turned into the measured range, and where its slices are.
struct RglBrdf::Given {
    Vec3f w;
    float sign_x = 1.f, sign_y = 1.f;  ///< turn the other one alike
    float theta = 0.f, phi = 0.f;
    SliceMix mix;
};

/// A half vector on the unit square.
struct RglBrdf::Half {
    float x, y, sin_theta, given_h;
};

RglBrdf::RglBrdf(RglTables tables) : t_(std::move(tables)), isotropic_(t_.isotropic()) {
    const std::vector<float>& phi = t_.incidence.slow();
    if (isotropic_) return;
    const float range = phi.back() - phi.front(), middle = 0.5f * (phi.back() + phi.front());
    reduction_ = std::max(int(std::lround(2.f * pi / range)), 1);
    sign_x_ = std::cos(middle) < 0.f ? -1.f : 1.f;
    sign_y_ = std::sin(middle) < 0.f ? -1.f : 1.f;
}

RglBrdf::Given RglBrdf::turned(const Vec3f& given) const {
    Given g;
    g.w = given;
    if (reduction_ >= 2) {
        // Half a circle was measured: the surface looks the same when turned by the other half. A
        // quarter: when mirrored at x and y, too.
        g.sign_y = given.y * sign_y_ < 0.f ? -1.f : 1.f;
        g.sign_x = reduction_ >= 4 ? (given.x * sign_x_ < 0.f ? -1.f : 1.f) : g.sign_y;
        g.w.x *= g.sign_x;
        g.w.y *= g.sign_y;
    }
    return g;
}

RglBrdf::Given RglBrdf::place(const Vec3f& given) const {
    Given g = turned(given);
    const Polar polar = polar_of(g.w, g.w)[0];
    g.theta = polar.theta;
    g.phi = polar.phi;
    g.mix = t_.incidence.at(g.phi, g.theta);
    return g;
}

RglBrdf::Half RglBrdf::place(const Vec3f& given, const Vec3f& other, Given& g) const {
    g = turned(given);
    const Vec3f h = normalize(g.w + Vec3f(other.x * g.sign_x, other.y * g.sign_y, other.z));
    const auto [at_given, at_half] = polar_of(g.w, h);
    g.theta = at_given.theta;
    g.phi = at_given.phi;
    g.mix = t_.incidence.at(g.phi, g.theta);
    return {square_x(at_half.theta), square_y(isotropic_ ? at_half.phi - g.phi : at_half.phi),
            sin_theta_of(h), dot(g.w, h)};
}

float RglBrdf::factor(const Given& g, float x, float y) const {
    if (!t_.jacobian) return 1.f;
    const SliceMix one;
    return t_.ndf.eval(x, y, one) / (4.f * t_.sigma.eval(square_x(g.theta), square_y(g.phi), one));
}

/// `scale` times the spectra at (u, v), where the warp of visible normals begins.
void RglBrdf::look_up(const SliceMix& mix, float u, float v, float scale,
                      std::span<float> out) const {
    // Directions that are no numbers must not lead out of the table.
    const auto place_on = [](float u, int nodes) { return u > 0.f ? u * float(nodes - 1) : 0.f; };
    const float px = place_on(u, t_.width), py = place_on(v, t_.height);
    const int x = std::min(int(px), t_.width - 2), y = std::min(int(py), t_.height - 2);
    const float tx = px - float(x), ty = py - float(y);
    const std::size_t n = std::size_t(t_.channels), row = std::size_t(t_.width) * n;
    std::fill_n(out.begin(), n, 0.f);
    for (int k = 0; k < mix.count; ++k) {
        const float* s =
            t_.spectra.data() + ((std::size_t(mix.slice[k]) * t_.height + y) * t_.width + x) * n;
        const float w = scale * mix.weight[k];
        const float w00 = w * (1.f - tx) * (1.f - ty), w10 = w * tx * (1.f - ty);
        const float w01 = w * (1.f - tx) * ty, w11 = w * tx * ty;
        for (std::size_t c = 0; c < n; ++c)
            out[c] += w00 * s[c] + w10 * s[n + c] + w01 * s[row + c] + w11 * s[row + n + c];
    }
}

bool RglBrdf::eval(const Vec3f& given, const Vec3f& other, std::span<float> out) const {
    if (!(given.z > 0.f && other.z > 0.f)) return false;
    Given g;
    const Half h = place(given, other, g);
    const auto at = t_.vndf.invert(h.x, h.y, g.mix);
    look_up(g.mix, at.x, at.y, factor(g, h.x, h.y), out);
    return true;
}

Vec3f RglBrdf::direction_of(const Given& g, float x, float y, Vec3f& half) const {
    half = square_vector(x, y, isotropic_ ? g.phi : 0.f);
    const Vec3f w = half * (2.f * dot(g.w, half)) - g.w;
    return {w.x * g.sign_x, w.y * g.sign_y, w.z};
}

std::optional<RglBrdf::Sample> RglBrdf::sample(const Vec3f& given, float u, float v) const {
    return sample(given, u, v, {});
}

std::optional<RglBrdf::Sample> RglBrdf::sample(const Vec3f& given, float u, float v,
                                               std::span<float> out) const {
    if (!(given.z > 0.f)) return std::nullopt;
    const Given g = place(given);
    const auto bright = t_.luminance.sample(u, v, g.mix);
    const auto at = t_.vndf.sample(bright.x, bright.y, g.mix);
    Vec3f half;
    const Vec3f w = direction_of(g, at.x, at.y, half);
    const float given_h = dot(g.w, half);
    if (!(w.z > 0.f && given_h > 0.f)) return std::nullopt;
    if (!out.empty()) look_up(g.mix, bright.x, bright.y, factor(g, at.x, at.y), out);
    return Sample{
        w, bright.density * at.density / reflected_solid_angle(at.x, sin_theta_of(half), given_h)};
}

float RglBrdf::pdf(const Vec3f& given, const Vec3f& other) const {
    return eval_pdf(given, other, {}).value_or(0.f);
}

std::optional<float> RglBrdf::eval_pdf(const Vec3f& given, const Vec3f& other,
                                       std::span<float> out) const {
    if (!(given.z > 0.f && other.z > 0.f)) return std::nullopt;
    Given g;
    const Half h = place(given, other, g);
    const auto at = t_.vndf.invert(h.x, h.y, g.mix);
    if (!out.empty()) look_up(g.mix, at.x, at.y, factor(g, h.x, h.y), out);
    return at.density * t_.luminance.density(at.x, at.y, g.mix) /
           reflected_solid_angle(h.x, h.sin_theta, h.given_h);
}

RglBrdf::Node RglBrdf::node(const Vec3f& given, std::size_t slice, int x, int y) const {
    // As it is: at the ends of a half or quarter of the circle rounding could turn it into another.
    Given g;
    g.w = given;
    const Polar polar = polar_of(given, given)[0];
    g.theta = polar.theta;
    g.phi = polar.phi;
    g.mix.slice[0] = std::uint32_t(slice);
    const auto at = t_.vndf.sample(std::min(float(x) / float(t_.width - 1), 0.9999999f),
                                   std::min(float(y) / float(t_.height - 1), 0.9999999f), g.mix);
    Vec3f half;
    const Vec3f direction = direction_of(g, at.x, at.y, half);
    return {direction, factor(g, at.x, at.y)};
}

}  // namespace nacre
