#pragma once
// Lafortune: cosine lobes about axes that need not be the mirror direction.
//
//   E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg 1997, Non-Linear Approximation
//   of Reflectance Functions, SIGGRAPH 97.
//   f = kd/pi + sum_j ks_j N_j [wi^T M_j wo]+^n_j,  M symmetric
//   N: none 1, normal (n+2)/(2 pi), density (n+1)/(2 pi)
//   classic lobe: M = diag(-1, -1, 1); off-specular: |cz| < |cx|; retro-reflection: cx, cy, cz > 0;
//   diffuse falloff: cx = cy = 0; anisotropic: cx != cy
//   specular remainder: (ks_1 - E_1(wo)) mirror times a Dirac delta at the mirror direction over
//   wi.z
// For a given wo each lobe is a cosine lobe about M wo, so its albedo is known: with l = |M w| and
// the angle a between M w and the normal,
//   E = ks N l^n I(a),  I(a) = B((n+3)/2, 1/2) (cos(a) int_{-pi/2}^{pi/2-a} cos^{n+1} +
//   sin^{n+2}(a) / (n+1)),
// derived by slicing the sphere along the line that is perpendicular to both.
#include "nacre/math/quadrature.h"
#include "nacre/math/warp.h"
#include "nacre/reflectance/cosine_lobe.h"

namespace nacre {

enum class LafortuneNorm { normal, density, none };

/// Names of the lobes' parameters.
inline constexpr std::string_view lafortune_names[3][8] = {
    {"ks", "cx", "cy", "cz", "cxy", "cxz", "cyz", "n"},
    {"ks2", "cx2", "cy2", "cz2", "cxy2", "cxz2", "cyz2", "n2"},
    {"ks3", "cx3", "cy3", "cz3", "cxy3", "cxz3", "cyz3", "n3"}};

const ModelDescription& lafortune_description();

/// int [axis.v]+^n [v.z]+ dv over the sphere, `cosine` that of the axis and the normal.
template <class T>
T cosine_lobe_albedo(T cosine, T n) {
    using std::acos, std::cos, std::exp, std::log, std::sqrt;
    static const GaussLegendre nodes(32);
    // Beyond nine deviations of the lobe nothing is left in double precision.
    const double right = std::numbers::pi / 2, most = 9. / std::sqrt(1. + double(n));
    const T bound = T(most < right ? most : right);
    const auto power = [&](T exponent, T from, T to) {
        const T half = T(0.5) * (to - from), middle = T(0.5) * (to + from);
        T sum = T(0);
        for (std::size_t i = 0; i < nodes.node.size(); ++i)
            sum += T(nodes.weight[i]) * exp(exponent * log(cos(middle + half * T(nodes.node[i]))));
        return half * sum;
    };
    const T c = std::clamp(cosine, T(-1), T(1)), end = T(right) - acos(c);
    const T sine = sqrt(T(1) - c * c);
    const T across = power(n + T(2), -bound, bound);
    const T along = power(n + T(1), -bound, std::clamp(end, -bound, bound));
    const T rest = sine > T(0) ? exp((n + T(2)) * log(sine)) / (n + T(1)) : T(0);
    return across * std::max(c * along + rest, T(0));
}

template <class D, class P = D, class S = D>
struct Lafortune {
    struct Lobe {
        P ks;
        S cx, cy, cz, cxy, cxz, cyz, n;

        template <class F>
        static void parameters(Lobe& l, F&& f, const std::string_view (&names)[8]) {
            f(names[0], l.ks);
            f(names[1], l.cx);
            f(names[2], l.cy);
            f(names[3], l.cz);
            f(names[4], l.cxy);
            f(names[5], l.cxz);
            f(names[6], l.cyz);
            f(names[7], l.n);
        }
        /// M w.
        Vec3<Product<D, S>> axis(const Vec3<D>& w) const {
            return {cx * w.x + cxy * w.y + cxz * w.z, cxy * w.x + cy * w.y + cyz * w.z,
                    cxz * w.x + cyz * w.y + cz * w.z};
        }
    };

    LafortuneNorm norm;
    P kd, mirror_part;
    Lobe lobes[3];

