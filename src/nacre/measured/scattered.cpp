#include "nacre/measured/scattered.h"

#include <numbers>

#include "nacre/measured/half_angle.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int neighbours = 8;
/// Pairs nearer than this are the same one: angles differ by less than 1e-6.
constexpr double same = 1e-6;

}  // namespace

PointTree::Point scattered_place(const Vec3d& wi, const Vec3d& given, bool isotropic) {
    const Vec3d wo{given.x, given.y, std::abs(given.z)};
    const Vec3d sum = wi + wo;
    const Vec3d h = normalize(sum);
    const double theta_h = std::atan2(std::hypot(h.x, h.y), h.z);
    const double stretched = std::sqrt(theta_h * (2. / pi));
    const Vec3d apart = (wi - wo) * 0.5;
    if (!isotropic) {
        const double across = std::hypot(h.x, h.y);
        const double s = across > 0. ? stretched / across : 0.;
        return {s * h.x, s * h.y, apart.x, apart.y};
    }
    const double theta_d = std::atan2(length(apart), 0.5 * length(sum));
    return {stretched, theta_d * (2. / pi), apart.z, 0.};
}

bool ScatteredMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    if (!(wi.z > 0.) || wo.z == 0.) return false;
    const Side& side = side_of(wo);
    if (side.tree.size() == 0 || wi.z < side.least_in || std::abs(wo.z) < side.least_out)
        return false;
    PointTree::Near near[neighbours + 1];
    const int count =
        side.tree.nearest(scattered_place(wi, wo, info_.isotropic), neighbours + 1, near);
    // From directions that are not numbers nothing is near.
    if (count == 0 || !(near[0].distance <= reach_)) return false;
    double weight[neighbours + 1] = {};
    double sum = 0.;
    if (near[0].distance < same) {  // measured, perhaps several times
        for (int i = 0; i < count && near[i].distance < same; ++i) sum += weight[i] = 1.;
    } else {
        const double last = near[count - 1].distance;
        const double far = count > neighbours ? last : 2. * last;
        for (int i = 0; i < std::min(count, neighbours); ++i) {
            const double w = std::max(far - near[i].distance, 0.) / (far * near[i].distance);
            sum += weight[i] = w * w;
        }
        if (!(sum > 0.))  // all equally far
            for (int i = 0; i < std::min(count, neighbours); ++i) sum += weight[i] = 1.;
    }
    const std::size_t n = std::size_t(info_.channels);
    std::fill_n(out.begin(), n, 0.);
    for (int i = 0; i < count; ++i) {
        if (weight[i] == 0.) continue;
        const double* v = values_.data() + side.pair[near[i].index] * n;
        for (std::size_t c = 0; c < n; ++c) out[c] += weight[i] * v[c];
    }
    for (std::size_t c = 0; c < n; ++c) out[c] /= sum;
    return true;
}

void ScatteredMeasured::for_each_sample(
    const std::function<void(const MeasuredSample&)>& visit) const {
    const std::size_t n = std::size_t(info_.channels);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        visit({pairs_[i].wi, pairs_[i].wo, pairs_[i].state,
               std::span<const double>(values_.data() + i * n, n)});
}

ScatteredMeasured::Side ScatteredMeasured::make_side(bool reflection) const {
    Side side;
    std::vector<PointTree::Point> points;
    double in = 1., out = 1.;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const Pair& p = pairs_[i];
        if (p.state == SampleState::missing || (p.wo.z > 0.) != reflection) continue;
        points.push_back(scattered_place(p.wi, p.wo, info_.isotropic));
        side.pair.push_back(std::uint32_t(i));
        in = std::min(in, p.wi.z);
        out = std::min(out, std::abs(p.wo.z));
    }
    side.tree = PointTree(std::move(points));
    const auto a_degree_lower = [](double z) {
        return std::cos(std::min(std::acos(std::min(z, 1.)) + pi / 180., 0.5 * pi));
    };
    side.least_in = a_degree_lower(in);
    side.least_out = a_degree_lower(out);
    return side;
}

ScatteredBuilder::ScatteredBuilder(MeasuredInfo info) : data_(new ScatteredMeasured) {
    data_->info_ = std::move(info);
}

MeasuredInfo& ScatteredBuilder::info() { return data_->info_; }

void ScatteredBuilder::add(const Vec3d& wi, const Vec3d& wo, std::span<const double> value,
                           bool known) {
    bool negative = false;
    for (const double v : value) {
        known = known && !std::isnan(v);
        negative = negative || v < 0.;
        data_->values_.push_back(v);
    }
    data_->pairs_.push_back({wi, wo,
                             !known     ? SampleState::missing
                             : negative ? SampleState::negative
                                        : SampleState::good});
}

std::unique_ptr<Measured> ScatteredBuilder::build(const MeasuredSource& source, double reach) {
    if (data_->pairs_.empty()) source.fail("holds no samples; it is incomplete: fetch it again");
    data_->reach_ = reach;
    data_->reflection_ = data_->make_side(true);
    data_->transmission_ = data_->make_side(false);
    data_->info_.reflection_front = data_->reflection_.tree.size() > 0;
    data_->info_.transmission_front = data_->transmission_.tree.size() > 0;
    if (!data_->info_.reflection_front && !data_->info_.transmission_front)
        source.fail(
            fmt::format("has {} samples, but none of them is a measurement", data_->pairs_.size()));
    data_->count_samples();
    return std::move(data_);
}

}  // namespace nacre
