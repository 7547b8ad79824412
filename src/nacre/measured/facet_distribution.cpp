#include "nacre/measured/facet_distribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// The largest eigenvalue stands alone: each step brings the next one down several times.
constexpr int steps = 8;

}  // namespace

FacetDistribution::FacetDistribution(const std::function<double(const Vec3d&)>& retro,
                                     bool isotropic, int width, int height)
    : width_(width), height_(height), isotropic_(isotropic) {
    const std::size_t count = std::size_t(width) * height;
    half_.resize(count);
    jacobian_.resize(count);
    weight_.resize(count);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y) * width + x;
            const double u = double(x) / (width - 1), theta = 0.5 * pi * u * u;
            const double phi = pi * (2. * y / (height - 1) - 1.), s = std::sin(theta);
            half_[i] = {s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
            jacobian_[i] = 2. * pi * pi * u * s;
            const bool edge_x = x == 0 || x == width - 1, edge_y = y == 0 || y == height - 1;
            weight_[i] = jacobian_[i] * (edge_x ? 0.5 : 1.) * (edge_y ? 0.5 : 1.) /
                         (double(width - 1) * (height - 1));
        }
    std::vector<double> kernel(count), d(count, 1.);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const std::size_t from = isotropic_ ? i % std::size_t(width_) : i;
        if (from == i) kernel[i] = std::max(retro(half_[i]), 0.) * half_[i].z;
    });
    for (std::size_t i = 0; isotropic && i < count; ++i) kernel[i] = kernel[i % std::size_t(width)];
    const auto normalise = [&] {
        double sum = 0.;
        for (std::size_t i = 0; i < count; ++i) sum += weight_[i] * half_[i].z * d[i];
        if (!(sum > 0.)) {  // nothing comes back anywhere
            std::fill(d.begin(), d.end(), 1. / pi);
            return;
        }
        for (double& v : d) v /= sum;
    };
    normalise();
    for (int step = 0; step < steps; ++step) {
        const std::vector<double> sigma = projected(d);
        for (std::size_t i = 0; i < count; ++i) d[i] = kernel[i] * sigma[i];
        normalise();
    }
    for (double& v : d) v = (1. - even_part) * v + even_part / pi;
    const std::vector<double> sigma = projected(d);
    ndf_.assign(d.begin(), d.end());
    sigma_.assign(sigma.begin(), sigma.end());
}

std::vector<double> FacetDistribution::projected(const std::vector<double>& d) const {
    const std::size_t count = half_.size();
    std::vector<double> sigma(count);
    tbb::parallel_for(std::size_t{0}, isotropic_ ? std::size_t(width_) : count, [&](std::size_t i) {
        double sum = 0.;
        for (std::size_t k = 0; k < count; ++k)
            sum += weight_[k] * d[k] * std::max(dot(half_[i], half_[k]), 0.);
        sigma[i] = sum;
    });
    for (std::size_t i = 0; isotropic_ && i < count; ++i) sigma[i] = sigma[i % std::size_t(width_)];
    return sigma;
}

std::vector<float> FacetDistribution::visible(const Vec3d& w) const {
    std::vector<float> values(half_.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(double(ndf_[i]) * jacobian_[i] * std::max(dot(w, half_[i]), 0.));
    return values;
}

}  // namespace nacre
