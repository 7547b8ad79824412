#include "nacre/measured/merl.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <numbers>
#include <system_error>

#include "nacre/math/error.h"
#include "nacre/math/fast_atan2.h"
#include "nacre/measured/half_angle.h"

namespace nacre {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are copied as bytes");

constexpr int nh = MerlBrdf::theta_h_count, nd = MerlBrdf::theta_d_count,
              np = MerlBrdf::phi_d_count;
constexpr std::size_t node_count = std::size_t(nh) * nd * np;
constexpr std::size_t header_size = 3 * sizeof(std::int32_t);
constexpr std::size_t file_size = header_size + 3 * node_count * sizeof(double);
constexpr auto& scale = MerlBrdf::scale;

std::size_t position(int h, int d, int p) { return (std::size_t(h) * nd + d) * np + p; }

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

/// Before the bytes are looked at: files of another format can be huge.
void check_size(const std::filesystem::path& path, std::uintmax_t size) {
    if (size == file_size) return;
    fail(path,
         fmt::format("has {} bytes, but a BRDF of MERL's format has {}; {}", size, file_size,
                     size < file_size ? "it is incomplete or of another format: fetch it again"
                                      : "it is of another format"));
}

void check_header(std::string_view bytes, const std::filesystem::path& path) {
    std::int32_t n[3] = {};
    std::memcpy(n, bytes.data(), std::min(sizeof n, bytes.size()));
    if (bytes.size() < header_size || n[0] != nh || n[1] != nd || n[2] != np)
        fail(path,
             bytes.size() < header_size
                 ? fmt::format("has {} bytes, too few for a header; it is incomplete: fetch it "
                               "again",
                               bytes.size())
                 : fmt::format("the header says {} x {} x {} values, not {} x {} x {}: it is not "
                               "an isotropic BRDF of MERL's format",
                               n[0], n[1], n[2], nh, nd, np));
}

}  // namespace

MerlBrdf parse_merl(std::string_view bytes, const std::filesystem::path& path) {
    check_header(bytes, path);
    check_size(path, bytes.size());
    MerlBrdf brdf;
    brdf.values_.resize(node_count);
    for (std::size_t i = 0; i < node_count; ++i) {
        double v[3];
        for (int c = 0; c < 3; ++c) {
            std::memcpy(&v[c], bytes.data() + header_size + (c * node_count + i) * sizeof(double),
                        sizeof(double));
            v[c] *= scale[c];
            if (!(std::abs(v[c]) <= std::numeric_limits<float>::max()))
                fail(path, fmt::format("value {} of {} is {}, not a finite number; it is damaged: "
                                       "fetch it again",
                                       i + 1,
                                       c == 0   ? "red"
                                       : c == 1 ? "green"
                                                : "blue",
                                       v[c]));
        }
        if (v[0] < 0. || v[1] < 0. || v[2] < 0.) {
            brdf.values_[i] = Vec3f(-1.f, -1.f, -1.f);
            ++brdf.missing_;
        } else {
            brdf.values_[i] = Vec3f(float(v[0]), float(v[1]), float(v[2]));
        }
    }
    if (brdf.missing_ == node_count)
        fail(path, "all values are negative: there is no measurement in it");
    return brdf;
}

MerlBrdf read_merl(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) fail(path, "cannot be read; check the name");
    std::string bytes(std::min<std::uintmax_t>(size, header_size), '\0');
    file.read(bytes.data(), std::streamsize(bytes.size()));
    check_header(std::string_view(bytes.data(), std::size_t(file.gcount())), path);
    check_size(path, size);
    bytes.resize(file_size);
    file.read(bytes.data() + header_size, std::streamsize(file_size - header_size));
    bytes.resize(header_size + std::size_t(file.gcount()));
    return parse_merl(bytes, path);
}

std::optional<Vec3d> MerlBrdf::node(int theta_h, int theta_d, int phi_d) const {
    const Vec3f& v = values_[position(theta_h, theta_d, phi_d)];
    if (v.x < 0.f) return std::nullopt;
    return Vec3d(v);
}

namespace {

constexpr int node_counts[3] = {nh, nd, np};

/// Half-angle coordinates in units of nodes: the nodes below, and how far beyond them.
struct MerlPlace {
    int below[3];
    double part[3];

