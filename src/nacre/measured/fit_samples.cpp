#include "nacre/measured/fit_samples.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "nacre/math/error.h"
#include "nacre/measured/half_angle.h"

namespace nacre {
namespace {

void normalise(std::vector<double>& weight) {
    double sum = 0.;
    for (double w : weight) sum += w;
    for (double& w : weight) w /= sum;
}

}  // namespace

TargetSamples TargetSamples::thinned(std::size_t stride) const {
    TargetSamples r;
    r.isotropic = isotropic;
    for (std::size_t i = 0; i < size(); i += stride) {
        r.wi.push_back(wi[i]);
        r.wo.push_back(wo[i]);
        r.weight.push_back(weight[i]);
        r.value.push_back(value[i]);
    }
    normalise(r.weight);
    return r;
}

TargetSamples sample_target(const Target& target, const FitGrid& grid) {
    const double pi = std::numbers::pi, least = std::cos(grid.largest_angle * pi / 180.);
    TargetSamples r;
    r.isotropic = target.isotropic();
    double turn = 0.;
    const auto next_turn = [&] {
        turn += std::numbers::phi - 1.;
        return turn -= std::floor(turn);
    };
    for (int h = 0; h < grid.theta_h; ++h)
        for (int d = 0; d < grid.theta_d; ++d) {
            const double shift = next_turn();
            for (int p = 0; p < grid.phi_d; ++p) {
                const double x = (h + 0.5) / grid.theta_h;
                HalfAngle a;
                a.theta_h = 0.5 * pi * x * x;
                a.theta_d = 0.5 * pi * (d + 0.5) / grid.theta_d;
                a.phi_d = 2. * pi * (p + shift) / grid.phi_d;
                a.phi_h = 2. * pi * next_turn();
                const DirectionPair pair = from_half_angle(a);
                if (pair.wi.z < least || pair.wo.z < least) continue;
                if (grid.nodes != FitGrid::Nodes::all &&
                    ((h + d + p) % 2 == 1) != (grid.nodes == FitGrid::Nodes::odd))
                    continue;
                const auto value = target.value(pair.wi, pair.wo);
                if (!value) {
                    ++r.missing;
                    continue;
                }
                r.wi.push_back(pair.wi);
                r.wo.push_back(pair.wo);
                r.value.push_back(*value);
                // d theta_h is proportional to x.
                r.weight.push_back(x * std::sin(a.theta_h) * std::sin(a.theta_d) *
                                   std::cos(a.theta_d));
            }
        }
    if (r.size() == 0)
        throw InputError(fmt::format("{}: has no value within {:g} degrees of the normal",
                                     target.name(), grid.largest_angle));
    normalise(r.weight);
    const double size = target_size(r, FitMetric::cosine);
    if (!(size > 0.) || !std::isfinite(size))
        throw InputError(fmt::format("{}: {}; nothing can be fitted to it", target.name(),
                                     size == 0. ? "is black" : "has values that are not finite"));
    return r;
}

double target_size(const TargetSamples& samples, FitMetric metric) {
    double sum = 0.;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double s = seen(samples.value[i][c] * samples.wi[i].z, metric);
            sum += samples.weight[i] * s * s / 3.;
        }
    return std::sqrt(sum);
}

std::string_view name_of(FitMetric metric) {
    return metric == FitMetric::cosine ? "cosine" : metric == FitMetric::log ? "log" : "cuberoot";
}

FitErrors errors_of(const Target& fitted, const TargetSamples& samples) {
    std::vector<Vec3d> found(samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 64), [&](const auto& r) {
        for (std::size_t i = r.begin(); i < r.end(); ++i)
            found[i] = fitted.value(samples.wi[i], samples.wo[i]).value_or(Vec3d{});
    });
    const auto rms = [&](FitMetric metric) {
        double sum = 0.;
        for (std::size_t i = 0; i < samples.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double off = seen(found[i][c] * samples.wi[i].z, metric) -
                                   seen(samples.value[i][c] * samples.wi[i].z, metric);
                sum += samples.weight[i] * off * off / 3.;
            }
        return std::sqrt(sum);
    };
    FitErrors e;
    e.cosine = rms(FitMetric::cosine);
    e.log = rms(FitMetric::log);
    e.cuberoot = rms(FitMetric::cuberoot);
    e.cosine_relative = e.cosine / target_size(samples, FitMetric::cosine);
    e.log_relative = e.log / target_size(samples, FitMetric::log);
    e.cuberoot_relative = e.cuberoot / target_size(samples, FitMetric::cuberoot);
    return e;
}

FitErrors errors_of(const AnyModel& model, const TargetSamples& samples) {
    return errors_of(ModelTarget(model, {}), samples);
}

}  // namespace nacre
