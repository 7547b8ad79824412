#pragma once
// The directional albedo of perfect mirror facets with the GGX distribution and Smith's
// height-correlated masking: what single scattering leaves of the light.
//
//   E(mu, alpha) = int G2 D / (4 mu cos_o) cos_o dw_o,  mu the cosine of incidence
//
// It has no closed form. Here it is a Chebyshev series in z and alpha, z^2 = mu / (mu + alpha
// sqrt(1 - mu^2)), in which it is smooth both for narrow lobes and at grazing incidence, through
// values from Gauss quadrature over normals. Off by less than 1e-6 for 0.01 <= alpha <= 1.5.
#include <array>
#include <cmath>

#include "nacre/math/lanes.h"

namespace nacre {

namespace ggx_albedo_detail {

inline constexpr int angles = 40, widths = 22, averages = 32;
inline constexpr double widest = 1.5;

struct Table {
    double albedo[widths][angles];  ///< coefficients: of alpha, of z
    double average[averages];       ///< of sqrt(alpha), for 2 int E mu dmu
};
const Table& table();

/// Sum of c_i T_i(x) for i < N, by Clenshaw's recurrence.
template <int N, class X, class C>
X chebyshev(const C& c, X x) {
    X b1 = X(0), b2 = X(0);
    const X two = X(2) * x;
    for (int i = N - 1; i > 0; --i) {
        const X b = two * b1 - b2 + X(c[i]);
        b2 = b1;
        b1 = b;
    }
    return x * b1 - b2 + X(c[0]);
}

}  // namespace ggx_albedo_detail

/// E at a given alpha.
template <class S>
class GgxAlbedo {
  public:
    GgxAlbedo() = default;
    explicit GgxAlbedo(S alpha) : alpha_(alpha) {
        namespace detail = ggx_albedo_detail;
        const detail::Table& t = detail::table();
        const S x = S(2. / detail::widest) * alpha - S(1);
        // T_k(x) for all k once, then a sum over k for each coefficient in z.
        std::array<S, detail::widths> p;
        p[0] = S(1);
        p[1] = x;
        for (int k = 2; k < detail::widths; ++k) p[k] = S(2) * x * p[k - 1] - p[k - 2];
        // Near alpha = 0 the average goes as alpha^2 log(alpha), which wants the root.
        using std::sqrt;
        average_ = detail::chebyshev<detail::averages>(
            t.average, S(2) * sqrt(alpha * S(1. / detail::widest)) - S(1));
        // All sums side by side: the compiler makes packs of them.
        c_.fill(S(0));
        for (int k = 0; k < detail::widths; ++k)
            for (int i = 0; i < detail::angles; ++i) c_[i] += S(t.albedo[k][i]) * p[k];
    }

    /// E, mu > 0 and `sine` those of the angle of incidence.
    template <class D>
    auto operator()(const D& mu, const D& sine) const {
        using std::sqrt;
        using V = decltype(std::declval<D>() * std::declval<S>());
        const V z = sqrt(V(mu) / (V(mu) + V(sine) * V(alpha_)));
        return ggx_albedo_detail::chebyshev<ggx_albedo_detail::angles>(c_, V(V(2) * z - V(1)));
    }
    /// 2 int E mu dmu.
    S average() const { return average_; }

  private:
    S alpha_{}, average_{};
    std::array<S, ggx_albedo_detail::angles> c_{};
};

/// E by quadrature, as the table is built; accurate to about 1e-8.
double ggx_albedo_by_quadrature(double mu, double alpha);

}  // namespace nacre
