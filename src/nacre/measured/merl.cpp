#include "nacre/measured/merl.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <numbers>
#include <system_error>

#include "nacre/math/error.h"
#include "nacre/math/fast_atan2.h"

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
            ++brdf.missing_;
        } else {
            brdf.values_[i] = {float(v[0]), float(v[1]), float(v[2]), 1.f};
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
    const Lanes<float, 4> v = values_[position(theta_h, theta_d, phi_d)];
    if (v[3] == 0.f) return std::nullopt;
    return Vec3d(v[0], v[1], v[2]);
}

namespace {

constexpr int node_counts[3] = {nh, nd, np};

/// Angles of three vectors in the plane.
std::array<double, 3> angles_of(const std::array<double, 3>& y, const std::array<double, 3>& x) {
    return {std::atan2(y[0], x[0]), std::atan2(y[1], x[1]), std::atan2(y[2], x[2])};
}
Lanes<float, 4> angles_of(const std::array<float, 3>& y, const std::array<float, 3>& x) {
    return fast_atan2(Lanes<float, 4>(y[0], y[1], y[2], 0.f),
                      Lanes<float, 4>(x[0], x[1], x[2], 1.f));
}

Lanes<float, 4> in(float, Lanes<float, 4> v) { return v; }
Lanes<double, 4> in(double, Lanes<float, 4> v) { return {v[0], v[1], v[2], v[3]}; }

/// Half-angle coordinates in units of nodes: the nodes below, and how far beyond them. Of h = (wi +
/// wo)/2 and d = (wi - wo)/2, the half and the difference vector, lengths and angles follow without
/// turning anything: phi_d is the azimuth of d about h, from h's plane of incidence on, written so that
/// it keeps its digits near the normal.
template <class T>
struct MerlPlace {
    int below[3];
    T part[3];

    MerlPlace(const Vec3<T>& wi, const Vec3<T>& wo) {
        const Vec3<T> h = T(0.5) * (wi + wo), d = T(0.5) * (wi - wo);
        const T cos_d = length(h), across = std::sqrt(h.x * h.x + h.y * h.y);
        T y = d.y * h.x - d.x * h.y;
        T x = (h.z * (h.x * d.x + h.y * d.y) - across * across * d.z) / cos_d;
        if (across == T(0)) {
            x = d.x;  // theta_h = 0: phi_h is 0 there
            y = d.y;
        }
        if (y < T(0)) {  // the period is pi
            x = -x;
            y = -y;
        }
        constexpr T pi = std::numbers::pi_v<T>;
        const auto angles = angles_of(std::array{across, length(d), y}, std::array{h.z, cos_d, x});
        const T at[3] = {std::sqrt(angles[0] * (T(2) / pi)) * nh, angles[1] * (T(2) / pi) * nd,
                         angles[2] * (T(1) / pi) * np};
        for (int k = 0; k < 3; ++k) {
            // What is no number stays within the table.
            const T place = at[k] > T(0) ? std::min(at[k], T(node_counts[k])) : T(0);
            below[k] = std::min(int(place), node_counts[k] - 1);
            part[k] = std::min(place - T(below[k]), T(1));
        }
    }
};

/// Linear between the nodes around that are measured; nothing where they hold less than half.
template <class T>
std::optional<Vec3<T>> interpolate(const std::vector<Lanes<float, 4>>& values,
                                   const MerlPlace<T>& at) {
    const auto& [below, part] = at;
    const std::size_t h_step = below[0] < nh - 1 ? std::size_t(nd) * np : 0,
                      d_step = below[1] < nd - 1 ? np : 0;
    const Lanes<float, 4>* first = &values[position(below[0], below[1], below[2])];
    const std::ptrdiff_t next = below[2] < np - 1 ? 1 : 1 - np;
    Lanes<T, 4> sum;
    for (int k = 0; k < 4; ++k) {
        const Lanes<float, 4>* v = first + (k & 1 ? h_step : 0) + (k & 2 ? d_step : 0);
        const T w = (k & 1 ? part[0] : T(1) - part[0]) * (k & 2 ? part[1] : T(1) - part[1]);
        sum += in(w, v[0]) * Lanes<T, 4>(w * (T(1) - part[2])) +
               in(w, v[next]) * Lanes<T, 4>(w * part[2]);
    }
    if (sum[3] < T(0.5)) return std::nullopt;
    const Lanes<T, 4> mean = sum / Lanes<T, 4>(sum[3]);
    return Vec3<T>{mean[0], mean[1], mean[2]};
}

}  // namespace

MerlNode MerlBrdf::node_below(const Vec3d& wi, const Vec3d& wo) {
    const MerlPlace<double> at(wi, wo);
    const auto [h, d, p] = at.below;
    return {h, d, p, position(h, d, p)};
}

std::optional<Vec3d> MerlBrdf::eval(const Vec3d& wi, const Vec3d& wo, MerlLookup lookup) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    const MerlPlace<double> at(wi, wo);
    if (lookup == MerlLookup::nearest) return node(at.below[0], at.below[1], at.below[2]);
    return interpolate(values_, at);
}

std::optional<Vec3f> MerlBrdf::eval_float(const Vec3f& wi, const Vec3f& wo) const {
    if (!(wi.z > 0.f && wo.z > 0.f)) return std::nullopt;
    return interpolate(values_, MerlPlace<float>(wi, wo));
}

}  // namespace nacre