    static const ModelDescription& describe() { return lafortune_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("norm", m.norm);
        f("kd", m.kd);
        f("mirror", m.mirror_part);
        Lobe::parameters(m.lobes[0], f, lafortune_names[0]);
        Lobe::parameters(m.lobes[1], f, lafortune_names[1]);
        Lobe::parameters(m.lobes[2], f, lafortune_names[2]);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using V = Product<D, S>;
        Product<V, P> f = V(D(inv_pi)) * kd;
        for (const Lobe& l : lobes) {
            const Vec3<V> a = l.axis(wi);
            f += V(factor(l.n)) * power(V(a.x * wo.x + a.y * wo.y + a.z * wo.z), l.n) * l.ks;
        }
        return above(wi, wo) * f;
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        const Shares shares = shares_at(wo);
        for (int j = 0; j < 3; ++j) {
            if (u1 < shares.lobe[j])
                return sample_cosine_power(normalize(lobes[j].axis(wo)), lobes[j].n, u2);
            u1 -= shares.lobe[j];
        }
        return square_to_cosine_hemisphere(u2);
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Shares shares = shares_at(wo);
        D sum = shares.cosine * D(inv_pi) * wi.z;
        for (int j = 0; j < 3; ++j)
            if (shares.lobe[j] > D(0))
                sum += shares.lobe[j] * D((lobes[j].n + S(1)) * S(0.5 * inv_pi)) *
                       power(D(dot(normalize(lobes[j].axis(wo)), wi)), lobes[j].n);
        return above(wi, wo) * sum;
    }
    D albedo(const Vec3<D>& wi) const {
        D sum = D(mean_of(kd));
        for (const Lobe& l : lobes) sum += D(mean_of(l.ks)) * lobe_albedo(l, wi);
        return sum;
    }
    P mirror(const Vec3<D>& wo) const {
        return mirror_part * lobes[0].ks * P(at_least(D(D(1) - lobe_albedo(lobes[0], wo)), 0.));
    }
    D mirror_probability(const Vec3<D>& wo) const {
        const D m = D(mean_of(mirror(wo)));
        return m > D(0) ? m / (m + albedo(wo)) : D(0);
    }

  private:
    struct Shares {
        D lobe[3], cosine;
    };

    S factor(const S& n) const {
        return norm == LafortuneNorm::none     ? S(1)
               : norm == LafortuneNorm::normal ? S((n + S(2)) * S(0.5 * inv_pi))
                                               : S((n + S(1)) * S(0.5 * inv_pi));
    }
    /// [x]+^n, at most 1e30.
    template <class V>
    static V power(const V& x, const S& n) {
        using std::exp, std::log;
        const auto positive = x > V(0);
        const V l = V(n) * log(select(positive, x, V(1)));
        return select(positive, V(exp(select(l < V(69), l, V(69)))), V(0));
    }
    /// Albedo of a lobe with ks = 1.
    D lobe_albedo(const Lobe& l, const Vec3<D>& w) const {
        const Vec3<D> a = l.axis(w);
        const D length2 = dot(a, a);
        using std::sqrt;
        if (!(length2 > D(0))) return D(0);
        const D length = sqrt(length2);
        return D(factor(l.n)) * power(length, l.n) * cosine_lobe_albedo(a.z / length, D(l.n));
    }
    /// Lobes by the energy that they hold, the horizon apart.
    Shares shares_at(const Vec3<D>& wo) const {
        using std::sqrt;
        Shares shares{{}, D(mean_of(kd))};
        D sum = shares.cosine;
        for (int j = 0; j < 3; ++j) {
            const Lobe& l = lobes[j];
            const Vec3<D> a = l.axis(wo);
            const D length2 = dot(a, a);
            if (length2 > D(0))
                shares.lobe[j] = D(mean_of(l.ks)) * D(factor(l.n)) * power(sqrt(length2), l.n) *
                                 D(2 * std::numbers::pi) / (l.n + D(1));
            sum += shares.lobe[j];
        }
        if (!(sum > D(0))) return {{}, D(1)};
        for (D& s : shares.lobe) s /= sum;
        shares.cosine /= sum;
        return shares;
    }
};

}  // namespace nacre
