#include "nacre/measured/factor/brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

/// The four texels around a place and their weights.
template <class T>
struct Lookup {
    std::array<int, 4> texel;
    std::array<T, 4> weight;

    Lookup(const Vec2<T>& place, int side) {
        // What is no number stands at 0.
        const auto along = [side](T at) { return (at > T(0) ? at : T(0)) * side - T(0.5); };
        const T x = along(place.x), y = along(place.y);
        const T left = std::floor(x), top = std::clamp(std::floor(y), T(0), T(side - 1));
        const T fx = x - left, fy = std::clamp(y - top, T(0), T(1));
        const int x0 = (int(left) + side) % side, x1 = (x0 + 1) % side;
        const int y0 = int(top), y1 = std::min(y0 + 1, side - 1);
        texel = {side * x0 + y0, side * x1 + y0, side * x0 + y1, side * x1 + y1};
        weight = {(T(1) - fx) * (T(1) - fy), fx * (T(1) - fy), (T(1) - fx) * fy, fx * fy};
    }
    Vec3<T> at(const FactorTexture& t) const {
        Vec3<T> sum;
        for (int i = 0; i < 4; ++i) sum += Vec3<T>(t[texel[i]]) * weight[i];
        return sum;
    }
};

}  // namespace

FactoredBrdf::FactoredBrdf(const FactorGrid& grid, std::vector<FactorTerm> terms, bool logarithmic,
                           std::string name, bool isotropic)
    : grid_(grid),
      terms_(std::move(terms)),
      logarithmic_(logarithmic),
      name_(std::move(name)),
      isotropic_(isotropic) {
    if (terms_.empty()) throw InputError(fmt::format("{}: has no factors", name_));
    for (const FactorTerm& t : terms_)
        for (const FactorTexture* texture : {&t.g, &t.h})
            if (int(texture->size()) != grid_.count())
                throw InputError(fmt::format("{}: a factor has {} texels, not {} x {}", name_,
                                             texture->size(), grid_.side, grid_.side));
}

template <class T>
std::optional<Vec3<T>> FactoredBrdf::sum(const Vec3<T>& wi, const Vec3<T>& wo) const {
    if (!(wi.z > T(0) && wo.z > T(0))) return std::nullopt;
    const FactorPlaces<T> places = factor_places(grid_.parameters, wi, wo);
    const Lookup<T> row(places.row, grid_.side), column(places.column, grid_.side);
    Vec3<T> sum;
    for (const FactorTerm& t : terms_) {
        const Vec3<T> g = row.at(t.g), h = column.at(t.h);
        sum += Vec3<T>{g.x * h.x, g.y * h.y, g.z * h.z};
    }
    for (int c = 0; c < 3; ++c) sum[c] = logarithmic_ ? std::exp(sum[c]) : std::max(sum[c], T(0));
    return sum;
}

std::optional<Vec3d> FactoredBrdf::value(const Vec3d& wi, const Vec3d& wo) const {
    return sum(wi, wo);
}
std::optional<Vec3f> FactoredBrdf::value_float(const Vec3f& wi, const Vec3f& wo) const {
    return sum(wi, wo);
}

}  // namespace nacre
