#include "nacre/measured/audit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/random.h"
#include "nacre/math/sobol.h"
#include "nacre/math/warp.h"
#include "nacre/measured/audit_verdict.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/scattered.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.;
constexpr std::size_t worst_count = 5, most_looked_at = 100000;
/// Samples at 80 degrees themselves count, whatever their digits.
const double usual = std::cos(80.01 * degree);

/// The `part`-th of the values, which are reordered.
double quantile(std::vector<double>& values, double part) {
    if (values.empty()) return 0.;
    const auto at = values.begin() + std::ptrdiff_t(part * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

struct Sample {
    Vec3d wi, wo;
    double value;
};

bool is_usual(const Vec3d& wi, const Vec3d& wo) {
    return std::abs(wi.z) >= usual && std::abs(wo.z) >= usual;
}

/// All that are not missing, within 80 degrees of the normal, and their range.
std::vector<Sample> samples_of(const Measured& data, AuditRange& range) {
    std::vector<Sample> samples;
    std::vector<double> values;
    data.for_each_sample([&](const MeasuredSample& s) {
        if (s.state == SampleState::missing) return;
        for (const double v : s.value) range.most_negative = std::min(range.most_negative, v);
        if (!is_usual(s.wi, s.wo)) return;
        samples.push_back({s.wi, s.wo, mean_of_values(s.value)});
        values.push_back(samples.back().value);
    });
    if (values.empty()) return samples;
    range.mean = mean_of_values(values);
    range.median = quantile(values, 0.5);
    range.percentile99 = quantile(values, 0.99);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    range.smallest = *low;
    range.largest = *high;
    return samples;
}

/// The `stride` that looks at no more than `most` of `count`.
std::size_t stride_for(std::size_t count, std::size_t most) { return count / (most + 1) + 1; }

/// Keeps the pairs with the largest measures, the largest first.
class Worst {
  public:
    void add(double measure, const AuditedPair& pair) {
        const auto at = std::find_if(kept_.begin(), kept_.end(),
                                     [&](const auto& k) { return k.first < measure; });
        if (at == kept_.end() && kept_.size() >= worst_count) return;
        kept_.insert(at, {measure, pair});
        if (kept_.size() > worst_count) kept_.pop_back();
    }
    std::vector<AuditedPair> pairs() const {
        std::vector<AuditedPair> pairs;
        for (const auto& k : kept_) pairs.push_back(k.second);
        return pairs;
    }

  private:
    std::vector<std::pair<double, AuditedPair>> kept_;
};

AuditReciprocity reciprocity_of(const Measured& data, const std::vector<Sample>& samples) {
    AuditReciprocity r;
    if (!data.info().reflection_front) return r;
    std::vector<double> out(std::size_t(data.info().channels));
    std::vector<AuditedPair> pairs;
    const auto add = [&](const Vec3d& wi, const Vec3d& wo) {
        if (!data.eval(wi, wo, out)) return;
        const double value = mean_of_values(out);
        if (!data.eval(wo, wi, out)) return;
        pairs.push_back({wi, wo, value, mean_of_values(out)});
    };
    const std::size_t stride = stride_for(samples.size(), most_looked_at);
    for (std::size_t i = 0; i < samples.size(); i += stride)
        if (samples[i].wi.z > 0. && samples[i].wo.z > 0.) add(samples[i].wi, samples[i].wo);
    Random random(stream_key(13, 2));
    for (int i = 0; i < 8192; ++i) {
        const Vec3d wi(normalize(square_to_cosine_hemisphere(random.next2())));
        Vec3d wo(normalize(square_to_cosine_hemisphere(random.next2())));
        if (i % 2) {  // highlights as well
            const double x = random.next();
            const Vec3d h = polar_direction(0.25 * pi * x * x, 2. * pi * random.next());
            wo = h * (2. * dot(wi, h)) - wi;
        }
        if (wo.z > 0. && is_usual(wi, wo)) add(wi, wo);
    }
    double mean = 0.;
    for (const AuditedPair& p : pairs) mean += 0.5 * (std::abs(p.value) + std::abs(p.other));
    mean /= double(std::max<std::size_t>(pairs.size(), 1));
    if (!(mean > 0.)) return r;
    r.pairs = pairs.size();
    std::vector<double> differences;
    Worst worst;
    for (const AuditedPair& p : pairs) {
        const double d = std::abs(p.value - p.other) /
                         std::max(0.5 * (std::abs(p.value) + std::abs(p.other)), 0.01 * mean);
        differences.push_back(d);
        r.mean += d / double(pairs.size());
        r.apart += d > AuditReciprocity::allowed;
        if (d > AuditReciprocity::allowed) worst.add(d, p);
    }
    r.largest = *std::max_element(differences.begin(), differences.end());
    r.median = quantile(differences, 0.5);
    r.percentile95 = quantile(differences, 0.95);
    r.worst = worst.pairs();
    return r;
}

/// Of light from one direction.
AuditAlbedo albedo_from(const Measured& data, const ChannelColours& colours, const Vec3d& wi) {
    AuditAlbedo a;
    a.front = wi.z > 0.;
    constexpr std::uint32_t points = 1u << 14;
    const std::size_t n = std::size_t(data.info().channels);
    const Vec3d up{wi.x, wi.y, std::abs(wi.z)};
    const double phi_i = wi.x == 0. && wi.y == 0. ? 0. : std::atan2(wi.y, wi.x);
    std::vector<double> sums[2] = {std::vector<double>(n), std::vector<double>(n)}, weights;
    std::vector<Vec3d> exits;
    double known[2] = {}, all = 0.;
    for (std::uint32_t i = 0; i < points; ++i) {
        const double u = sobol_owen(i, 0, 1), theta = 0.5 * pi * u * u;
        const Vec3d h = polar_direction(theta, phi_i + 2. * pi * double(sobol_owen(i, 1, 1)));
        const double up_h = dot(up, h);
        const Vec3d wo = h * (2. * up_h) - up;
        if (!(wo.z > 0. && up_h > 0.)) continue;
        const double weight = wo.z * 4. * up_h * 2. * pi * pi * u * std::sin(theta) / points;
        all += weight;
        weights.push_back(weight);
        exits.push_back(a.front ? wo : Vec3d{wo.x, wo.y, -wo.z});
    }
    constexpr std::size_t block = 512;
    const std::vector<Vec3d> light(block, wi);
    std::vector<double> out(n * block);
    bool is_known[block];
    for (int through = 0; through < 2; ++through) {
        for (std::size_t first = 0; first < exits.size(); first += block) {
            const std::size_t count = std::min(block, exits.size() - first);
            data.eval_many(std::span(light).first(count), std::span(exits).subspan(first, count),
                           out, std::span(is_known).first(count));
            for (std::size_t i = 0; i < count; ++i) {
                if (!is_known[i]) continue;
                const double weight = weights[first + i];
                known[through] += weight;
                for (std::size_t c = 0; c < n; ++c) sums[through][c] += weight * out[n * i + c];
            }
        }
        for (Vec3d& wo : exits) wo.z = -wo.z;
    }
    // As parts of all points: then what is even is exact.
    for (std::vector<double>& sum : sums)
        for (double& v : sum) v *= pi / all;
    a.known_reflected = known[0] / all;
    a.known_transmitted = known[1] / all;
    a.reflected = colours(sums[0]);
    a.transmitted = colours(sums[1]);
    for (std::size_t c = 0; c < n; ++c) a.largest = std::max(a.largest, sums[0][c] + sums[1][c]);
    return a;
}

std::vector<AuditAlbedo> albedos_of(const Measured& data) {
    const MeasuredInfo& info = data.info();
    const ChannelColours colours(info);
    std::vector<AuditAlbedo> all;
    for (const bool front : {true, false}) {
        if (!(front ? info.reflection_front || info.transmission_front
                    : info.reflection_back || info.transmission_back))
            continue;
        for (int theta = 0; theta <= 85; theta += 5) {
            AuditAlbedo a;
            a.theta = theta;
            a.front = front;
            all.push_back(a);
        }
    }
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
        AuditAlbedo sum = all[i];
        const int azimuths = info.isotropic ? 1 : 8;
        for (int k = 0; k < azimuths; ++k) {
            Vec3d wi = polar_direction(sum.theta * degree, 2. * pi * k / azimuths);
            if (!sum.front) wi.z = -wi.z;
            const AuditAlbedo a = albedo_from(data, colours, wi);
            sum.reflected += a.reflected / double(azimuths);
            sum.transmitted += a.transmitted / double(azimuths);
            sum.known_reflected += a.known_reflected / azimuths;
            sum.known_transmitted += a.known_transmitted / azimuths;
            sum.largest = std::max(sum.largest, a.largest);
        }
        all[i] = sum;
    });
    std::erase_if(all, [](const AuditAlbedo& a) {
        return a.known_reflected == 0. && a.known_transmitted == 0.;
    });
    return all;
}

