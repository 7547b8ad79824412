#include "nacre/metrics/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/metrics/flip_color.h"
#include "nacre/metrics/flip_filters.h"

namespace nacre {

namespace {

using namespace flip_steps;

// What the eye makes of one picture: colours after its filters, and the strength of features.
struct Seen {
    std::vector<Vec3f> lab;
    std::vector<float> edges, points;
};

// The filters depend on the screen alone.
struct Eye {
    std::vector<SpatialFilter> color[3];
    FeatureTaps features;
    explicit Eye(double pixels_per_degree) : features(feature_taps(pixels_per_degree)) {
        for (const Opponent c : {Opponent::achromatic, Opponent::red_green, Opponent::blue_yellow})
            color[int(c)] = contrast_sensitivity(c, pixels_per_degree);
    }
};

Plane filtered(const Plane& plane, const std::vector<SpatialFilter>& filters) {
    Plane r{plane.width, plane.height, std::vector<float>(plane.data.size())};
    for (const SpatialFilter& f : filters) {
        const Plane part = filter(plane, f.taps, f.taps);
        for (std::size_t i = 0; i < r.data.size(); ++i) r.data[i] += f.weight * part.data[i];
    }
    return r;
}

std::vector<float> strength(const Plane& plane, std::span<const float> derivative,
                            std::span<const float> smooth) {
    const Plane x = filter(plane, derivative, smooth), y = filter(plane, smooth, derivative);
    std::vector<float> r(plane.data.size());
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = std::hypot(x.data[i], y.data[i]);
    return r;
}

// `show` gives the linear light of the screen, in [0, 1], of a value.
template <class F>
Seen see(const Image& image, const Eye& eye, F&& show) {
    const std::size_t n = std::size_t(image.width) * image.height;
    const Plane empty{image.width, image.height, std::vector<float>(n)};
    Plane opponent[3] = {empty, empty, empty}, y = empty;
    tbb::parallel_for(0, image.height, [&](int row) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t i = std::size_t(row) * image.width + x;
            const Vec3f v = image.rgb(x, row);
            const Vec3f c = to_ycxcz({show(v.x), show(v.y), show(v.z)});
            for (int k = 0; k < 3; ++k) opponent[k].data[i] = c[k];
            y.data[i] = (c.x + 16.f) / 116.f;  // from 0 to 1
        }
    });
    Seen r;
    r.edges = strength(y, eye.features.edge, eye.features.smooth);
    r.points = strength(y, eye.features.point, eye.features.smooth);
    for (int k = 0; k < 3; ++k) opponent[k] = filtered(opponent[k], eye.color[k]);
    r.lab.resize(n);
    tbb::parallel_for(0, image.height, [&](int row) {
        for (std::size_t i = std::size_t(row) * image.width; i < std::size_t(row + 1) * image.width;
             ++i) {
            Vec3f rgb = from_ycxcz({opponent[0].data[i], opponent[1].data[i], opponent[2].data[i]});
            for (int k = 0; k < 3; ++k) rgb[k] = std::clamp(rgb[k], 0.f, 1.f);
            r.lab[i] = hunt_lab(rgb);
        }
    });
    return r;
}

template <class F>
Image error_map(const Image& a, const Image& b, const Eye& eye, F&& show) {
    const Seen seen_a = see(a, eye, show), seen_b = see(b, eye, show);
    Image r(a.width, a.height, {"Y"});
    tbb::parallel_for(0, a.height, [&](int row) {
        for (std::size_t i = std::size_t(row) * a.width; i < std::size_t(row + 1) * a.width; ++i) {
            const float color =
                redistribute(std::pow(hyab(seen_a.lab[i], seen_b.lab[i]), color_exponent));
            const float feature = std::max(std::abs(seen_a.edges[i] - seen_b.edges[i]),
                                           std::abs(seen_a.points[i] - seen_b.points[i]));
            // A filtered step reaches 1 on an axis, sqrt(2) on both; rounding may pass it.
            const float f = std::min(1.f, std::sqrt(feature / std::sqrt(2.f)));
            r.data[i] = color > 0.f ? std::pow(color, 1.f - f) : 0.f;
        }
    });
    return r;
}

