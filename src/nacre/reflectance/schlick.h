#pragma once
// Schlick 1994: rational factors, one or two layers.
//
//   C. Schlick 1994, An Inexpensive BRDF Model for Physically-Based Rendering, CGF 13(3).
//   one layer   f = S Q                    two layers   f = S Q + (1 - S) S' Q'
//   S = c  or  c + (1 - c) (1-u)^5,  u = wi.h
//   t = h.z, w = cos of the azimuth of h, v = wi.z, v' = wo.z
//   Z = r / (1 + r t^2 - t^2)^2,  A = sqrt(p / (p^2 - p^2 w^2 + w^2)),  g(v) = v / (v - k v + k)
//   Q: simple                   Z A / (4 pi v v')
//      reemission               (g(v) g(v') Z A + 1 - g(v) g(v')) / (4 pi v v')
//      reemission_bounded       g g' Z A / (4 pi v v') + (1 - g g') / pi
//      mixture                  a/pi + b Z A / (4 pi v v') + mirror of weight 1 - a - b
//      mixture_reemission       a/pi + b (g g' Z A + 1 - g g') / (4 pi v v') + mirror
//      masked                   g g' Z A / (4 pi v v')
//   b = 4 r (1-r); a = 1 - b for r >= 1/2, else 0
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/model.h"

namespace nacre {

enum class SchlickForm {
    simple,
    reemission,
    reemission_bounded,
    mixture,
    mixture_reemission,
    masked
};
enum class SchlickSpectral { fresnel, constant };
enum class SchlickLayers { one, two };
enum class SchlickMasking { published, slope, ggx, given };

const ModelDescription& schlick_description();

/// Z, whose integral with the cosine over normals is pi; by T = tan^2 theta.
template <class D, class S>
Product<D, S> schlick_zenith(const D& tan2, const S& r) {
    using V = Product<D, S>;
    const V q = V(D(1) + tan2) / (V(r) + V(tan2));  // 1 / (1 + r t^2 - t^2)
    return V(r) * q * q;
}
/// A, whose square has the mean 1 over azimuths; by the squares of w and of its sine.
template <class D, class S>
Product<D, S> schlick_azimuth(const D& w2, const D& sine2, const S& p) {
    using std::sqrt;
    using V = Product<D, S>;
    return sqrt(V(V(p) / (V(p * p) * V(sine2) + V(w2))));
}
/// g, the masking of one direction.
template <class D, class S>
Product<D, S> schlick_masking(const D& v, const S& k) {
    using V = Product<D, S>;
    return V(v) / (V(v) * V(S(1) - k) + V(k));
}

template <class D, class P = D, class S = D>
struct Schlick {
    SchlickForm form;
    SchlickSpectral spectral;
    SchlickLayers layers;
    SchlickMasking masking;
    P c;
    S r, p, k;
    P c2;
    S r2, p2, k2;

    static const ModelDescription& describe() { return schlick_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("form", m.form);
        f("spectral", m.spectral);
        f("layers", m.layers);
        f("masking", m.masking);
        f("c", m.c);
        f("r", m.r);
        f("p", m.p);
        f("k", m.k);
        f("c2", m.c2);
        f("r2", m.r2);
        f("p2", m.p2);
        f("k2", m.k2);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const Vec3<D> h = wi + wo;
        const D u = D(0.5) * sqrt(dot(h, h));
        const Product<D, P> s = colour(u, c);
        Product<Product<D, S>, P> f = directional(wi, wo, h, r, p, k) * s;
        if (layers == SchlickLayers::two)
            f += directional(wi, wo, h, r2, p2, k2) * ((P(1.f) - s) * colour(u, c2));
        return above(wi, wo) * f;
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        using std::atan2, std::cos, std::sin, std::sqrt;
        const Shares shares = shares_at(wo);
        if (u1 < shares.cosine) return square_to_cosine_hemisphere(u2);
        const bool first = u1 < shares.cosine + shares.first;
        const D r_ = first ? r : r2, p_ = first ? p : p2;
        const D tan = sqrt(r_ * (D(1) - u2.x) / at_least(u2.x, 1e-12));
        const D psi = D(2 * std::numbers::pi) * u2.y;
        const D phi = atan2(sin(psi), p_ * cos(psi));
        return reflect(wo, normalize(Vec3<D>{tan * cos(phi), tan * sin(phi), D(1)}));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const Vec3<D> h = wi + wo;
        const Shares shares = shares_at(wo);
        D lobes = shares.first * normal_density(h, r, p);
        if (shares.second > D(0)) lobes += shares.second * normal_density(h, r2, p2);
        const D length = sqrt(at_least(dot(h, h), 1e-20));
        return above(wi, wo) * (lobes * D(0.5) / length + shares.cosine * D(inv_pi) * wi.z);
    }
    /// The mixture's third part.
    P mirror(const Vec3<D>& wo) const {
        const D u = at_least(wo.z, 0.);
        const P s = P(colour(u, c));
        P m = s * P(weights(r).mirror);
        if (layers == SchlickLayers::two)
            m = m + (P(1.f) - s) * P(colour(u, c2)) * P(weights(r2).mirror);
        return m;
    }
    D mirror_probability(const Vec3<D>& wo) const {
        const D u = at_least(wo.z, 0.);
        const P s = P(colour(u, c));
        P all = s;
        if (layers == SchlickLayers::two) all = all + (P(1.f) - s) * P(colour(u, c2));
        return D(mean_of(mirror(wo))) / at_least(D(mean_of(all)), 1e-30);
    }

