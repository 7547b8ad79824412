#pragma once
// He-Torrance: physical optics of a rough surface. The wavelength matters.
//
//   X. D. He, K. E. Torrance, F. X. Sillion, D. P. Greenberg 1991, A Comprehensive Physical Model
//   for Light Reflection, SIGGRAPH 91.
//   f = mirror of share F(wi.z) e^-g S  +  F(u) G S D / (pi wi.z wo.z)  +  kd/pi
//   v = wi + wo, u = |v|/2, kappa = 2 pi/lambda
//   g = (kappa sigma v_z)^2,  sigma = sigma0 / sqrt(1 + x^2),
//   x e^{x^2/2} = (K(wi) + K(wo)) / sqrt(8 pi),  K = tan(theta) erfc(a),
//   a = tau cot(theta)/(2 sigma0)
//   G = (v.v / v_z)^2:  the paper's quotient of polarisation vectors, which is this identically
//   S = S1(wi) S1(wo),  S1 = (1 - erfc(a)/2) / (1 + L),  L = (e^{-a^2}/(sqrt(pi) a) - erfc(a))/2
//   D = (kappa tau)^2/16 sum_{j>=1} g^j e^-g / (j! j) exp(-(kappa tau v_xy)^2 / (4 j))
//
// The sum is over a Poisson distribution of mean g, whose missing term j = 0 is the mirror: each
// j adds a normal distribution of v_xy of variance 2 j/(kappa tau)^2, and f is F S G/(4 wi.z wo.z)
// times their mixture. For large g it tends to Beckmann's facets of slope m = 2 sigma/tau.
//
// Polarised light: `parallel` is its share polarised parallel to the plane of incidence. The
// facet that reflects from wi to wo has a plane of its own; s remains s there with the share A =
// (p.wo)^2/|wi x wo|^2, p perpendicular to wi in the plane of incidence (derived), which are the
// factors of the paper's G.
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/poisson_sum.h"

namespace nacre {

enum class HeShadowing { smith, printed };

const ModelDescription& he_torrance_description();

template <class D, class P = D, class S = D>
struct HeTorrance {
    using V = Product<D, S>;
    using W = Product<V, P>;

    HeShadowing shadowing;
    P kd, n, k;
    S parallel, sigma0, tau;
    P lambda;

    static const ModelDescription& describe() { return he_torrance_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("shadowing", m.shadowing);
        f("kd", m.kd);
        f("n", m.n);
        f("k", m.k);
        f("parallel", m.parallel);
        f("sigma0", m.sigma0);
        f("tau", m.tau);
        f("lambda", m.lambda);
    }

    W eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Vec3<D> v = wi + wo;
        const D ratio = dot(v, v) / at_least(v.z, 1e-7);
        const V s = facets_seen(wi) * facets_seen(wo);
        const V scale = V(ratio * ratio * D(inv_pi) / at_least(D(wi.z * wo.z), 1e-14)) * s;
        return above(wi, wo) * (D(inv_pi) * kd + scale * fresnel(wi, wo) * roughness(wi, wo));
    }

    // The parts of the paper.

    /// F: of the facet between the directions.
    W fresnel(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const Vec3<D> v = wi + wo, c = cross(wi, wo);
        const auto r = fresnel_conductor_polarised(Product<D, P>(D(0.5) * sqrt(dot(v, v))), n, k);
        const D sine2 = wi.x * wi.x + wi.y * wi.y, both = sine2 * dot(c, c);
        const D along = wo.z * sine2 - wi.z * (wi.x * wo.x + wi.y * wo.y);
        const D kept = select(both > D(1e-20), D(along * along / at_least(both, 1e-20)), D(0.5));
        const V p = V(S(1) - parallel) + V(kept) * V(parallel + parallel - S(1));
        return W(r.s) + p * (W(r.p) - W(r.s));
    }
    /// S1: the share of the facets that w neither misses nor leaves in shadow.
    V facets_seen(const Vec3<D>& w) const {
        using std::erfc, std::exp;
        const V a = inverse_slope(w), e = erfc(bounded(a));
        const V tail = V(D(std::numbers::inv_sqrtpi)) / a;
        const V lambda_ = V(D(0.5)) * (shadowing == HeShadowing::printed
                                           ? tail - e
                                           : tail * exp(V(-bounded(a) * bounded(a))) - e);
        return (V(D(1)) - V(D(0.5)) * e) / (V(D(1)) + lambda_);
    }
    /// sigma: deviation of the heights that both directions see, in micrometres.
    V effective_deviation(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::exp, std::log, std::sqrt;
        const V one = V(D(1)), f = (hidden(wi) + hidden(wo)) * V(D(1. / std::sqrt(8. * pi)));
        // Newton's method on the convex x exp(x^2/2) - f, from the right of its root: f itself, or
        // for f > 1 where the exponential alone would do. Eight steps reach double precision.
        const V root = sqrt(V(D(2)) * log(select(f > one, f, one)));
        V x = select(f > one, select(root > one, root, one), f);
        const auto improved = [](const auto& x, const auto& f) {
            using T = std::remove_cvref_t<decltype(x)>;
            const T e = exp(T(T(D(0.5)) * x * x));
            return T(x - (x * e - f) / ((T(D(1)) + x * x) * e));
        };
        if constexpr (requires {
                          x.v;
                          x.a;
                      }) {
            // Dual numbers: a step at the root gives its exact derivatives.
            for (int step = 0; step < 8; ++step) x.a = improved(x.a, f.a);
            x = improved(x, f);
        } else {
            for (int step = 0; step < 8; ++step) x = improved(x, f);
        }
        return V(sigma0) / sqrt(one + x * x);
    }
    /// g: squared phase variation by the roughness.
    W phase2(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const W phase = W(wave_number()) * W(effective_deviation(wi, wo) * V(wi.z + wo.z));
        return phase * phase;
    }
    /// D: distribution of slopes and heights.
    W roughness(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D x = wi.x + wo.x, y = wi.y + wo.y;
        const P width = wave_number() * P(tau), width2 = width * width;
        return W(width2) * W(D(1. / 16)) *
               poisson_sum(phase2(wi, wo), W(W(width2) * W(D(0.25) * (x * x + y * y))));
    }