double mean_over(const PixelMask& mask, const Image& map) {
    double sum = 0.;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            if (mask(x, y)) sum += double(map.at(x, y, 0));
    return sum / static_cast<double>(mask.count(map.width, map.height));
}

void check(const Image& picture, const Image& reference, const PixelMask& mask, double ppd) {
    if (!(ppd >= 1. && ppd <= 10000.))
        throw InputError(
            fmt::format("pixels per degree: {} is out of range; it must be from 1 to 10000", ppd));
    check_same_size("the picture", picture, reference);
    mask.count(picture.width, picture.height);
    // Filters carry a value to its neighbours, whatever the mask.
    constexpr const char* remedy = "mend it: FLIP sees every pixel, masked or not";
    check_finite("the picture", picture, {}, remedy);
    check_finite("the reference", reference, {}, remedy);
}

// Coefficients of the tone mapper, exposure undone: (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4).
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k2 = 0.6 * 0.6 * 2.43, k3 = 0.6 * 0.59,
                 k4 = 0.14;

// The x that the tone mapper maps to t: the positive root of (k0 - t k2) x^2 + (k1 - t k3) x - t
// k4.
double inverse_tone_map(double t) {
    const double a = k0 - t * k2, half = 0.5 * (k1 - t * k3) / a;
    return -half + std::sqrt(half * half + t * k4 / a);
}

}  // namespace

FlipResult flip(const Image& picture, const Image& reference, const PixelMask& mask,
                double pixels_per_degree) {
    check(picture, reference, mask, pixels_per_degree);
    FlipResult r;
    r.map = error_map(picture, reference, Eye(pixels_per_degree),
                      [](float v) { return std::clamp(v, 0.f, 1.f); });
    r.mean = mean_over(mask, r.map);
    return r;
}

FlipExposures flip_exposures(const Image& reference) {
    std::vector<double> luminances;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            const Vec3d c(reference.rgb(x, y));
            luminances.push_back(dot(Vec3d(0.2126, 0.7152, 0.0722), c));  // ITU-R BT.709
        }
    std::sort(luminances.begin(), luminances.end());
    const auto median = [&] {
        const std::size_t n = luminances.size();
        return 0.5 * (luminances[(n - 1) / 2] + luminances[n / 2]);
    };
    if (luminances.empty() || luminances.back() <= 0.) return {};
    if (median() <= 0.)
        luminances.erase(luminances.begin(),
                         std::upper_bound(luminances.begin(), luminances.end(), 0.));
    constexpr double t = 0.85;
    const double x = inverse_tone_map(t);
    FlipExposures r{std::log2(x / luminances.back()), std::log2(x / median()), 1};
    if (r.stop > r.start) r.count = std::max(2, int(std::ceil(r.stop - r.start)));
    return r;
}

float flip_tone_map(float value, double exposure) {
    const double x = std::exp2(exposure) * double(std::max(value, 0.f));
    if (x > 1e6) return 1.f;  // the curve has passed 1 long before; its square may overflow
    return float(std::clamp((k0 * x + k1) * x / ((k2 * x + k3) * x + k4), 0., 1.));
}

HdrFlipResult flip_hdr(const Image& picture, const Image& reference, const PixelMask& mask,
                       double pixels_per_degree, std::optional<FlipExposures> exposures) {
    check(picture, reference, mask, pixels_per_degree);
    HdrFlipResult r;
    r.exposures = exposures ? *exposures : flip_exposures(reference);
    if (r.exposures.count < 1)
        throw InputError(
            fmt::format("exposures: {} are too few; there must be at least 1", r.exposures.count));
    const Eye eye(pixels_per_degree);
    for (int i = 0; i < r.exposures.count; ++i) {
        const double exposure = r.exposures[i];
        const Image map =
            error_map(picture, reference, eye, [=](float v) { return flip_tone_map(v, exposure); });
        if (i == 0) {
            r.map = map;
            r.exposure = Image(map.width, map.height, {"Y"});
            std::fill(r.exposure.data.begin(), r.exposure.data.end(), float(exposure));
        }
        for (std::size_t k = 0; k < map.data.size(); ++k)
            if (map.data[k] > r.map.data[k]) {
                r.map.data[k] = map.data[k];
                r.exposure.data[k] = float(exposure);
            }
    }
    r.mean = mean_over(mask, r.map);
    return r;
}

}  // namespace nacre
