#pragma once
// Hanrahan and Krueger 1993, Reflection from Layered Surfaces due to Subsurface Scattering,
// SIGGRAPH 93: light that a flat layer scatters once, in closed form.
//
//   f_r = W p(cos) / (mi + mr) (1 - exp(-tau (1/mi + 1/mr)))
//   f_t = W p(cos) / (mi - mt) (exp(-tau/mi) - exp(-tau/mt)),   W p tau exp(-tau/mi) / mi^2 at mt =
//   mi exp(-tau/mi) of the light goes straight on
//
// W is the single-scattering albedo, tau the optical thickness, p the phase function, m the
// cosines inside. These are BSDFs, sr^-1, per projected irradiance and without the cosine of the
// outgoing direction; the paper prints ratios of radiances, which are mi times as large. At smooth
// boundaries to a rarer or denser outside the directions are refracted and both f become
// (1 - F_i) (1 - F_o) / n^2 times what they are at the refracted cosines; reflection on the inside
// of a boundary belongs to higher orders and is left out. The paper's factor T12 = n^2 (1 - F) of
// radiance is the same thing.
//
// Reciprocal, and never more than what comes in: what is scattered more than once is missing.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nacre/layers/layer.h"
#include "nacre/math/frame.h"
#include "nacre/math/lanes_math.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/phase_henyey_greenstein.h"

namespace nacre {

/// How much light is scattered at all depths and leaves without a further event, for directions
/// with the cosines m_i, m_o > 0 inside, per W p: the fractions above. `same` is 1 for reflection
/// (both directions on one side) and 0 for transmission. With u = max(1/mi, 1/mo), v = min(...),
/// both are
///   tau / (mi mo) exp(-tau v [transmission]) (1 - exp(-x)) / x,   x = tau (u +- v),
/// which cancels nowhere. tau >= 0, may be infinite.
template <class D, class S>
auto single_scattering(D m_i, D m_o, S tau, D same) {
    using std::exp;
    using T = std::decay_t<decltype(m_i * tau)>;
    // Nothing passes a thickness of 1e4 in any precision, and products with it stay finite.
    const T depth = select(T(tau) < T(1e4), T(tau), T(1e4));
    const auto inverse = [](D m) { return D(1) / select(m > D(1e-6), m, D(1e-6)); };
    const D i = inverse(m_i), o = inverse(m_o), less = select(i < o, i, o);
    const D more = i + o - less;
    const T x = depth * (more + (D(2) * same - D(1)) * less);
    // (1 - exp(-x)) / x; below 0.1 by its series, up to x^9, which leaves 3e-18.
    const auto small = x < T(0.1);
    const T y = select(small, x, T(0.1));
    T series(1);
    for (int k = 10; k >= 2; --k) series = T(1) - y * series * T(1. / k);
    const T mean = select(small, series, T((T(1) - exp(T(-x))) / select(small, T(1), x)));
    return T(depth * (i * o) * exp(T(-depth * (less * (D(1) - same)))) * mean);
}

/// One layer, the same outside on both sides. D: directions; S: coefficients (one number, or four
/// wavelengths); Phase: any phase function of optics/phase.h.
template <class D, class S = D, class Phase = HenyeyGreensteinPhase<D>>
struct HanrahanKrueger {
    using T = std::decay_t<decltype(std::declval<D>() * std::declval<S>())>;

    S albedo;  ///< W, within [0, 1]
    S tau;     ///< optical thickness, >= 0, may be infinite
    Phase phase;
    D eta = D(1);  ///< index inside over outside, > 0

    /// The BSDF of light scattered once, sr^-1: f_r where wi and wo lie on one side, else f_t.
    T eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D side = wi.z * wo.z;
        const D same = select(side > D(0), D(1), D(0)), defined = select(side != D(0), D(1), D(0));
        const Vec3<D> i = inside(wi), o = inside(wo);
        const D passes = (D(1) - specular(wi.z)) * (D(1) - specular(wo.z)) / (eta * eta);
        return albedo * single_scattering(magnitude(i.z), magnitude(o.z), tau, same) *
               (defined * passes * phase.eval(turn(i, o)));
    }

    /// Share of power that the first surface mirrors.
    D specular(D cosine) const {
        return select(eta == D(1), D(0), D(fresnel_dielectric(magnitude(cosine), eta)));
    }