    P mirror(const Vec3<D>& wo) const {
        using std::exp;
        const D seen = D(facets_seen(wo));
        const P g = P(phase2(mirrored(wo), wo));
        return P(above(wo, wo) * seen * seen) * P(mean_fresnel(wo)) * exp(P(P(0.f) - g));
    }
    D mirror_probability(const Vec3<D>& wo) const {
        const D all = D(mean_of(mean_fresnel(wo))) + D(mean_of(kd));
        return D(mean_of(mirror(wo))) / at_least(all, 1e-30);
    }

    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        using std::cos, std::sin, std::sqrt;
        const D cosine = cosine_share(wo);
        if (u1 < cosine) return square_to_cosine_hemisphere(u2);
        const double u = double((u1 - cosine) / (D(1) - cosine)) * lane_count;
        const int i = std::clamp(int(u), 0, lane_count - 1);
        const PoissonNormals normals = normals_at(wo, i);
        const D r = D(normals.radius(u - i, u2.x)), phi = D(2 * pi) * u2.y;
        const D x = r * cos(phi) - wo.x, y = r * sin(phi) - wo.y, rest = D(1) - x * x - y * y;
        if (!(rest > D(0))) return {D(0), D(0), D(-1)};
        return {x, y, sqrt(rest)};
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D x = wi.x + wo.x, y = wi.y + wo.y;
        double lobe = 0.;
        for (int i = 0; i < lane_count; ++i)
            lobe += normals_at(wo, i).density(double(x * x + y * y)) / lane_count;
        const D cosine = cosine_share(wo);
        return above(wi, wo) * wi.z * (cosine * D(inv_pi) + (D(1) - cosine) * D(lobe));
    }

  private:
    static constexpr double pi = std::numbers::pi;
    static constexpr int lane_count = [] {
        if constexpr (requires { P::size; })
            return P::size;
        else
            return 1;
    }();
    static double lane(const P& p, [[maybe_unused]] int i) {
        if constexpr (requires { P::size; })
            return double(p[i]);
        else
            return double(p);
    }

    /// 2 pi/lambda, per micrometre; lambda is in nanometres.
    P wave_number() const { return P(S(2e3 * pi)) / lambda; }
    /// a = cot(theta) / m, m = 2 sigma0/tau.
    V inverse_slope(const Vec3<D>& w) const {
        using std::sqrt;
        const D cot = at_least(w.z, 1e-7) / sqrt(at_least(D(w.x * w.x + w.y * w.y), 1e-16));
        return V(cot) * V(tau / (sigma0 + sigma0));
    }
    /// erfc(12) and exp(-144) are nothing, and stay finite.
    static V bounded(const V& a) { return select(a < V(D(12)), a, V(D(12))); }
    /// K.
    V hidden(const Vec3<D>& w) const {
        using std::erfc;
        const V a = inverse_slope(w);
        return V(tau / (sigma0 + sigma0)) / a * erfc(bounded(a));
    }
    Product<D, P> mean_fresnel(const Vec3<D>& wo) const {
        using X = Product<D, P>;
        const auto r = fresnel_conductor_polarised(X(at_least(wo.z, 0.)), n, k);
        return X(r.s) + X(D(parallel)) * (X(r.p) - X(r.s));
    }
    /// A fifth of the samples at least: the weights of the normals grow without bound at grazing.
    D cosine_share(const Vec3<D>& wo) const {
        const D lobe = D(mean_of(mean_fresnel(wo))), diffuse = D(mean_of(kd));
        return (D(0.2) * lobe + diffuse) / at_least(D(lobe + diffuse), 1e-30);
    }
    PoissonNormals normals_at(const Vec3<D>& wo, int i) const {
        const double width = lane(wave_number(), i) * double(tau);
        return PoissonNormals(lane(P(phase2(mirrored(wo), wo)), i), 4. / (width * width));
    }
};

}  // namespace nacre