    void prepare() {
        k = masking_of(r, k);
        k2 = masking_of(r2, k2);
    }

  private:
    struct Weights {
        S diffuse, lobe, mirror;
    };
    struct Shares {
        D cosine, first, second;
    };

    bool is_mixture() const {
        return form == SchlickForm::mixture || form == SchlickForm::mixture_reemission;
    }
    /// a, b, c of the mixture; else all is in the lobe.
    Weights weights(S rough) const {
        if (!is_mixture()) return {S(0), S(1), S(0)};
        const S b = S(4) * rough * (S(1) - rough), rest = S(1) - b;
        const bool rougher = rough >= S(0.5);
        return {rougher ? rest : S(0), b, rougher ? S(0) : rest};
    }
    S masking_of(S rough, S given) const {
        using std::sqrt;
        switch (masking) {
            case SchlickMasking::slope:
                return S(std::sqrt(0.5 * std::numbers::inv_pi)) * rough;
            case SchlickMasking::ggx:
                return S(0.5) * sqrt(rough);
            case SchlickMasking::given:
                return given;
            case SchlickMasking::published:
                break;
        }
        return rough;
    }
    Product<D, P> colour(const D& u, const P& normal) const {
        using V = Product<D, P>;
        return spectral == SchlickSpectral::fresnel ? V(fresnel_schlick(u, normal))
                                                    : V(V(normal) + V(D(0)));
    }

    /// A at the azimuth of h; 1 where h is the normal.
    Product<D, S> azimuth(const Vec3<D>& h, const S& aniso) const {
        const D x2 = h.x * h.x, y2 = h.y * h.y, xy2 = x2 + y2;
        const auto at_normal = xy2 > D(0);
        const D inverse = D(1) / select(at_normal, xy2, D(1));
        using V = Product<D, S>;
        const V a =
            schlick_azimuth(D(x2 * inverse), D(select(at_normal, y2 * inverse, D(1))), aniso);
        const V on = V(select(at_normal, D(1), D(0)));
        return a * on + (V(D(1)) - on);
    }
    /// Q without its mirror.
    Product<D, S> directional(const Vec3<D>& wi, const Vec3<D>& wo, const Vec3<D>& h,
                              const S& rough, const S& aniso, const S& mask) const {
        using V = Product<D, S>;
        const V za = schlick_zenith(tangent2(h), rough) * azimuth(h, aniso);
        const V inverse = V(D(0.25 * inv_pi) / at_least(D(wi.z * wo.z), 1e-14));
        const D vi = at_least(wi.z, 1e-7), vo = at_least(wo.z, 1e-7);
        const V g = schlick_masking(vi, mask) * schlick_masking(vo, mask), hidden = V(D(1)) - g;
        const Weights w = weights(rough);
        switch (form) {
            case SchlickForm::reemission:
                return (g * za + hidden) * inverse;
            case SchlickForm::reemission_bounded:
                return g * za * inverse + hidden * V(D(inv_pi));
            case SchlickForm::mixture:
                return V(w.diffuse) * V(D(inv_pi)) + V(w.lobe) * za * inverse;
            case SchlickForm::mixture_reemission:
                return V(w.diffuse) * V(D(inv_pi)) + V(w.lobe) * (g * za + hidden) * inverse;
            case SchlickForm::masked:
                return g * za * inverse;
            case SchlickForm::simple:
                break;
        }
        return za * inverse;
    }
    static D tangent2(const Vec3<D>& h) {
        return (h.x * h.x + h.y * h.y) / at_least(D(h.z * h.z), 1e-12);
    }
    /// Of sampled normals: Z t A^2 / pi.
    D normal_density(const Vec3<D>& h, const S& rough, const S& aniso) const {
        using std::sqrt;
        const D tan2 = tangent2(h), a = azimuth(h, aniso);
        return schlick_zenith(tan2, rough) * a * a * D(inv_pi) / sqrt(D(1) + tan2);
    }
    /// Lobes by their energy at the mirror direction; what is re-emitted by half its layer.
    Shares shares_at(const Vec3<D>& wo) const {
        const D u = at_least(wo.z, 0.);
        const P s = P(colour(u, c));
        const bool reemits = form == SchlickForm::reemission ||
                             form == SchlickForm::reemission_bounded ||
                             form == SchlickForm::mixture_reemission;
        const auto split = [&](D energy, S rough, D& lobe, D& cosine) {
            const Weights w = weights(rough);
            const D re = reemits ? D(0.5) : D(0);
            lobe = energy * D(w.lobe) * (D(1) - re);
            cosine += energy * (D(w.diffuse) + D(w.lobe) * re);
        };
        Shares shares{D(0), D(0), D(0)};
        split(D(mean_of(s)), r, shares.first, shares.cosine);
        if (layers == SchlickLayers::two)
            split(D(mean_of(P((P(1.f) - s) * P(colour(u, c2))))), r2, shares.second, shares.cosine);
        const D sum = shares.cosine + shares.first + shares.second;
        if (!(sum > D(0))) return {D(1), D(0), D(0)};
        return {shares.cosine / sum, shares.first / sum, shares.second / sum};
    }
};

}  // namespace nacre
