#pragma once
// Poulin-Fournier: parallel cylinders on a surface, or grooves cut into it, too small to be seen
// one by one: brushed metal, strands side by side.
//
//   P. Poulin, A. Fournier 1990, A Model for Anisotropic Reflection, SIGGRAPH 90.
//
// The value is the mean over a period of what each point reflects that is both seen and lit, once:
//
//   f = 1/(A cos_i cos_o) integral of f_local (n.wi) (n.wo) over the seen and lit area
//
// with shadows and occlusion by the cylinder itself and its neighbours. As in the paper the matt
// part of the integral is a closed form; for the highlight the paper integrates a Chebyshev
// polynomial, here it is a quadrature that is off by less than 1e-6 (cylinder_profile.h).
//
// Ours are: the normalisation of the local highlight, with which no light is made; that floor and
// cylinders are of one material; and the parameters: lengths in radii of a cylinder, the depth
// measured from the top of a cylinder to the floor, not from its axis. Cylinders that overlap
// (spacing below 2 sqrt(depth (2 - depth))) meet above the floor, which is then not there. What a
// point casts onto another is left out, as in the paper: grooves of white are less than white.
#include "nacre/math/warp.h"
#include "nacre/reflectance/cosine_lobe.h"
#include "nacre/reflectance/cylinder_profile.h"