    MerlPlace(const Vec3d& wi, const Vec3d& wo) {
        const HalfAngle a = to_half_angle(wi, wo);
        const double pi = std::numbers::pi;
        double phi = a.phi_d < 0. ? a.phi_d + pi : a.phi_d;
        if (phi >= pi) phi -= pi;
        const double at[3] = {std::sqrt(a.theta_h / (0.5 * pi)) * nh, a.theta_d / (0.5 * pi) * nd,
                              phi / pi * np};
        for (int k = 0; k < 3; ++k) {
            below[k] = std::clamp(int(at[k]), 0, node_counts[k] - 1);
            part[k] = std::clamp(at[k] - below[k], 0., 1.);
        }
    }
};

}  // namespace

MerlNode MerlBrdf::node_below(const Vec3d& wi, const Vec3d& wo) {
    const MerlPlace at(wi, wo);
    const auto [h, d, p] = at.below;
    return {h, d, p, position(h, d, p)};
}

std::optional<Vec3d> MerlBrdf::eval(const Vec3d& wi, const Vec3d& wo, MerlLookup lookup) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    const MerlPlace at(wi, wo);
    const auto& below = at.below;
    const auto& part = at.part;
    if (lookup == MerlLookup::nearest) return node(below[0], below[1], below[2]);
    Vec3d sum;
    double found = 0.;
    for (int corner = 0; corner < 8; ++corner) {
        int n[3];
        double weight = 1.;
        for (int k = 0; k < 3; ++k) {
            const bool up = corner >> k & 1;
            weight *= up ? part[k] : 1. - part[k];
            n[k] = below[k] + up;
        }
        if (weight == 0.) continue;
        const auto v = node(std::min(n[0], nh - 1), std::min(n[1], nd - 1), n[2] % np);
        if (!v) continue;
        sum += weight * *v;
        found += weight;
    }
    if (found < 0.5) return std::nullopt;
    return sum / found;
}

bool MerlBrdf::eval(const Vec3f& wi, const Vec3f& wo, float* out) const {
    if (!(wi.z > 0.f && wo.z > 0.f)) return false;
    // Of half and difference vector, h = (wi + wo)/2 and d = (wi - wo)/2, lengths and angles follow
    // without turning anything: d is at right angles to h, so about h it lies at
    // phi_d = atan2(d_y h_x - d_x h_y, -d_z |h|) but for a factor.
    const Vec3f h = 0.5f * (wi + wo), d = 0.5f * (wi - wo);
    const float cos_d = length(h), sin_d = length(d), across = std::sqrt(h.x * h.x + h.y * h.y);
    float y = d.y * h.x - d.x * h.y, x = -d.z * cos_d;
    if (across < 1e-6f * cos_d) {  // theta_h = 0: phi_h is 0 there
        x = d.x;
        y = d.y;
    }
    if (y < 0.f) {  // the period is pi
        x = -x;
        y = -y;
    }
    constexpr float pi = std::numbers::pi_v<float>;
    const float at[3] = {std::sqrt(fast_atan2(across, h.z) * (2.f / pi)) * nh,
                         fast_atan2(sin_d, cos_d) * (2.f / pi) * nd,
                         fast_atan2(y, x) * (1.f / pi) * np};
    int below[3];
    float part[3];
    for (int k = 0; k < 3; ++k) {
        below[k] = std::min(int(at[k]), node_counts[k] - 1);
        part[k] = std::min(at[k] - float(below[k]), 1.f);
    }
    const std::size_t h_step = below[0] < nh - 1 ? std::size_t(nd) * np : 0,
                      d_step = below[1] < nd - 1 ? np : 0;
    const Vec3f* first = &values_[position(below[0], below[1], below[2])];
    const std::ptrdiff_t next = below[2] < np - 1 ? 1 : 1 - np;
    Vec3f sum;
    float found = 0.f;
    for (int k = 0; k < 4; ++k) {
        const Vec3f* v = first + (k & 1 ? h_step : 0) + (k & 2 ? d_step : 0);
        const float w = (k & 1 ? part[0] : 1.f - part[0]) * (k & 2 ? part[1] : 1.f - part[1]);
        const float low = v[0].x < 0.f ? 0.f : w * (1.f - part[2]),
                    high = v[next].x < 0.f ? 0.f : w * part[2];
        sum += low * v[0] + high * v[next];
        found += low + high;
    }
    if (found < 0.5f) return false;
    const float scale_up = 1.f / found;
    out[0] = sum.x * scale_up;
    out[1] = sum.y * scale_up;
    out[2] = sum.z * scale_up;
    return true;
}

}  // namespace nacre
