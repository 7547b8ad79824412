#include "nacre/measured/factor/factored_measured.h"

#include <fmt/format.h>

namespace nacre {

FactoredMeasured::FactoredMeasured(FactoredBrdf brdf) : brdf_(std::move(brdf)) {
    const bool half = brdf_.grid().parameters == FactorParameters::half_difference;
    const std::size_t terms = brdf_.terms().size();
    info_.format = "factors";
    info_.description = brdf_.name();
    info_.parameterisation =
        fmt::format("{} product{} of two textures of {} x {} texels, one over {}", terms,
                    terms == 1 ? "" : "s", brdf_.grid().side, brdf_.grid().side,
                    half ? "the half, one over the difference vector"
                         : "the light's direction, one over the viewer's");
    info_.scale = brdf_.logarithmic() ? "the sum of products is the logarithm of sr^-1" : "sr^-1";
    info_.isotropic = brdf_.isotropic();
    count_samples();
}

bool FactoredMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    const auto value = brdf_.value(wi, wo);
    if (!value) return false;
    for (int c = 0; c < 3; ++c) out[c] = (*value)[c];
    return true;
}

bool FactoredMeasured::eval_float(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const {
    const auto value = brdf_.value_float(wi, wo);
    if (!value) return false;
    for (int c = 0; c < 3; ++c) out[c] = (*value)[c];
    return true;
}

void FactoredMeasured::for_each_sample(
    const std::function<void(const MeasuredSample&)>& visit) const {
    const FactorGrid& grid = brdf_.grid();
    for (int k = 0; k < grid.count(); ++k)
        for (int l = 0; l < grid.count(); ++l) {
            const DirectionPair pair = grid.pair(grid.row(k), grid.column(l));
            const auto value = brdf_.value(pair.wi, pair.wo);
            const Vec3d v = value.value_or(Vec3d());
            const double channels[3] = {v.x, v.y, v.z};
            visit({pair.wi, pair.wo, value ? SampleState::good : SampleState::missing, channels});
        }
}

}  // namespace nacre
