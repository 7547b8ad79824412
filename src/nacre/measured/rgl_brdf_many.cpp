// RglBrdf for many pairs of directions: sixteen go through each step together.
#include <algorithm>
#include <limits>

#include "nacre/measured/rgl_brdf.h"
#include "nacre/measured/warp_packs.h"

namespace nacre {
namespace {

/// Adds `weight` times a table's values of `n` channels.
template <int fixed>
void add_weighted(const float* from, float weight, int n, float* to) {
    for (int c = 0; c < (fixed ? fixed : n); ++c) to[c] += weight * from[c];
}

/// Places in a table are gathered by 32-bit numbers.
bool can_gather(const RglTables& t) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    return std::max(t.vndf.values().size(), t.luminance.values().size()) <= most;
}

}  // namespace

/// The steps of single calls in rgl_brdf.cpp, over packs.
struct RglBrdf::Packs {
    const RglBrdf& f;
    const RglTables& t = f.t_;

    struct Given {
        PackVec w;
        Pack sign_x, sign_y;
        PackPolar at;
        PackMix mix;
    };
    struct Half {
        Pack x, y, sin_theta, given_h;
    };

    Given place(const PackVec& given) const {
        Given g;
        g.w = given;
        g.sign_x = g.sign_y = Pack(1.f);
        if (f.reduction_ >= 2) {
            g.sign_y = if_else(given.y * Pack(f.sign_y_) < Pack(0.f), -1.f, 1.f);
            g.sign_x = f.reduction_ >= 4 ? if_else(given.x * Pack(f.sign_x_) < Pack(0.f), -1.f, 1.f)
                                         : g.sign_y;
            g.w.x *= g.sign_x;
            g.w.y *= g.sign_y;
        }
        g.at = polar_of(g.w);
        g.mix = slices_at(t.incidence, g.at.phi, g.at.theta);
        return g;
    }
    Half half(const Given& g, const PackVec& other) const {
        const PackVec h =
            normalized(g.w + PackVec(other.x * g.sign_x, other.y * g.sign_y, other.z));
        const PackPolar at = polar_of(h);
        return {square_x(at.theta), square_y(f.isotropic_ ? at.phi - g.at.phi : at.phi),
                sin_theta_of(h), dot(g.w, h)};
    }
    Pack factor(const Given& g, Pack x, Pack y) const {
        if (!t.jacobian) return Pack(1.f);
        return nacre::eval(t.ndf, x, y) /
               (Pack(4.f) * nacre::eval(t.sigma, square_x(g.at.theta), square_y(g.at.phi)));
    }

    /// `scale` times the spectra at (u, v), 0 where that is not above 0; `n` is the number of
    /// channels, if known.
    template <int fixed>
    void look_up(const PackMix& mix, Pack u, Pack v, Pack scale, int count, float* out) const {
        const int n = fixed ? fixed : t.channels, row = t.width * n;
        const auto place_on = [](Pack u, int nodes) {
            return select(u > Pack(0.f), u * Pack(nodes - 1), Pack(0.f));
        };
        const Pack px = place_on(u, t.width), py = place_on(v, t.height);
        const auto below = [](Pack p, int nodes) {
            return to_ints(min(p, Pack(float(nodes - 2))));
        };
        const PackInts x = below(px, t.width), y = below(py, t.height);
        const Pack tx = px - to_floats<pack_size>(x), ty = py - to_floats<pack_size>(y);
        const Pack one(1.f), corner[4] = {scale * (one - tx) * (one - ty), scale * tx * (one - ty),
                                          scale * (one - tx) * ty, scale * tx * ty};
        for (int i = 0; i < count; ++i) {
            float* to = out + std::size_t(i) * n;
            std::fill_n(to, n, 0.f);
            for (int k = 0; k < mix.count; ++k) {
                const float w = mix.weight[k][i];
                const std::size_t node =
                    (std::size_t(mix.slice[k][i]) * t.height + y[i]) * t.width + x[i];
                const float* s = t.spectra.data() + node * n;
                add_weighted<fixed>(s, w * corner[0][i], n, to);
                add_weighted<fixed>(s + n, w * corner[1][i], n, to);
                add_weighted<fixed>(s + row, w * corner[2][i], n, to);
                add_weighted<fixed>(s + row + n, w * corner[3][i], n, to);
            }
        }
    }

    /// Both directions may be below the horizon: `known` says which pairs are not.
    void eval(const PackVec& given, const PackVec& other, int count, float* out, float* pdf) const {
        const PackMask known = above(given) & above(other);
        const Given g = place(given);
        const Half h = half(g, other);
        const PackPoint at = invert(t.vndf, h.x, h.y, g.mix);
        if (out) {
            // Nothing of what is not known may come near the sums.
            const Pack scale = select(known, factor(g, h.x, h.y), Pack(0.f));
            t.channels == 3 ? look_up<3>(g.mix, at.x, at.y, scale, count, out)
                            : look_up<0>(g.mix, at.x, at.y, scale, count, out);
        }
        if (pdf) {
            const Pack d = at.density * density(t.luminance, at.x, at.y, g.mix) /
                           reflected_solid_angle(h.x, h.sin_theta, h.given_h);
            store(select(known, d, Pack(0.f)), pdf, count);
        }
    }

    PackVec sample(const PackVec& given, Pack u, Pack v) const {
        const Given g = place(given);
        const PackPoint bright = nacre::sample(t.luminance, u, v, g.mix);
        const PackPoint at = nacre::sample(t.vndf, bright.x, bright.y, g.mix);
        const PackVec h = square_vector(at.x, at.y, f.isotropic_ ? g.at.phi : Pack(0.f));
        const Pack given_h = dot(g.w, h);
        const PackVec w = h * (Pack(2.f) * given_h) - g.w;
        const PackMask drawn = above(given) & above(w) & (given_h > Pack(0.f));
        const Pack nothing(0.f);
        return {select(drawn, w.x * g.sign_x, nothing), select(drawn, w.y * g.sign_y, nothing),
                select(drawn, w.z, nothing)};
    }
};

void RglBrdf::eval_many(std::span<const Vec3f> given, std::span<const Vec3f> other,
                        std::span<float> out, std::span<float> pdf) const {
    const std::size_t n = std::size_t(t_.channels);
    if (!can_gather(t_)) {
        for (std::size_t i = 0; i < given.size(); ++i) {
            const auto row = out.empty() ? out : out.subspan(i * n, n);
            const auto density = eval_pdf(given[i], other[i], row);
            if (!density) std::ranges::fill(row, 0.f);
            if (!pdf.empty()) pdf[i] = density.value_or(0.f);
        }
        return;
    }
    const Packs packs{*this};
    for_each_pack(given.size(), [&](std::size_t i, int count) {
        packs.eval(load(&given[i], count), load(&other[i], count), count,
                   out.empty() ? nullptr : &out[i * n], pdf.empty() ? nullptr : &pdf[i]);
    });
}

void RglBrdf::sample_many(std::span<const Vec3f> given, std::span<const Vec2f> u,
                          std::span<Vec3f> other) const {
    if (!can_gather(t_)) {
        for (std::size_t i = 0; i < given.size(); ++i) {
            const auto s = sample(given[i], u[i].x, u[i].y);
            other[i] = s ? s->direction : Vec3f{};
        }
        return;
    }
    const Packs packs{*this};
    for_each_pack(given.size(), [&](std::size_t i, int count) {
        const Vec2<Pack> at = load(&u[i], count);
        store(packs.sample(load(&given[i], count), at.x, at.y), &other[i], count);
    });
}

}  // namespace nacre
