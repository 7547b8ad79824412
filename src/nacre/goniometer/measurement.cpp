#include "nacre/goniometer/measurement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "nacre/goniometer/patch_tracer.h"
#include "nacre/math/error.h"

namespace nacre {

IncidenceMeasurement::IncidenceMeasurement(const DirectionCell& cell, const HemisphereBins& b)
    : incidence(cell), bins(b), of_bin(2 * b.size()) {}

MeasuredValue IncidenceMeasurement::share(const Sums& sums, int lane) const {
    if (rays == 0) return {};
    const double n = double(rays), mean = sums.sum[lane] / n;
    const double variance = std::max(0., sums.square[lane] / n - mean * mean);
    return {mean, std::sqrt(variance / std::max(1., n - 1.))};
}

MeasuredValue IncidenceMeasurement::density(std::size_t i, int lane) const {
    const MeasuredValue m = share(of_bin[i], lane);
    const double cosine = bins.cell(i % bins.size()).projected_solid_angle();
    return {m.value / cosine, m.error / cosine};
}

double IncidenceMeasurement::noise(const Wavelengths& wavelengths) const {
    double worst = 0.;
    for (int lane = 0; lane < 4; ++lane) {
        if (wavelengths.weight[lane] == 0.f) continue;
        double errors = 0.;
        for (const Sums& s : of_bin) errors += share(s, lane).error;
        const double all = reflected(lane).value + transmitted(lane).value;
        if (all > 0.) worst = std::max(worst, errors / all);
    }
    return worst;
}

namespace {

constexpr std::uint64_t block_rays = 4096;

void check(const MeasureOptions& o, const DirectionCell& c) {
    if (o.bins.polar < 1 || o.bins.around < 1 || o.bins.size() > 1'000'000)
        throw InputError(fmt::format("{} by {} bins: from 1 to a million of them are possible",
                                     o.bins.polar, o.bins.around));
    if (!(o.noise >= 0.)) throw InputError("noise must not be negative");
    if (o.orders < 0) throw InputError("orders must not be negative");
    if (!(c.theta_low >= 0. && c.theta_high >= c.theta_low &&
          c.theta_high <= 0.5 * std::numbers::pi && c.theta() < 0.5 * std::numbers::pi))
        throw InputError(
            fmt::format("light from {:.6g} degrees does not meet the surface from above",
                        c.theta() * 180. / std::numbers::pi));
}

void add(IncidenceMeasurement& m, const Arrival& a) {
    switch (a.where) {
        case Arrival::Where::nowhere:
            return;
        case Arrival::Where::above:
            m.above.add(a.weight);
            m.of_bin[a.bin].add(a.weight);
            return;
        case Arrival::Where::below:
            m.below.add(a.weight);
            m.of_bin[m.bins.size() + a.bin].add(a.weight);
            return;
        case Arrival::Where::cut:
            m.cut.add(a.weight);
            return;
        case Arrival::Where::gone:
            m.gone.add(a.weight);
            return;
    }
}

}  // namespace

void measure(const Patch& patch, const MeasureOptions& options, IncidenceMeasurement& m,
             const Work& work, const std::function<void(const MeasureProgress&)>& progress) {
    check(options, m.incidence);
    const PatchTracer tracer(patch, options, m.incidence);
    // Rays come in blocks with random numbers of their own, which are added in their order.
    constexpr std::uint64_t at_once = 64;
    std::vector<std::vector<Arrival>> blocks(at_once);
    std::uint64_t aim = std::max<std::uint64_t>(options.least_rays, 1);
    while (m.rays < options.most_rays) {
        if (m.rays >= aim) {
            const double noise = m.noise(options.wavelengths);
            if (progress) progress({0, 1, m.rays, noise});
            if (noise <= options.noise) return;
            aim = 2 * m.rays;
        }
        const std::uint64_t first = m.rays / block_rays;
        const std::uint64_t wanted = std::min(aim, options.most_rays) - m.rays;
        const std::uint64_t count =
            std::clamp<std::uint64_t>((wanted + block_rays - 1) / block_rays, 1, at_once);
        tbb::parallel_for(std::uint64_t(0), count, [&](std::uint64_t b) {
            std::vector<Arrival>& arrivals = blocks[b];
            arrivals.clear();
            for (std::uint64_t i = 0; i < block_rays; ++i) {
                if (i % 256 == 0 && work.stopped()) return;
                arrivals.push_back(
                    tracer.trace(Random(stream_key(options.seed, first + b, i, 0x676f6e69))));
            }
        });
        for (std::uint64_t b = 0; b < count; ++b) {
            if (blocks[b].size() < block_rays) return;  // stopped: whole blocks only
            for (const Arrival& a : blocks[b]) add(m, a);
            m.rays += block_rays;
        }
        work.tell("measuring", double(m.rays) / double(aim));
    }
}

}  // namespace nacre