AuditOutliers outliers_of(const Measured& data, const std::vector<Sample>& samples, double mean) {
    constexpr int neighbours = 8;
    AuditOutliers r;
    Worst worst;
    // Light from one side that leaves on one side.
    for (int sides = 0; sides < 4; ++sides) {
        std::vector<const Sample*> here;
        std::vector<PointTree::Point> places;
        for (const Sample& s : samples) {
            if ((s.wi.z > 0.) * 2 + (s.wo.z > 0.) != sides) continue;
            here.push_back(&s);
            const double up = s.wi.z > 0. ? 1. : -1.;
            places.push_back(scattered_place({s.wi.x, s.wi.y, up * s.wi.z},
                                             {s.wo.x, s.wo.y, up * s.wo.z}, data.info().isotropic));
        }
        if (here.size() <= neighbours) continue;
        const PointTree tree(places);
        const std::size_t stride = stride_for(here.size(), most_looked_at);
        for (std::size_t i = 0; i < here.size(); i += stride) {
            PointTree::Near near[neighbours + 1];
            const int count = tree.nearest(places[i], neighbours + 1, near);
            std::vector<double> values;
            for (int k = 0; k < count; ++k)
                if (near[k].index != i && values.size() < std::size_t(neighbours))
                    values.push_back(here[near[k].index]->value);
            const auto [low, high] = std::minmax_element(values.begin(), values.end());
            const double v = here[i]->value, least = 0.1 * mean;
            ++r.looked_at;
            const double above = v - *high, below = *low - v;
            const bool far_above = v > 3. * *high && above > least,
                       far_below = v < *low / 3. && below > least;
            if (!far_above && !far_below) continue;
            ++r.count;
            const double median = quantile(values, 0.5);
            worst.add(std::max(above, below), {here[i]->wi, here[i]->wo, v, median});
        }
    }
    r.worst = worst.pairs();
    return r;
}

/// Of random pairs by the cosine of both.
double known_share(const Measured& data) {
    std::vector<double> out(std::size_t(data.info().channels));
    Random random(stream_key(13, 3));
    int all = 0, known = 0;
    while (all < 4096) {
        const Vec3d wi(normalize(square_to_cosine_hemisphere(random.next2())));
        const Vec3d wo(normalize(square_to_cosine_hemisphere(random.next2())));
        if (!is_usual(wi, wo)) continue;
        ++all;
        known += data.eval(wi, wo, out);
    }
    return double(known) / all;
}

}  // namespace

Audit audit(const Measured& data) {
    Audit a;
    const std::vector<Sample> samples = samples_of(data, a.range);
    a.reciprocity = reciprocity_of(data, samples);
    a.albedo = albedos_of(data);
    a.outliers = outliers_of(data, samples, std::abs(a.range.mean));
    a.known = known_share(data);
    judge(data.info(), a);
    return a;
}

}  // namespace nacre
