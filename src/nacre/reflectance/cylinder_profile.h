#pragma once
// The cross-section of parallel cylinders, raised from a floor or cut into it, and the parts of it
// that two directions see: in closed form, without branches on values (model.h).
//
// The cylinders lie along x, their radius is the unit of length, `spacing` is from axis to axis. In
// the plane of y and z the profile is the arc n(t) = (s sin t, cos t) of normals, |t| <= edge, s =
// 1 for raised cylinders and -1 for grooves, and flat beside it. It is a height field: what a
// direction sees of the arc is one interval, since only the nearest neighbour or, in a groove, the
// edge can stand before it; and what two directions see in common is one interval again.
#include "nacre/reflectance/model.h"

namespace nacre {

enum class CylinderProfile { raised, grooved };

namespace cylinder_detail {

template <class T>
T smaller(T a, T b) {
    return select(a < b, a, b);
}
template <class T>
T larger(T a, T b) {
    return select(a > b, a, b);
}

/// What a direction sees of the arc: normals that lean towards its own side of the plane by up to
/// `near` and to the other side by up to `away` (angles; one may be negative); and how long a part
/// of the floor is hidden by the cylinder on its side.
template <class T>
struct Sight {
    T away, near, hidden;
};

/// What two directions see in common: t = middle +- half, and the length of the flat part.
template <class T>
struct Common {
    T middle, half, flat;
};

/// Gauss-Legendre quadrature with 16 nodes: the positive ones and their weights.
inline constexpr double node_weight[8][2] = {
    {0.095012509837637441, 0.18945061045506850}, {0.28160355077925892, 0.18260341504492359},
    {0.45801677765722737, 0.16915651939500254},  {0.61787624440264377, 0.14959598881657674},
    {0.75540440835500300, 0.12462897125553387},  {0.86563120238783176, 0.095158511682492786},
    {0.94457502307323260, 0.062253523938647894}, {0.98940093499164994, 0.027152459411754096}};

}  // namespace cylinder_detail

/// S: the type of the shape (model.h).
template <class S>
struct CylinderSection {
    CylinderProfile profile;
    S spacing;
    S edge;  ///< angle at which the arc ends: at the floor, or where neighbours meet
    S flat;  ///< length between the arcs of a period, 0 if they meet

    CylinderSection() = default;
    CylinderSection(CylinderProfile p, const S& distance, const S& depth)
        : profile(p), spacing(distance) {
        using std::atan2, std::sqrt;
        using namespace cylinder_detail;
        const S chord = S(0.5) * spacing;
        const S half_width = smaller(S(sqrt(at_least(S(depth * (S(2.) - depth)), 1e-24))), chord);
        // Of the middle over the end of the arc.
        const S height =
            larger(S(S(1.) - depth), S(sqrt(at_least(S(S(1.) - chord * chord), 1e-24))));
        edge = atan2(half_width, height);
        flat = larger(S(spacing - S(2.) * half_width), S(0.));
    }

    /// n(t) . w and its derivative by t.
    template <class D, class T>
    Vec2<T> facing(const Vec3<D>& w, const T& sine, const T& cosine) const {
        const D y = profile == CylinderProfile::raised ? w.y : -w.y;
        return {y * sine + w.z * cosine, y * cosine - w.z * sine};
    }

    template <class D>
    cylinder_detail::Sight<Product<D, S>> sight(const Vec3<D>& w) const {
        using std::atan2, std::sin, std::sqrt;
        using namespace cylinder_detail;
        using T = Product<D, S>;
        // Elevation of the direction in the plane.
        const D z = at_least(w.z, 1e-15), y = select(w.y < D(0), -w.y, w.y);
        const D sine = z / sqrt(y * y + z * z);
        const T elevation(atan2(z, y)), end(edge * D(1));
        const T low = smaller(elevation, end);
        if (profile == CylinderProfile::grooved) return {end, T(T(2.) * low - end), T(D(0))};
        // The neighbour's outline is a tangent where the direction is below its slope at the floor.
        const T height = smaller(T(S(0.5) * spacing * sine), T(D(1)));
        const T across =
            T(2.) * atan2(T(sqrt(height)), T(sqrt(at_least(T(T(1.) - height), 1e-15))));
        const T steep = sin(T(T(0.5) * larger(T(end - elevation), T(D(0)))));
        return {low, select(elevation < end, smaller(end, T(across - elevation)), end),
                T(2.) * steep * steep / sine};
    }

