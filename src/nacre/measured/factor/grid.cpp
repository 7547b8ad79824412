#include "nacre/measured/factor/grid.h"

#include <numbers>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

double theta_of(double t, bool squared) { return 0.5 * pi * (squared ? t * t : t); }

Vec3d direction(int k, int side, bool squared) {
    const double phi = 2. * pi * (k / side + 0.5) / side;
    const double theta = theta_of((k % side + 0.5) / side, squared);
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

double solid_angle(int k, int side, bool squared) {
    const int r2 = k % side;
    return 2. * pi / side *
           (std::cos(theta_of(double(r2) / side, squared)) -
            std::cos(theta_of(double(r2 + 1) / side, squared)));
}

template <class T>
struct Frame {
    Vec3<T> x, y;
    explicit Frame(const Vec3<T>& h) {
        const Vec3<T> t = Vec3<T>{T(1), T(0), T(0)} - h * h.x;
        const T size = length(t);
        // Of the tangent itself nothing is left: any perpendicular will do.
        x = size > T(1e-9) ? t / size : Vec3<T>{T(0), T(0), T(-1)};
        y = cross(h, x);
    }
};

template <class T>
Vec2<T> place(const Vec3<T>& w, bool squared) {
    const T phi = std::atan2(w.y, w.x) / T(2. * pi);
    const T theta = std::atan2(std::hypot(w.x, w.y), w.z) / T(0.5 * pi);
    return {phi < T(0) ? phi + T(1) : phi, squared ? std::sqrt(theta) : theta};
}

bool squares(FactorParameters p) { return p == FactorParameters::half_difference; }

}  // namespace

std::string_view name_of(FactorParameters parameters) {
    return parameters == FactorParameters::in_out ? "in_out" : "half_difference";
}

Vec3d FactorGrid::row(int k) const { return direction(k, side, squares(parameters)); }
Vec3d FactorGrid::column(int l) const { return direction(l, side, false); }
double FactorGrid::row_weight(int k) const {
    return solid_angle(k, side, squares(parameters)) * row(k).z;
}
double FactorGrid::column_weight(int l) const { return solid_angle(l, side, false) * column(l).z; }

DirectionPair FactorGrid::pair(const Vec3d& row, const Vec3d& column) const {
    if (parameters == FactorParameters::in_out) return {row, column};
    const Frame<double> frame(row);
    const Vec3d across = frame.x * column.x + frame.y * column.y, along = row * column.z;
    return {along + across, along - across};
}

double FactorGrid::measure(int k, int l) const {
    const Vec3d x = row(k), y = column(l);
    const double weight = row_weight(k) * column_weight(l);
    if (parameters == FactorParameters::in_out) return weight;
    const DirectionPair w = pair(x, y);
    if (!(w.wi.z > 0. && w.wo.z > 0.)) return 0.;
    // dwi dwo = 4 cos(theta_d) dh dd; the weight has cos(theta_h) besides.
    return 4. * weight / x.z * w.wi.z * w.wo.z;
}

template <class T>
FactorPlaces<T> factor_places(FactorParameters parameters, const Vec3<T>& wi, const Vec3<T>& wo) {
    if (parameters == FactorParameters::in_out) return {place(wi, false), place(wo, false)};
    const Vec3<T> h = normalize(wi + wo);
    const Frame<T> frame(h);
    return {place(h, true), place<T>({dot(wi, frame.x), dot(wi, frame.y), dot(wi, h)}, false)};
}
template FactorPlaces<float> factor_places(FactorParameters, const Vec3f&, const Vec3f&);
template FactorPlaces<double> factor_places(FactorParameters, const Vec3d&, const Vec3d&);

}  // namespace nacre
