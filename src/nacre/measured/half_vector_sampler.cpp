#include "nacre/measured/half_vector_sampler.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "nacre/math/warp.h"
#include "nacre/measured/half_vector_square.h"

namespace nacre {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Viewers every 4 degrees, and every 22.5 of azimuth where that matters; half vectors as finely as
// RGL's own tables (32 x 32).
constexpr int nodes = 32, thetas = 23, phis = 17;

std::vector<float> evenly(float first, float last, int count) {
    std::vector<float> values(count);
    for (int i = 0; i < count; ++i)
        values[i] = first + (last - first) * float(i) / float(count - 1);
    return values;
}

Vec3f reflected(const Vec3f& w, const Vec3f& h) { return h * (2.f * dot(w, h)) - w; }

}  // namespace

HalfVectorSampler::HalfVectorSampler(const std::function<double(const Vec3f&, const Vec3f&)>& value,
                                     bool isotropic)
    : isotropic_(isotropic),
      viewers_(isotropic ? std::vector<float>{0.f} : evenly(-pi, pi, phis),
               evenly(0.f, 88.f * pi / 180.f, thetas)) {
    const std::size_t slice = std::size_t(nodes) * nodes;
    std::vector<float> table(viewers_.size() * slice);
    std::vector<double> sums(viewers_.size());
    tbb::parallel_for(std::size_t{0}, viewers_.size(), [&](std::size_t k) {
        const float theta = viewers_.fast()[k % thetas];
        const float azimuth = viewers_.slow()[k / thetas];
        const Vec3f wo{std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
                       std::cos(theta)};
        for (int y = 0; y < nodes; ++y)
            for (int x = 0; x < nodes; ++x) {
                const float u = float(x) / (nodes - 1);
                const Vec3f h = square_vector(u, float(y) / (nodes - 1), isotropic ? azimuth : 0.f);
                const Vec3f wi = reflected(wo, h);
                const float wo_h = dot(wo, h);
                if (!(wi.z > 0.f && wo_h > 0.f)) continue;
                const double v = std::max(value(wi, wo), 0.);
                const double w = v * reflected_solid_angle(u, sin_theta_of(h), wo_h);
                table[k * slice + std::size_t(y) * nodes + x] = float(w);
                sums[k] += w;
            }
    });
    double weights = 0.;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const double theta = viewers_.fast()[k % thetas], weight = std::sin(2. * theta);
        mean_ += weight * sums[k] / double((nodes - 1) * (nodes - 1));
        weights += weight;
    }
    mean_ /= weights;
    warp_ = MarginalWarp(nodes, nodes, std::move(table));
}

Vec3f HalfVectorSampler::sample(const Vec3f& wo, float u1, Vec2f u2) const {
    if (u1 < by_cosine) return square_to_cosine_hemisphere(u2);
    const Polar viewer = polar_of(wo, wo)[0];
    const auto at = warp_.sample(u2.x, u2.y, viewers_.at(viewer.phi, viewer.theta));
    return reflected(wo, square_vector(at.x, at.y, isotropic_ ? viewer.phi : 0.f));
}

float HalfVectorSampler::pdf(const Vec3f& wi, const Vec3f& wo) const {
    if (!(wi.z > 0.f && wo.z > 0.f)) return 0.f;
    const Vec3f h = normalize(wi + wo);
    const auto [viewer, half] = polar_of(wo, h);
    const float x = square_x(half.theta), y = square_y(half.phi - (isotropic_ ? viewer.phi : 0.f));
    const SliceMix mix = viewers_.at(viewer.phi, viewer.theta);
    return by_cosine * wi.z / pi + (1.f - by_cosine) * warp_.density(x, y, mix) /
                                       reflected_solid_angle(x, sin_theta_of(h), dot(wo, h));
}

}  // namespace nacre
