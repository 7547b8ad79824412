#include "nacre/measured/model_sum.h"

#include <algorithm>

namespace nacre {

ModelSum::ModelSum(std::vector<ModelTerm> terms, std::string name)
    : terms_(std::move(terms)), name_(std::move(name)) {
    for (const ModelTerm& t : terms_) targets_.emplace_back(t.model, std::string());
}

std::optional<Vec3d> ModelSum::value(const Vec3d& wi, const Vec3d& wo) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    Vec3d sum{};
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        const Vec3d f = *targets_[i].value(wi, wo);
        for (int c = 0; c < 3; ++c) sum[c] += terms_[i].weight[c] * f[c];
    }
    return sum;
}

Vec3d ModelSum::mirror(const Vec3d& w) const {
    Vec3d sum{};
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        const Vec3d m = targets_[i].mirror(w);
        for (int c = 0; c < 3; ++c) sum[c] += terms_[i].weight[c] * m[c];
    }
    return sum;
}

bool ModelSum::isotropic() const {
    return std::all_of(targets_.begin(), targets_.end(),
                       [](const ModelTarget& t) { return t.isotropic(); });
}

}  // namespace nacre