namespace nacre {

inline const ModelDescription& poulin_fournier_description() {
    static const ModelDescription description{
        .name = "poulin_fournier",
        .title = "Poulin-Fournier",
        .authors = "P. Poulin, A. Fournier",
        .year = 1990,
        .paper = "A Model for Anisotropic Reflection, SIGGRAPH 90",
        .equations = "the integral over the visible and illuminated part of the cylinders",
        .formula =
            "f = 1/(spacing wi.z wo.z) integral of g (n.wi) (n.wo) over the seen and lit part of\n"
            "    a period of the cross-section\n"
            "g = kd/pi + ks (n+2)(n+4) / (8 pi (2^(-n/2) + n)) (n.h)^n\n"
            "cylinders along the tangent: n = (0, +-sin t, cos t), and the normal between them\n"
            "raised, from the elevation e in the plane across: seen for t > -e and, below the\n"
            "    slope at the floor, t < 2 arcsin sqrt(spacing sin(e)/2) - e\n"
            "grooved, of half angle T: seen for t < 2 e - T",
        .parameters =
            {choice_parameter("profile", "what stands in the surface",
                              {{"raised", "cylinders above a floor", {"positive"}},
                               {"grooved", "cylinders cut into it", {"negative"}}}),
             diffuse_parameter(0.2),
             specular_parameter(0.7),
             {.name = "n",
              .meaning = "exponent of the highlight at each point, as of blinn_phong",
              .high = 1e6,
              .otherwise = 200.,
              .aliases = {"exponent"}},
             {.name = "spacing",
              .meaning = "distance between the axes of neighbouring cylinders",
              .unit = "radii",
              .low = 0.1,
              .high = 1000.,
              .otherwise = 2.},
             {.name = "depth",
              .meaning = "from the tops of the cylinders to the floor, or from the surface to the "
                         "bottom of the grooves; 0 is flat, and neighbours that meet earlier "
                         "leave less",
              .unit = "radii",
              .otherwise = 0.5}},
        .bounds = {{.parameters = {"kd", "ks"}}},
        .behaviours = {{.energy_note = "for kd + ks <= 1: what is cast from point to point is lost",
                        .examples = {"kd=0.3 ks=0.7 n=30 spacing=2.3 depth=0.6",
                                     "kd=0 ks=1 n=100 spacing=2 depth=1",
                                     "kd=0.5 ks=0.5 n=8 spacing=0.8 depth=1",
                                     "profile=grooved kd=0.3 ks=0.7 n=30 spacing=2.3 depth=0.6"}}},
        .isotropy = "anisotropic; the cylinders lie along the tangent; isotropic for depth = 0",
        .sampling =
            "one-sample mixture of the cosine and, with probability ks/(kd+ks), half "
            "vectors about the normals that the viewer sees, their angles in and out of "
            "the plane across drawn with tangents of Student's distribution with two "
            "degrees of freedom",
        .albedo = "depth = 0: that of blinn_phong",
        .references = {"P. Poulin, A. Fournier 1990, SIGGRAPH 90, 273-282"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct PoulinFournier {
    CylinderProfile profile;
    P kd, ks;
    S n, spacing, depth;

    static const ModelDescription& describe() { return poulin_fournier_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("profile", m.profile);
        f("kd", m.kd);
        f("ks", m.ks);
        f("n", m.n);
        f("spacing", m.spacing);
        f("depth", m.depth);
    }
    void prepare() {
        section_ = CylinderSection<S>(profile, spacing, depth);
        norm_ = blinn_normalization(n);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using T = Product<D, S>;
        const auto seen = section_.common(wi, wo);
        const T area = spacing * at_least(D(wi.z * wo.z), 1e-30), share = seen.flat / spacing;
        const T matt = section_.matt(wi, wo, seen.middle, seen.half) / area + share;
        const T glossy = section_.glossy(wi, wo, n, seen.middle, seen.half) / area +
                         share * half_cosine_power(wi, wo, n);
        return above(wi, wo) * (T(S(inv_pi) * matt) * kd + T(norm_ * glossy) * ks);
    }

    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        using std::sin, std::cos;
        const D share = D(specular_share(kd, ks));
        if (!(u1 < share)) return square_to_cosine_hemisphere(u2);
        const Seen seen = seen_from(wo);
        const D u = u1 / share;
        const D t = u < seen.flat
                        ? D(0)
                        : seen.low + (seen.high - seen.low) * (u - seen.flat) / (D(1) - seen.flat);
        const Vec2<D> across = draw(u2.x, across_width2()), along = draw(u2.y, along_width2());
        const D sine = sin(t) * across.y + cos(t) * across.x,
                cosine = cos(t) * across.y - sin(t) * across.x;
        const D y = profile == CylinderProfile::raised ? sine : -sine;
        const Vec3<D> h{along.x, along.y * y, along.y * cosine};
        return dot(wo, h) > D(0) ? reflect(wo, h) : Vec3<D>{D(0), D(0), D(-1)};
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::atan2, std::sqrt;
        const Vec3<D> h = half_vector(wi, wo);
        const Seen seen = seen_from(wo);
        const D y = profile == CylinderProfile::raised ? h.y : -h.y;
        const D t = atan2(y, at_least(h.z, 1e-15)), g2 = across_width2();
        // The mean over the arc, or the middle of an arc narrower than the lobe.
        const D width = seen.high - seen.low, first = t - seen.high, last = t - seen.low;
        const D mean = (below(last, g2) - below(first, g2)) / at_least(width, 1e-15);
        const D across =
            select(width * width < D(1e-4) * g2, density(D(D(0.5) * (first + last)), g2), mean);
        const D flat = density(t, g2), g2_along = along_width2();
        // Along the cylinders the angle's density over its cosine, that of a solid angle.
        const D x2 = h.x * h.x, spread = g2_along * (D(1) - x2) + x2;
        const D along = D(0.5) * g2_along / at_least(D(spread * sqrt(spread)), 1e-30);
        const D lobe = (seen.flat * flat + (D(1) - seen.flat) * across) * along /
                       at_least(D(D(4) * dot(wi, h)), 1e-7);
        const D share = D(specular_share(kd, ks));
        return above(wi, wo) * (share * lobe + (D(1) - share) * D(inv_pi) * wi.z);
    }

  private:
    CylinderSection<S> section_;
    S norm_;

    /// The normals that a direction sees: on the arc from `low` to `high`, and the surface's own,
    /// with its share of the area as it is seen.
    struct Seen {
        D low, high, flat;
    };
    Seen seen_from(const Vec3<D>& w) const {
        using namespace cylinder_detail;
        const auto s = section_.sight(w);
        const D low = select(w.y < D(0), D(-s.near), D(-s.away)),
                high = select(w.y < D(0), D(s.away), D(s.near));
        return {low, larger(low, high), larger(D(section_.flat - s.hidden), D(0)) / D(spacing)};
    }

    // Angles whose tangents over g have Student's distribution with two degrees of freedom, which
    // needs no transcendental function and has its middle as narrow as, and its tails above, the
    // powers n and n + 1 of a cosine that the lobe is across and along the cylinders.
    D across_width2() const { return D(3) / D(n + S(2)); }
    D along_width2() const { return D(3) / D(n + S(3)); }
    /// Sine and cosine of such an angle.
    static Vec2<D> draw(D u, D g2) {
        using std::sqrt;
        const D v = D(2) * u - D(1);
        const D x = sqrt(g2) * v, y = sqrt(at_least(D(D(1) - v * v), 0.));
        const D scale = D(1) / sqrt(x * x + y * y);
        return {x * scale, y * scale};
    }
    static D density(D angle, D g2) {
        using std::cos, std::sin, std::sqrt;
        const D c = cos(angle), s = sin(angle), spread = g2 * c * c + s * s;
        return D(0.5) * g2 * at_least(c, 0.) / at_least(D(spread * sqrt(spread)), 1e-30);
    }
    /// Probability of a smaller angle, less 1/2.
    static D below(D angle, D g2) {
        using std::cos, std::sin, std::sqrt;
        const D c = at_least(cos(angle), 0.), s = sin(angle);
        return D(0.5) * s / sqrt(g2 * c * c + s * s);
    }
};

}  // namespace nacre
