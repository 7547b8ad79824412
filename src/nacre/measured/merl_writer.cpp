// .binary files of MERL's format from any isotropic BRDF.
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstring>

#include "nacre/measured/merl_measured.h"

namespace nacre {
namespace {

constexpr int nh = MerlBrdf::theta_h_count, nd = MerlBrdf::theta_d_count,
              np = MerlBrdf::phi_d_count;
constexpr std::size_t planes = 3, node_count = std::size_t(nh) * nd * np;

/// Nodes this far below the horizon have neighbours above it, and take the value at the horizon, so
/// that whatever is above lies between nodes.
constexpr double below = 0.06;

Vec3d lifted(const Vec3d& w) {
    constexpr double least = 1e-3;
    if (w.z >= least) return w;
    const double s = std::sqrt((1. - least * least) / (w.x * w.x + w.y * w.y));
    return {w.x * s, w.y * s, least};
}

/// The nodes of one theta_h and theta_d that can be seen, and what the data say there, with light and
/// viewer as they are and exchanged.
struct Row {
    std::vector<std::size_t> at;
    std::vector<Vec3d> wi, wo;
    std::vector<double> one, other;
    std::array<bool, np> known, back;

    Row(const Measured& data, int h, int d) {
        for (int p = 0; p < np; ++p) {
            const DirectionPair pair = from_half_angle(merl_node_angles(h, d, p));
            if (!(std::min(pair.wi.z, pair.wo.z) > -below)) continue;
            at.push_back((std::size_t(h) * nd + d) * np + p);
            wi.push_back(lifted(pair.wi));
            wo.push_back(lifted(pair.wo));
        }
        one.resize(planes * at.size());
        other.resize(planes * at.size());
        data.eval_many(wi, wo, one, std::span(known).first(at.size()));
        data.eval_many(wo, wi, other, std::span(back).first(at.size()));
    }
};

/// What was found on one plane of theta_h.
struct Found {
    std::size_t negative = 0;
    double sum = 0., exchanged = 0.;
};

}  // namespace

WrittenMeasured write_merl(const Measured& data, const WriteOptions&) {
    std::vector<double> values(planes * node_count, -1.);
    std::vector<Found> found(nh);
    tbb::parallel_for(0, nh, [&](int h) {
        Found& here = found[std::size_t(h)];
        for (int d = 0; d < nd; ++d) {
            const Row row(data, h, d);
            for (std::size_t i = 0; i < row.at.size(); ++i) {
                const bool known = row.known[i], back = row.back[i];
                if (!known && !back) continue;
                const double *one = &row.one[planes * i], *other = &row.other[planes * i];
                bool negative = false;
                for (std::size_t c = 0; c < planes; ++c) {
                    if (known && back) {
                        const double seen = row.wi[i].z * row.wo[i].z;
                        here.sum += seen * std::abs(one[c]);
                        here.exchanged += seen * std::abs(one[c] - other[c]);
                    }
                    const double f = known && back ? 0.5 * (one[c] + other[c])
                                     : known       ? one[c]
                                                   : other[c];
                    negative = negative || f < 0.;
                    values[c * node_count + row.at[i]] = std::max(f, 0.) / MerlBrdf::scale[c];
                }
                here.negative += negative;
            }
        }
    });
    Found all;
    for (const Found& f : found) {
        all.negative += f.negative;
        all.sum += f.sum;
        all.exchanged += f.exchanged;
    }
    WrittenMeasured written;
    const std::int32_t counts[] = {nh, nd, np};
    written.bytes.resize(sizeof counts + values.size() * sizeof(double));
    std::memcpy(written.bytes.data(), counts, sizeof counts);
    std::memcpy(written.bytes.data() + sizeof counts, values.data(),
                values.size() * sizeof(double));
    if (all.negative > 0)
        written.lost.push_back(
            fmt::format("{} nodes with negative values are 0: the format takes these as missing",
                        all.negative));
    if (const double part = all.sum > 0. ? all.exchanged / all.sum : 0.; part > 1e-3)
        written.lost.push_back(
            fmt::format("values for light and viewer exchanged differ by {:.2g} % in the mean: the "
                        "format has one for both, which is their mean",
                        100. * part));
    return written;
}

}  // namespace nacre
