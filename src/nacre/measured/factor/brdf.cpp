#include "nacre/measured/factor/brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

/// The four texels around a place and their weights.
struct Lookup {
    std::array<int, 4> texel;
    std::array<double, 4> weight;

    Lookup(const Vec2<double>& place, int side) {
        const double x = place.x * side - 0.5, y = place.y * side - 0.5;
        const double left = std::floor(x), top = std::clamp(std::floor(y), 0., side - 1.);
        const double fx = x - left, fy = std::clamp(y - top, 0., 1.);
        const int x0 = (int(left) + side) % side, x1 = (x0 + 1) % side;
        const int y0 = int(top), y1 = std::min(y0 + 1, side - 1);
        texel = {side * x0 + y0, side * x1 + y0, side * x0 + y1, side * x1 + y1};
        weight = {(1. - fx) * (1. - fy), fx * (1. - fy), (1. - fx) * fy, fx * fy};
    }
    Vec3d at(const FactorTexture& t) const {
        Vec3d sum;
        for (int i = 0; i < 4; ++i) sum += Vec3d(t[texel[i]]) * weight[i];
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

std::optional<Vec3d> FactoredBrdf::value(const Vec3d& wi, const Vec3d& wo) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    const FactorPlaces places = factor_places(grid_.parameters, wi, wo);
    const Lookup row(places.row, grid_.side), column(places.column, grid_.side);
    Vec3d sum;
    for (const FactorTerm& t : terms_) {
        const Vec3d g = row.at(t.g), h = column.at(t.h);
        sum += Vec3d{g.x * h.x, g.y * h.y, g.z * h.z};
    }
    for (int c = 0; c < 3; ++c) sum[c] = logarithmic_ ? std::exp(sum[c]) : std::max(sum[c], 0.);
    return sum;
}

}  // namespace nacre
