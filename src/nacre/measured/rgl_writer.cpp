// .bsdf files of the RGL database from any BRDF. The facets' distribution is that of the
// retro-reflection, as in the database (facet_distribution.h); whatever it is, the file's values at its
// nodes are those of the BRDF, because they are asked for where the reader puts the nodes. Between the
// nodes they are as good as the warp.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/random.h"
#include "nacre/measured/facet_distribution.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/half_vector_square.h"
#include "nacre/measured/held.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/rgl.h"
#include "nacre/measured/tensor_writer.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// f with the values at the largest measured angles held beyond them.
class Held {
  public:
    explicit Held(const Measured& data) : data_(data) {}

    std::size_t channels() const { return std::size_t(data_.info().channels); }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
        return eval_held(data_.info(), wi, wo,
                         [&](const Vec3d& i, const Vec3d& o) { return data_.eval(i, o, out); });
    }

  private:
    const Measured& data_;
};

Vec3d at_height(const Vec3d& w, double z) {
    const double across = std::hypot(w.x, w.y), r = std::sqrt(1. - z * z);
    return across > 0. ? Vec3d{w.x * r / across, w.y * r / across, z} : Vec3d{r, 0., z};
}

/// What the file stores: f cos(theta_o) over D(h) / (4 sigma(wi)).
class Stored {
  public:
    Stored(const Held& f, const FacetDistribution& facets)
        : f_(f),
          ndf_(facets.width(), facets.height(), facets.ndf()),
          sigma_(facets.width(), facets.height(), facets.sigma()) {}

    const BilinearTable& ndf() const { return ndf_; }
    const BilinearTable& sigma() const { return sigma_; }

    /// Continued below the horizon, so that what is interpolated across it is right above it, but not
    /// below 0, which would reach above it as well; false where f is not known.
    bool at(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
        constexpr double low = 0.02, high = 0.06;
        if (wo.z > 0.) return above(wi, wo, out);
        double upper[max_measured_channels];
        if (!above(wi, at_height(wo, low), out) ||
            !above(wi, at_height(wo, high), std::span<double>(upper, f_.channels())))
            return false;
        for (std::size_t c = 0; c < f_.channels(); ++c) {
            const double slope = (upper[c] - out[c]) / (high - low);
            const double most = 2. * std::max({out[c], upper[c], 0.});
            out[c] = std::clamp(out[c] + slope * (wo.z - low), 0., most);
        }
        return true;
    }

  private:
    bool above(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
        if (!f_.eval(wi, wo, out)) return false;
        const Vec3d h = normalize(wi + wo);
        const SliceMix one;
        const float d = ndf_.eval(x_of(h), y_of(h), one);
        const double scale = 4. * sigma_.eval(x_of(wi), y_of(wi), one) / double(d) * wo.z;
        for (std::size_t c = 0; c < f_.channels(); ++c) out[c] *= scale;
        return true;
    }
    static float x_of(const Vec3d& w) {
        return square_x(float(std::atan2(std::hypot(w.x, w.y), w.z)));
    }
    static float y_of(const Vec3d& w) { return square_y(float(std::atan2(w.y, w.x))); }

    const Held& f_;
    BilinearTable ndf_, sigma_;
};

/// f(w, w), or of the nearest directions to the two sides of w that are known: instruments do not see
/// into their own light.
double retro_reflection(const Held& f, const Vec3d& w) {
    std::vector<double> value(f.channels());
    const double theta = std::min(std::acos(std::min(w.z, 1.)), 89. * pi / 180.);
    const double phi = std::atan2(w.y, w.x);
    for (int degrees = 0; degrees <= 45; degrees += 3) {
        const DirectionPair pair = from_half_angle(
            {.theta_h = theta, .phi_h = phi, .theta_d = degrees * pi / 180., .phi_d = 0.5 * pi});
        if (f.eval(pair.wi, pair.wo, value)) return std::max(mean_of_values(value), 0.);
    }
    return 0.;
}

/// Into how many parts the circle of phi_i falls, of which one is enough: 2 if the surface looks the
/// same when turned by half a circle, 4 if also when mirrored at x and at y.
int symmetry(const Held& f) {
    const std::size_t n = f.channels();
    std::vector<double> value(n), turned(n);
    bool half = true, quarter = true;
    Random random(stream_key(13, 1));
    for (int i = 0; i < 256 && half; ++i) {
        const auto direction = [&] {
            const double z = 0.1 + 0.9 * random.next();
            return polar_direction(std::acos(z), 2. * pi * random.next());
        };
        const Vec3d wi = direction(), h = direction();
        Vec3d wo = i % 2 ? direction() : h * (2. * dot(wi, h)) - wi;
        if (wo.z <= 0.05) wo = direction();
        const bool known = f.eval(wi, wo, value);
        const auto same = [&](double x, double y) {
            const bool also =
                f.eval({x * wi.x, y * wi.y, wi.z}, {x * wo.x, y * wo.y, wo.z}, turned);
            if (known != also) return false;
            for (std::size_t c = 0; c < n && known; ++c)
                if (std::abs(value[c] - turned[c]) >
                    1e-5 * std::max(std::abs(value[c]), std::abs(turned[c])))
                    return false;
            return true;
        };
        half = half && same(-1., -1.);
        quarter = quarter && same(1., -1.);
    }
    return !half ? 1 : quarter ? 4 : 2;
}

