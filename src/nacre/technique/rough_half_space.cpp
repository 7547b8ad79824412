#include "nacre/technique/rough_half_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "nacre/bssrdf/half_space.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/sampling.h"
#include "nacre/render/boundary_samples.h"

namespace nacre {
namespace {

constexpr std::size_t nodes_each = 12;
constexpr int samples_each = 8192, samples_of_entry = 65536;
// Light that still goes to and fro when the rest counts for nothing.
constexpr double negligible = 1e-7;

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.); }

/// matrix[to * n + from] times light.
std::vector<double> product(const std::vector<double>& matrix, const std::vector<double>& light) {
    const std::size_t n = light.size();
    std::vector<double> result(n);
    for (std::size_t to = 0; to < n; ++to)
        result[to] = std::inner_product(light.begin(), light.end(), matrix.begin() + to * n, 0.);
    return result;
}

}  // namespace

RoughHalfSpace::RoughHalfSpace(const Material& boundary) : eta_(boundary.rough_boundary_eta()) {
    // Nearly smooth boundaries have a kink where total reflection begins.
    const double critical = eta_ > 1. ? std::sqrt(1. - 1. / (eta_ * eta_)) : 0.;
    const GaussLegendre rule(nodes_each);
    for (const auto& [low, high] : {std::pair{0., critical}, std::pair{critical, 1.}})
        for (std::size_t i = 0; i < nodes_each && high > low; ++i) {
            cosine_.push_back(0.5 * (low + high + (high - low) * rule.node[i]));
            width_.push_back(0.5 * (high - low) * rule.weight[i]);
        }
    std::vector<double> end(size());
    std::partial_sum(width_.begin(), width_.end(), end.begin());
    const auto interval = [&](float cosine) {
        const auto i = std::size_t(std::ranges::lower_bound(end, double(cosine)) - end.begin());
        return std::min(i, size() - 1);
    };

    entered_.resize(size());
    leaves_.resize(size());
    turned_.resize(size() * size());
    for_boundary_samples(
        boundary, samples_of_entry, 0, [](Vec2f u) { return square_to_cosine_hemisphere(u); },
        [&](const Vec3f& wi, double share, bool back) {
            if (!back) entered_[interval(-wi.z)] += share;
        });
    const double transmittance = sum(entered_);
    for (double& e : entered_) e /= transmittance;
    for (std::size_t from = 0; from < size(); ++from) {
        const float mu = float(cosine_[from]), sine = std::sqrt(std::max(0.f, 1.f - mu * mu));
        for_boundary_samples(
            boundary, samples_each, 1 + from,
            [&](Vec2f u) {
                const float phi = 2.f * std::numbers::pi_v<float> * u.x;
                return Vec3f{sine * std::cos(phi), sine * std::sin(phi), -mu};
            },
            [&](const Vec3f& wi, double share, bool back) {
                (back ? turned_[interval(-wi.z) * size() + from] : leaves_[from]) += share;
            });
    }
    // Of diffuse light, as many rays leave as enter: known better from outside, by more samples.
    double leaves = 0.;
    for (std::size_t i = 0; i < size(); ++i) leaves += 2. * cosine_[i] * width_[i] * leaves_[i];
    for (double& l : leaves_) l *= transmittance / (eta_ * eta_ * leaves);
}

double RoughHalfSpace::albedo(const ProfileMedium& m) const {
    const LayerStack half_space{{{.sigma_s = m.sigma_s,
                                  .sigma_a = m.sigma_a,
                                  .g = m.g,
                                  .thickness = std::numeric_limits<double>::infinity(),
                                  .eta = eta_}},
                                eta_,
                                eta_};
    const AddingDoublingResult r = adding_doubling(half_space, cosine_, cosine_, {.nodes = nodes});
    std::vector<double> scattered(size() * size());
    for (std::size_t from = 0; from < size(); ++from) {
        // Flux per interval; totals are more accurate than distributions.
        double all = 0.;
        for (std::size_t to = 0; to < size(); ++to)
            all += scattered[to * size() + from] =
                r.brdf[from * size() + to] * cosine_[to] * width_[to];
        for (std::size_t to = 0; to < size() && all > 0.; ++to)
            scattered[to * size() + from] *= r.collimated[from].reflectance / all;
    }
    double returned = 0.;
    for (std::vector<double> down = entered_; sum(down) > negligible;) {
        const std::vector<double> up = product(scattered, down);
        returned += std::inner_product(up.begin(), up.end(), leaves_.begin(), 0.);
        down = product(turned_, up);
    }
    return std::clamp(returned, 0., 1.);
}

std::vector<double> rough_return(const ObjectBoundary& boundary,
                                 std::span<const ProfileMedium> media, const Work& work) {
    if (!boundary.rough()) return {};
    WorkPhase phase(work, "losses of the facets", media.size());
    const RoughHalfSpace rough(*boundary.rough());
    std::vector<double> result(media.size());
    tbb::parallel_for(std::size_t(0), media.size(), [&](std::size_t i) {
        check(media[i]);
        const double smooth = half_space_albedo(media[i], RoughHalfSpace::nodes);
        result[i] = smooth > 0. ? rough.albedo(media[i]) / smooth : 1.;
        phase.advance();
    });
    return result;
}

}  // namespace nacre
