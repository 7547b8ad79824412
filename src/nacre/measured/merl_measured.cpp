#include "nacre/measured/merl_measured.h"

#include <cstring>
#include <numbers>

#include "nacre/measured/formats.h"
#include "nacre/measured/half_angle.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int nh = MerlBrdf::theta_h_count, nd = MerlBrdf::theta_d_count,
              np = MerlBrdf::phi_d_count;

/// 90, 90, 180 in front, whatever follows; or three other counts that the size of the file agrees
/// with, which the reader refuses by name.
bool is_merl(const FileStart& start) {
    std::int32_t n[3];
    if (start.head.size() < sizeof n) return false;
    std::memcpy(n, start.head.data(), sizeof n);
    if (n[0] == nh && n[1] == nd && n[2] == np) return true;
    double values = 3.;
    for (const std::int32_t k : n) {
        if (k < 1 || k > 100000) return false;
        values *= k;
    }
    return 12. + 8. * values == double(start.size);
}

}  // namespace

HalfAngle merl_node_angles(int h, int d, int p) {
    const double x = double(h) / nh;
    return {.theta_h = 0.5 * pi * x * x,
            .phi_h = 0.,
            .theta_d = 0.5 * pi * d / nd,
            .phi_d = pi * p / np};
}

MerlMeasured::MerlMeasured(MerlBrdf brdf) : brdf_(std::move(brdf)) {
    info_.format = "merl";
    info_.parameterisation =
        "half and difference angles: theta_h (90, denser at 0), theta_d (90), phi_d (180)";
    info_.scale = "times 1/1500, 1.15/1500 and 1.66/1500 for red, green and blue";
    info_.samples = std::size_t(nh) * nd * np;
    info_.missing = brdf_.missing();
    // The directions' heights above the horizon, in closed form: there are many nodes.
    double incidence = 1., exit = 1.;
    for (int h = 0; h < nh; ++h)
        for (int d = 0; d < nd; ++d)
            for (int p = 0; p < np; ++p) {
                if (!brdf_.node(h, d, p)) continue;
                const HalfAngle a = merl_node_angles(h, d, p);
                const double both = std::cos(a.theta_h) * std::cos(a.theta_d);
                const double apart = std::sin(a.theta_h) * std::sin(a.theta_d) * std::cos(a.phi_d);
                if (both - apart <= 0. || both + apart <= 0.) continue;
                incidence = std::min(incidence, both - apart);
                exit = std::min(exit, both + apart);
            }
    info_.largest_incidence = std::acos(incidence) * 180. / pi;
    info_.largest_exit = std::acos(exit) * 180. / pi;
}

bool MerlMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    const auto value = brdf_.eval(wi, wo);
    if (!value) return false;
    for (int c = 0; c < 3; ++c) out[c] = (*value)[c];
    return true;
}

void MerlMeasured::for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const {
    for (int h = 0; h < nh; ++h)
        for (int d = 0; d < nd; ++d)
            for (int p = 0; p < np; ++p) {
                const DirectionPair pair = from_half_angle(merl_node_angles(h, d, p));
                const auto value = brdf_.node(h, d, p);
                const Vec3d v = value.value_or(Vec3d(-1., -1., -1.));
                const double channels[3] = {v.x, v.y, v.z};
                visit(
                    {pair.wi, pair.wo, value ? SampleState::good : SampleState::missing, channels});
            }
}

const MeasuredFormat& merl_format() {
    static const MeasuredFormat format{
        .name = "merl",
        .title = "MERL",
        .ending = ".binary",
        .summary =
            "isotropic BRDFs over half and difference angles, red, green and blue (Matusik "
            "et al. 2003)",
        .memory = 0.7,
        .recognise = is_merl,
        .read = [](const MeasuredSource& source) -> std::unique_ptr<Measured> {
            return std::make_unique<MerlMeasured>(parse_merl(source.bytes, source.path));
        },
        .write = write_merl,
    };
    return format;
}

}  // namespace nacre
