#include "nacre/measured/klems_sampler.h"

namespace nacre {

KlemsSampler::KlemsSampler(const KlemsMeasured& data) : data_(&data) {
    using K = KlemsMeasured;
    front_ = {make_part(data.matrix(K::reflection_front), true),
              make_part(data.matrix(K::transmission_back), false)};
    back_ = {make_part(data.matrix(K::reflection_back), false),
             make_part(data.matrix(K::transmission_front), true)};
}

KlemsSampler::Part KlemsSampler::make_part(const KlemsMatrix& matrix, bool from_front) {
    Part part{&matrix, from_front, std::vector<float>(matrix.value.size())};
    const int n = matrix.in.size();
    std::vector<double> size;
    for (int i = 0; i < n; ++i) size.push_back(matrix.in.projected_solid_angle(i));
    double sum = 0.;
    for (std::size_t k = 0; k < matrix.value.size(); ++k) {
        const int i = int(k) % n;
        sum = (i ? sum : 0.) + std::max(matrix.value[k], 0.) * size[std::size_t(i)];
        part.up_to[k] = float(sum);
    }
    return part;
}

const float* KlemsSampler::Part::row(const Vec3f& wo) const {
    return up_to.data() + std::size_t(matrix->out.patch_of(Vec3d(wo), false)) * matrix->in.size();
}

float KlemsSampler::Part::light(const Vec3f& wo) const {
    return up_to.empty() ? 0.f : row(wo)[matrix->in.size() - 1];
}

std::optional<Vec3f> KlemsSampler::sample(const Vec3f& wo, float u1, Vec2f u2) const {
    if (wo.z == 0.f) return std::nullopt;
    const Side& side = side_of(wo);
    const float reflected = side.reflected.light(wo), passed = side.passed.light(wo);
    const float at = u1 * (reflected + passed);
    const Part& part = at < reflected ? side.reflected : side.passed;
    const float rest = at < reflected ? at : at - reflected;
    if (!(part.light(wo) > 0.f)) return std::nullopt;
    const float* row = part.row(wo);
    const int last = part.matrix->in.size() - 1;
    const int i = int(std::upper_bound(row, row + last, rest) - row);
    const KlemsBasis& in = part.matrix->in;
    return Vec3f(KlemsBasis::direction(in.within(i, u2.x, u2.y), true, part.from_front));
}

float KlemsSampler::pdf(const Vec3f& wi, const Vec3f& wo) const {
    double value;
    if (!data_->eval(Vec3d(wi), Vec3d(wo), std::span<double>(&value, 1)) || !(value > 0.))
        return 0.f;
    const Side& side = side_of(wo);
    return float(value) * std::abs(wi.z) / (side.reflected.light(wo) + side.passed.light(wo));
}

}  // namespace nacre