    template <class D>
    cylinder_detail::Common<Product<D, S>> common(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using namespace cylinder_detail;
        using T = Product<D, S>;
        const Sight<T> a = sight(wi), b = sight(wo);
        const T low = larger(T(-select(wi.y < D(0), a.near, a.away)),
                             T(-select(wo.y < D(0), b.near, b.away)));
        const T high =
            smaller(select(wi.y < D(0), a.away, a.near), select(wo.y < D(0), b.away, b.near));
        // Hidden from the same side: the longer; from both: one at each end.
        const T hidden =
            select(wi.y * wo.y < D(0), T(a.hidden + b.hidden), larger(a.hidden, b.hidden));
        return {T(0.5) * (low + high), T(0.5) * larger(T(high - low), T(D(0))),
                larger(T(flat - hidden), T(D(0)))};
    }

    /// Integral of (n.wi)(n.wo) over an arc that both see.
    template <class D, class T>
    T matt(const Vec3<D>& wi, const Vec3<D>& wo, const T& middle, const T& half) const {
        using std::cos, std::sin;
        const T sine = sin(middle), cosine = cos(middle);
        const Vec2<T> i = facing(wi, sine, cosine), o = facing(wo, sine, cosine);
        // half -+ sin(2 half)/2; the difference by its series where it would cancel.
        const T x = T(2.) * half, x2 = x * x, wave = T(0.5) * sin(x);
        const T small =
            x * x2 * T(1. / 12.) *
            (T(1.) - x2 * T(1. / 20.) * (T(1.) - x2 * T(1. / 42.) * (T(1.) - x2 * T(1. / 72.))));
        const T odd = select(x < T(0.5), small, T(half - wave));
        return cylinder_detail::larger(T(i.x * o.x * (half + wave) + i.y * o.y * odd), T(D(0)));
    }

    /// Integral of (n.h)^power (n.wi)(n.wo) over an arc that both see, h the half vector. With 16
    /// nodes over that part of it where the power is more than e^-14.5 of its largest: off by less
    /// than 1e-6 of the integral.
    template <class D, class T>
    T glossy(const Vec3<D>& wi, const Vec3<D>& wo, const S& power, const T& middle,
             const T& half) const {
        using std::atan2, std::exp, std::log1p, std::sin, std::sqrt;
        using namespace cylinder_detail;
        // The normal that is nearest to h, n(toward).
        const Vec3<D> h = wi + wo;
        const D hy = profile == CylinderProfile::raised ? h.y : -h.y;
        const D hz = at_least(h.z, 1e-15);
        const D toward = atan2(hy, hz), length2 = hy * hy + hz * hz;
        const D unit = D(1) / sqrt(length2);
        const Vec2<D> i = facing(wi, D(hy * unit), D(hz * unit)),
                      o = facing(wo, D(hy * unit), D(hz * unit));
        const D along = log1p(h.x * h.x / length2) * D(-0.5);  // log of the cosine of h and that
        // By x = sin((t - toward)/2), of which cos(t - toward) = 1 - 2 x^2 keeps its digits.
        const T first = sin(T(T(0.5) * (middle - half - toward))),
                last = sin(T(T(0.5) * (middle + half - toward)));
        const T nearest = larger(first, smaller(last, T(D(0))));
        const T reach =
            sqrt(at_least(T(nearest * nearest + T(7.25) / at_least(T(power * D(1)), 0.5)), 1e-15));
        const T low = larger(first, T(-reach)), high = smaller(last, reach);
        const T centre = T(0.5) * (low + high), radius = T(0.5) * larger(T(high - low), T(D(0)));
        T total(D(0));
        const auto add = [&](double node, double weight) {
            const T x = centre + radius * T(node);
            const T outside = at_least(T(T(1.) - x * x), 1e-15);
            const T versine = smaller(T(T(2.) * x * x), T(D(1. - 1e-6)));
            const T cosine = T(1.) - T(2.) * x * x, root = sqrt(outside);
            const T sine = T(2.) * x * root;
            const T lobe = exp(T(power * T(along + log1p(T(-versine)))));
            total +=
                lobe * (i.x * cosine + i.y * sine) * (o.x * cosine + o.y * sine) * T(weight) / root;
        };
        for (const auto& [node, weight] : node_weight) {
            add(-node, weight);
            add(node, weight);
        }
        return larger(T(T(2.) * radius * total), T(D(0)));
    }
};

}  // namespace nacre