std::vector<float> incidences(int count) {
    // Denser towards the horizon, where BRDFs change quickly; the horizon itself is left out.
    std::vector<float> theta;
    for (int i = 0; i < count; ++i) {
        const double t = double(i) / (count - 1);
        theta.push_back(float(89.5 * pi / 180. * (1.3 * t - 0.3 * t * t * t)));
    }
    return theta;
}

std::vector<float> azimuths(const Held& f, bool isotropic, int around) {
    if (isotropic) return {0.f};
    // Parts of a circle begin at -pi, which is where other readers expect them.
    const int parts = symmetry(f), steps = std::max((around + parts - 1) / parts, 3);
    std::vector<float> phi;
    for (int i = 0; i <= steps; ++i) phi.push_back(float(-pi + 2. * pi / parts * i / steps));
    return phi;
}

/// Nodes of one slice whose exit is above the horizon.
struct NodeCounts {
    std::size_t above = 0, unknown = 0, negative = 0;
};

}  // namespace

WrittenMeasured write_rgl(const Measured& data, const WriteOptions& options) {
    const MeasuredInfo& info = data.info();
    const Held f(data);
    const std::size_t n = f.channels(), side = std::size_t(options.resolution), nodes = side * side;
    const FacetDistribution facets([&](const Vec3d& w) { return retro_reflection(f, w); },
                                   info.isotropic, 128, info.isotropic ? 32 : 64);
    const std::vector<float> theta = incidences(options.incidences),
                             phi = azimuths(f, info.isotropic, options.azimuths);
    const std::size_t slices = theta.size() * phi.size(), facet_nodes = facets.ndf().size();
    const auto given = [&](std::size_t slice) {
        return polar_direction(theta[slice % theta.size()], phi[slice / theta.size()]);
    };

    std::vector<float> vndf(slices * facet_nodes);
    tbb::parallel_for(std::size_t{0}, slices, [&](std::size_t s) {
        const std::vector<float> visible = facets.visible(given(s));
        std::copy(visible.begin(), visible.end(), vndf.begin() + std::ptrdiff_t(s * facet_nodes));
    });
    const Stored stored(f, facets);
    RglTables tables;
    tables.incidence = ParameterGrid(phi, theta);
    tables.ndf = stored.ndf();
    tables.sigma = stored.sigma();
    tables.vndf = MarginalWarp(facets.width(), facets.height(), vndf);
    tables.channels = int(n);
    tables.width = tables.height = options.resolution;
    const RglBrdf reader(std::move(tables));

    std::vector<float> spectra(slices * n * nodes), luminance(slices * nodes);
    std::vector<NodeCounts> counts(slices);
    tbb::parallel_for(std::size_t{0}, slices, [&](std::size_t s) {
        std::vector<double> value(n);
        const Vec3d wi = given(s);
        double sum = 0.;
        for (std::size_t i = 0; i < nodes; ++i) {
            const RglBrdf::Node node = reader.node(Vec3f(wi), s, int(i % side), int(i / side));
            const Vec3d wo(node.direction);
            const bool known = stored.at(wi, wo, value);
            double mean = 0.;
            bool negative = false;
            for (std::size_t c = 0; c < n; ++c) {
                negative = negative || (known && value[c] < 0.);
                value[c] = known ? std::max(value[c], 0.) : 0.;
                spectra[(s * n + c) * nodes + i] = float(value[c]);
                mean += value[c] / double(n);
            }
            if (wo.z > 0.) {
                ++counts[s].above;
                counts[s].unknown += !known;
                counts[s].negative += negative;
            }
            luminance[s * nodes + i] = wo.z > 0. ? float(mean) : 0.f;
            sum += luminance[s * nodes + i];
        }
        // Drawn everywhere: what is 0 at the nodes need not be 0 between them.
        const float least = float(0.01 * sum / double(nodes));
        for (std::size_t i = 0; i < nodes; ++i)
            luminance[s * nodes + i] = std::max(luminance[s * nodes + i], least);
    });

    const auto size = [](std::size_t k) { return std::uint64_t(k); };
    const std::vector<std::uint64_t> square{size(facets.height()), size(facets.width())};
    const auto sliced = [&](std::vector<std::uint64_t> shape) {
        shape.insert(shape.begin(), {size(phi.size()), size(theta.size())});
        return shape;
    };
    TensorWriter file;
    file.add("description", info.description);
    file.add("phi_i", {size(phi.size())}, phi);
    file.add("theta_i", {size(theta.size())}, theta);
    file.add("ndf", square, facets.ndf());
    file.add("sigma", square, facets.sigma());
    file.add("vndf", sliced(square), vndf);
    file.add("luminance", sliced({side, side}), luminance);
    const bool spectral = info.wavelengths.size() > 1;
    file.add(spectral ? "spectra" : "rgb", sliced({size(n), side, side}), spectra);
    if (spectral) {
        const std::vector<float> nm(info.wavelengths.begin(), info.wavelengths.end());
        file.add("wavelengths", {size(nm.size())}, nm);
    }
    file.add("jacobian", std::string_view("\1", 1));

    WrittenMeasured written{file.bytes(), {}};
    NodeCounts all;
    for (const NodeCounts& c : counts) {
        all.above += c.above;
        all.unknown += c.unknown;
        all.negative += c.negative;
    }
    if (all.unknown > 0)
        written.lost.push_back(fmt::format(
            "{} of {} nodes are not known, also not at the largest measured angles, and "
            "are 0: the format does not tell them apart",
            all.unknown, all.above));
    if (all.negative > 0)
        written.lost.push_back(fmt::format(
            "{} of {} nodes have negative values and are 0: renderers refuse such light",
            all.negative, all.above));
    return written;
}

}  // namespace nacre
