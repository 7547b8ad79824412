#include "nacre/render/filter.h"

#include <limits>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

float default_radius(const FilterSettings& s) {
    if (s.type == "box") return 0.5f;
    if (s.type == "tent") return 1.f;
    if (s.type == "gaussian") return 4.f * s.stddev;
    if (s.type == "mitchell") return 2.f;
    throw InputError(
        unknown_name("reconstruction filter", s.type, {"box", "tent", "gaussian", "mitchell"}));
}

/// Mitchell and Netravali 1988, equation 8; |x| in [0, 2].
double mitchell(double x, double b, double c) {
    x = std::abs(x);
    if (x >= 2) return 0;
    if (x >= 1)
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                (8 * b + 24 * c)) /
               6;
    return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
}

}  // namespace

Filter::Filter(const FilterSettings& settings) : settings_(settings), box_(settings.type == "box") {
    const float otherwise = default_radius(settings);
    radius_ = settings.radius == 0.f ? otherwise : settings.radius;
    if (!(radius_ > 0.f) || !std::isfinite(radius_))
        throw InputError(
            fmt::format("a reconstruction filter of radius {} has no area; give it a "
                        "positive radius or standard deviation",
                        radius_));
    const double width = 2.0 * radius_ / cells;
    double sum = 0, absolute = 0;
    std::array<double, cells> mass;
    for (int i = 0; i < cells; ++i) {
        // Three-point Gauss-Legendre: exact for the polynomials, 1e-12 for the Gaussian.
        const double mid = -radius_ + (i + 0.5) * width, h = 0.5 * width * std::sqrt(0.6);
        const double integral =
            width * (5 * shape(mid - h) + 8 * shape(mid) + 5 * shape(mid + h)) / 18;
        negative_[i] = integral < 0;
        mass[i] = std::abs(integral);
        sum += integral;
        absolute += mass[i];
    }
    if (!(sum > 0)) throw InputError("the reconstruction filter has no positive integral");
    scale_ = static_cast<float>(1 / sum);
    absolute_ = static_cast<float>(absolute / sum);
    double running = 0;
    cdf_[0] = 0.f;
    for (int i = 0; i < cells; ++i) {
        running += mass[i];
        cdf_[i + 1] = static_cast<float>(running / absolute);
    }
    cdf_[cells] = 1.f;
}

double Filter::shape(double x) const {
    if (std::abs(x) > radius_) return 0;
    if (settings_.type == "tent") return 1 - std::abs(x) / radius_;
    if (settings_.type == "gaussian") {
        const double a = -0.5 / (double(settings_.stddev) * settings_.stddev);
        return std::max(0.0, std::exp(a * x * x) - std::exp(a * radius_ * radius_));
    }
    if (settings_.type == "mitchell") return mitchell(2 * x / radius_, settings_.b, settings_.c);
    return 1;
}

float Filter::eval(float x) const { return static_cast<float>(shape(x)) * scale_; }

std::pair<float, bool> Filter::sample1d(float u) const {
    if (box_) return {radius_ * (2.f * u - 1.f), false};
    const auto it = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, u);
    const int i = static_cast<int>(it - cdf_.begin()) - 1;
    const float mass = cdf_[i + 1] - cdf_[i];
    const float within = mass > 0.f ? std::min((u - cdf_[i]) / mass, 1.f) : 0.5f;
    return {radius_ * (2.f * (i + within) / cells - 1.f), negative_[i]};
}

FilterSample Filter::sample(Vec2f u) const {
    const auto [x, negative_x] = sample1d(u.x);
    const auto [y, negative_y] = sample1d(u.y);
    const float weight = absolute_integral();
    return {{x, y}, negative_x != negative_y ? -weight : weight};
}

FilterWindow filter_window(const FilmSettings& film, int x, int y) {
    constexpr float far = std::numeric_limits<float>::infinity();
    if (film.sample_border) return {{-far, -far}, {far, far}};
    return {{-(float(x) + 0.5f), -(float(y) + 0.5f)},
            {float(film.width - x) - 0.5f, float(film.height - y) - 0.5f}};
}

float Filter::position(float x) const {
    return std::clamp((x / radius_ + 1.f) * 0.5f * cells, 0.f, float(cells));
}

float Filter::share_below(float x) const {
    const float at = position(x);
    const int i = std::min(static_cast<int>(at), cells - 1);
    return cdf_[i] + (at - i) * (cdf_[i + 1] - cdf_[i]);
}

float Filter::absolute_integral(float low, float high) const {
    if (holds(low, high)) return absolute_;
    const float begin = position(low), end = position(high);
    double integral = 0, absolute = 0;
    for (int i = 0; i < cells; ++i) {
        const double part = std::clamp(end - i, 0.f, 1.f) - std::clamp(begin - i, 0.f, 1.f);
        const double mass = part * (double(cdf_[i + 1]) - cdf_[i]);
        absolute += mass;
        integral += negative_[i] ? -mass : mass;
    }
    if (!(integral > 1e-3 * absolute))
        throw InputError(
            "at the film's border the part of the reconstruction filter that lies on the film has "
            "no positive integral; set sample_border to true or choose another filter");
    return static_cast<float>(absolute / integral);
}

std::pair<float, bool> Filter::sample1d(float u, float low, float high) const {
    if (holds(low, high)) return sample1d(u);
    low = std::max(low, -radius_);
    high = std::min(high, radius_);
    if (box_) return {low + (high - low) * u, false};
    const float below = share_below(low), until = share_below(high);
    const auto [x, negative] = sample1d(std::min(below + (until - below) * u, cdf_[cells]));
    return {std::clamp(x, low, high), negative};
}

FilterSample Filter::sample(Vec2f u, const FilterWindow& window) const {
    const auto [x, negative_x] = sample1d(u.x, window.low.x, window.high.x);
    const auto [y, negative_y] = sample1d(u.y, window.low.y, window.high.y);
    // Of either sign; the film knows how much the lobes of a pixel count.
    const float weight = absolute_integral();
    return {{x, y}, negative_x != negative_y ? -weight : weight};
}

}  // namespace nacre
