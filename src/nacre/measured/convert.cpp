#include "nacre/measured/convert.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/math/warp.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/views.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t pair_count = 4096;
const double usual = std::cos(80. * pi / 180.);

Vec3d by_cosine(Random& random) {
    const Vec2f u = random.next2();
    return normalize(Vec3d(square_to_cosine_hemisphere(u)));
}

bool is_usual(const DirectionPair& p) { return p.wi.z > usual && p.wo.z > usual; }

DirectionPair hemisphere_pair(Random& random) {
    while (true) {
        const DirectionPair p{by_cosine(random), by_cosine(random)};
        if (is_usual(p)) return p;
    }
}

/// Fine about the normal, as half vectors of highlights are.
DirectionPair highlight_pair(Random& random) {
    while (true) {
        const double x = 0.6 * random.next();
        const DirectionPair p = from_half_angle({.theta_h = 0.5 * pi * x * x,
                                                 .phi_h = 2. * pi * random.next(),
                                                 .theta_d = 80. * pi / 180. * random.next(),
                                                 .phi_d = 2. * pi * random.next()});
        if (is_usual(p)) return p;
    }
}

DirectionPair grazing_pair(Random& random) {
    const double z = usual * (1e-3 + 0.999 * random.next());
    const Vec3d low = polar_direction(std::acos(z), 2. * pi * random.next());
    const Vec3d other = by_cosine(random);
    return random.next() < 0.5f ? DirectionPair{low, other} : DirectionPair{other, low};
}

ResamplingError error_over(std::string where, DirectionPair (*draw)(Random&), std::uint64_t stream,
                           const Measured& source, const Measured& file) {
    ResamplingError e;
    e.where = std::move(where);
    const std::size_t n = std::size_t(source.info().channels);
    std::vector<double> a(n), b(n);
    struct Compared {
        double value, difference;
    };
    std::vector<Compared> compared;
    Random random(stream_key(1318, stream));
    for (std::size_t i = 0; i < pair_count; ++i) {
        const DirectionPair p = draw(random);
        const bool known = source.eval(p.wi, p.wo, a), read = file.eval(p.wi, p.wo, b);
        e.unknown += known && !read;
        e.added += read && !known;
        if (!known || !read) continue;
        Compared c{0., 0.};
        for (std::size_t k = 0; k < n; ++k) {
            c.value += std::abs(a[k] * p.wo.z);
            c.difference += std::abs((a[k] - b[k]) * p.wo.z);
        }
        compared.push_back(c);
    }
    e.pairs = compared.size();
    double value = 0., difference = 0.;
    for (const Compared& c : compared) value += c.value, difference += c.difference;
    if (!(value > 0.)) return e;
    e.mean = difference / value;
    const double floor = 0.01 * value / double(compared.size());
    std::vector<double> relative;
    for (const Compared& c : compared) relative.push_back(c.difference / std::max(c.value, floor));
    const auto at = relative.begin() + std::ptrdiff_t(0.95 * double(relative.size() - 1));
    std::nth_element(relative.begin(), at, relative.end());
    e.percentile95 = *at;
    return e;
}

/// What of the source the format can hold, and what it cannot.
std::shared_ptr<const Measured> made_to_fit(std::shared_ptr<const Measured> data,
                                            const MeasuredFormat& format,
                                            const ConvertOptions& options,
                                            std::vector<std::string>& lost) {
    const MeasuredInfo info = data->info();
    const bool through = info.transmission_front || info.transmission_back;
    if (!info.reflection_front && !(format.keeps.transmission && info.transmission_front))
        throw InputError(
            fmt::format("{} holds light {}, and the data have none{}", format.title,
                        format.keeps.transmission ? "from the front" : "reflected in front",
                        format.keeps.transmission ? "" : "; csv holds more"));
    if (through && !format.keeps.transmission)
        lost.emplace_back("light that goes through: the format holds reflection alone");
    if (info.reflection_back)
        lost.emplace_back("light reflected behind: the format holds that in front alone");
    if (info.transmission_back && format.keeps.transmission)
        lost.emplace_back(
            "light that goes through from behind: the format holds that from the front");
    if (!info.isotropic && !format.keeps.anisotropy && !options.turned_around)
        throw InputError(
            fmt::format("{} holds isotropic surfaces, and this one is anisotropic; --isotropic "
                        "writes its mean over turns about the normal",
                        format.title));
    if (!info.isotropic && options.turned_around) {
        lost.emplace_back("anisotropy: the mean over turns about the normal is written");
        data = turned_around(std::move(data));
    }
    const std::size_t wavelengths = info.wavelengths.size();
    if (wavelengths > 1 && (options.colour || !format.keeps.wavelengths)) {
        lost.push_back(
            fmt::format("{} wavelengths: red, green and blue under D65 are written", wavelengths));
        return in_colour(std::move(data));
    }
    if (wavelengths == 1 && (options.colour || !format.keeps.wavelengths || !format.keeps.grey))
        lost.emplace_back("the wavelength: a single one is written as grey");
    if (info.channels == 1 && (options.colour || !format.keeps.grey))
        return in_colour(std::move(data));
    return data;
}

}  // namespace

std::vector<std::string_view> writable_formats() {
    std::vector<std::string_view> names;
    for (const MeasuredFormat* format : measured_formats())
        if (format->write) names.push_back(format->name);
    return names;
}

std::vector<ResamplingError> resampling_errors(const Measured& source, const Measured& file) {
    return {error_over("both within 80 degrees", hemisphere_pair, 1, source, file),
            error_over("about the highlight", highlight_pair, 2, source, file),
            error_over("beyond 80 degrees", grazing_pair, 3, source, file)};
}

Converted convert(std::shared_ptr<const Measured> source, const MeasuredFormat& format,
                  const ConvertOptions& options) {
    if (!format.write)
        throw InputError(fmt::format("{} cannot be written; known are {}", format.title,
                                     fmt::join(writable_formats(), ", ")));
    Converted c;
    const auto data = made_to_fit(std::move(source), format, options, c.lost);
    WrittenMeasured written = format.write(*data, options.write);
    c.bytes = std::move(written.bytes);
    c.lost.insert(c.lost.end(), written.lost.begin(), written.lost.end());
    c.data = format.read({c.bytes, "the converted file"});
    c.errors = resampling_errors(*data, *c.data);
    return c;
}

}  // namespace nacre