    /// Share of power that passes without being scattered; it goes straight on.
    T unscattered(D cosine) const {
        using std::exp;
        const D through = D(1) - specular(cosine);
        const D m = cosine_inside(cosine);
        return T(exp(T(-tau * (D(1) / select(m > D(1e-6), m, D(1e-6)))))) * (through * through);
    }

    /// Draws wi for light scattered once by the phase function alone; the zero vector where the
    /// boundary holds the light back. f cos / pdf is then at most W, for the depths of
    /// the scattering, which `eval` integrates in closed form, need no sampling. Plain numbers
    /// only.
    Vec3<D> sample(const Vec3<D>& wo, Vec2<D> u) const {
        const Vec3<D> onwards = -inside(wo);
        const D c = phase.sample_cos(u.x), s = std::sqrt(std::max(D(0), D(1) - c * c));
        const D phi = D(2 * std::numbers::pi) * u.y;
        const Vec3<D> w =
            Frame<D>::around(onwards).to_world({s * std::cos(phi), s * std::sin(phi), c});
        // 1 - eta^2 (1 - w.z^2), exactly w.z^2 without a boundary: the difference of squares would
        // lose grazing directions to rounding.
        const D z2 = eta * eta * w.z * w.z - (eta - D(1)) * (eta + D(1));
        if (!(z2 > D(0)) || onwards.z == D(0)) return {};
        return {w.x * eta, w.y * eta, std::copysign(std::sqrt(z2), w.z)};
    }
    /// Density of `sample`, sr^-1: p times dw_inside / dw_outside = z / (eta^2 m). Its integral is
    /// the probability that the boundary lets the direction out: 1 without boundaries.
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Vec3<D> i = inside(wi), o = inside(wo);
        const D m = magnitude(i.z);
        const auto leaves = m * magnitude(o.z) > D(0);
        return select(leaves, D(1), D(0)) * phase.eval(turn(i, o)) * magnitude(wi.z) /
               (eta * eta * select(leaves, m, D(1)));
    }

  private:
    static D magnitude(D x) { return select(x < D(0), D(-x), x); }
    // Cosine of the scattering angle. Under total reflection, where f is 0, the vectors inside are
    // too long.
    static D turn(const Vec3<D>& i, const Vec3<D>& o) {
        const D c = -dot(i, o), low = select(c > D(-1), c, D(-1));
        return select(low < D(1), low, D(1));
    }

    // sqrt(1 - (1 - z^2) / eta^2), 0 under total reflection, and |z| to the last digit at eta = 1.
    D cosine_inside(D z) const {
        return fresnel_detail::clamped_sqrt(D((eta - D(1)) * (eta + D(1)) + z * z)) / eta;
    }
    Vec3<D> inside(const Vec3<D>& w) const {
        const D m = cosine_inside(w.z);
        return {w.x / eta, w.y / eta, select(w.z < D(0), D(-m), m)};
    }
};

/// Any number of layers with different indices, in double precision: the sum over the layers of
/// what each scatters once, weakened by the layers and smooth boundaries on its way in and out.
class HanrahanKruegerStack {
  public:
    /// Throws as `check` does.
    explicit HanrahanKruegerStack(LayerStack stack);

    const LayerStack& stack() const { return stack_; }

    /// BSDF of light scattered once, sr^-1. Directions with z > 0 lie above the stack and those
    /// with z < 0 below; light may come from either side. f(wi, wo) / n_o^2 is symmetric, where n_o
    /// is the index on the side of wo.
    double eval(const Vec3d& wi, const Vec3d& wo) const;
    /// Where a beam from above of cosine > 0 goes, by quadrature to about 1e-10. `reflectance` is
    /// `specular` (the first surface) plus what is scattered back once, `transmittance` is
    /// `unscattered` plus what is scattered forwards once; `absorptance` is the rest: absorbed,
    /// scattered more than once or reflected at an inner boundary.
    LayerTotals totals(double cosine) const;

  private:
    struct Beam;
    Beam enter(double momentum, bool above) const;
    template <class P>
    double sum(const Beam& i, const Beam& o, bool same, double eta_out, P&& phase) const;
    double scattered(const Beam& i, double momentum, bool above) const;

    LayerStack stack_;
};

}  // namespace nacre
