#include "nacre/render/film.h"

#include <tuple>

#include "nacre/math/error.h"
#include "nacre/render/filter.h"

namespace nacre {
namespace {

constexpr std::size_t kept_invalid_samples = 16;

auto order(const InvalidSample& s) { return std::tuple(s.y, s.x, s.sample); }

}  // namespace

Film::Film(const FilmSettings& settings)
    : settings_(settings), invalid_mutex_(std::make_unique<std::mutex>()) {
    FilmSettings& s = settings_;
    if (s.width < 1 || s.height < 1)
        throw InputError(
            fmt::format("a film of {} x {} pixels has no area; both sides must be "
                        "positive",
                        s.width, s.height));
    if (s.crop_width == 0 && s.crop_height == 0) {
        s.crop_x = s.crop_y = 0;
        s.crop_width = s.width;
        s.crop_height = s.height;
    }
    if (s.crop_x < 0 || s.crop_y < 0 || s.crop_width < 1 || s.crop_height < 1 ||
        s.crop_width > s.width - s.crop_x || s.crop_height > s.height - s.crop_y)
        throw InputError(
            fmt::format("the crop window {},{} {}x{} leaves the film of {} x {} pixels", s.crop_x,
                        s.crop_y, s.crop_width, s.crop_height, s.width, s.height));
    width_ = s.crop_width;
    height_ = s.crop_height;
    const Filter filter(s.filter);
    for (int x = 0; x < width_; ++x) {
        const FilterWindow w = filter_window(s, x + s.crop_x, s.crop_y);
        column_absolute_.push_back(filter.absolute_integral(w.low.x, w.high.x));
    }
    for (int y = 0; y < height_; ++y) {
        const FilterWindow w = filter_window(s, s.crop_x, y + s.crop_y);
        row_absolute_.push_back(filter.absolute_integral(w.low.y, w.high.y));
    }
    pixels_.resize(std::size_t(width_) * height_);
    // A lobe that is negative by rounding alone is none.
    if (filter.absolute_integral() > 1 + 1e-6) negative_.resize(pixels_.size());
}

void Film::add(int x, int y, std::uint32_t sample, const Vec3f& rgb, float filter_weight,
               bool may_be_negative) {
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(rgb[c]) || (rgb[c] < 0.f && !may_be_negative))
            return add_invalid(x, y, sample, rgb);
    PixelSums& p =
        filter_weight < 0.f && !negative_.empty() ? negative_[index(x, y)] : pixels_[index(x, y)];
    for (int c = 0; c < 3; ++c) {
        p.sum[c] += rgb[c];
        p.sum2[c] += double(rgb[c]) * rgb[c];
    }
    ++p.count;
}

void Film::add_invalid(int x, int y, std::uint32_t sample, const Vec3f& value) {
    ++pixels_[index(x, y)].invalid;
    const InvalidSample s{x + settings_.crop_x, y + settings_.crop_y, sample, value};
    const std::lock_guard lock(*invalid_mutex_);
    keep_invalid(s);
}

void Film::keep_invalid(const InvalidSample& s) {
    // Sorted and cut, so that what is kept does not depend on which thread came first.
    invalid_.insert(std::upper_bound(invalid_.begin(), invalid_.end(), s,
                                     [](auto& a, auto& b) { return order(a) < order(b); }),
                    s);
    if (invalid_.size() > kept_invalid_samples) invalid_.pop_back();
}

void Film::merge(const Film& other) {
    const FilmSettings &a = settings_, &b = other.settings_;
    const int dx = b.crop_x - a.crop_x, dy = b.crop_y - a.crop_y;
    const bool same = a.width == b.width && a.height == b.height && a.filter == b.filter &&
                      a.sample_border == b.sample_border && a.quantity == b.quantity;
    if (!same || dx < 0 || dy < 0 || dx + other.width_ > width_ || dy + other.height_ > height_)
        throw InputError(fmt::format(
            "a film of {} cannot be added to one of {}: they must show the same picture, and its "
            "window must lie within this one's",
            other.describe(), describe()));
    for (int y = 0; y < other.height_; ++y)
        for (int x = 0; x < other.width_; ++x) {
            const std::size_t to = index(x + dx, y + dy), from = other.index(x, y);
            pixels_[to] += other.pixels_[from];
            if (!negative_.empty()) negative_[to] += other.negative_[from];
        }
    for (const InvalidSample& s : other.invalid_) keep_invalid(s);
}

void Film::copy_pixels(const Film& from, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
        const std::size_t first = index(x0, y), n = std::size_t(x1 - x0);
        std::copy_n(&from.pixels_[first], n, &pixels_[first]);
        if (!negative_.empty()) std::copy_n(&from.negative_[first], n, &negative_[first]);
    }
}

void Film::copy_invalid(const Film& from) {
    const std::lock_guard lock(*from.invalid_mutex_);
    invalid_.clear();
    for (const InvalidSample& s : from.invalid_)
        if (s.sample < drawn(s.x - settings_.crop_x, s.y - settings_.crop_y)) keep_invalid(s);
}

std::string Film::describe() const {
    const FilmSettings& s = settings_;
    return fmt::format("{} x {} pixels, window {},{} {}x{}, {} filter", s.width, s.height, s.crop_x,
                       s.crop_y, s.crop_width, s.crop_height, s.filter.type);
}

PixelSums& PixelSums::operator+=(const PixelSums& o) {
    for (int c = 0; c < 3; ++c) {
        sum[c] += o.sum[c];
        sum2[c] += o.sum2[c];
    }
    count += o.count;
    invalid += o.invalid;
    return *this;
}

double PixelSums::variance(int c) const {
    if (count < 2) return 0;
    return std::max(0.0, (sum2[c] - sum[c] * sum[c] / count) / (count - 1.0));
}

Vec3f Film::mean(int x, int y) const {
    const PixelSums& p = pixels_[index(x, y)];
    Vec3f r;
    for (int c = 0; c < 3; ++c) {
        double mean = p.mean(c);
        if (!negative_.empty()) {
            const PixelSums& n = negative_[index(x, y)];
            // With samples of one kind only the other lobe is taken to look the same.
            const double plus = p.count ? mean : n.mean(c), minus = n.count ? n.mean(c) : plus;
            const double w = absolute_integral(x, y);
            mean = 0.5 * (w + 1) * plus - 0.5 * (w - 1) * minus;
        }
        r[c] = static_cast<float>(mean);
    }
    return r;
}

Vec3f Film::sample_variance(int x, int y) const {
    const PixelSums& p = pixels_[index(x, y)];
    Vec3f r;
    for (int c = 0; c < 3; ++c) {
        double variance = p.variance(c);
        if (!negative_.empty()) {
            const PixelSums& n = negative_[index(x, y)];
            const double w = absolute_integral(x, y), a = 0.5 * (w + 1), b = 0.5 * (w - 1);
            const double all = double(p.count) + n.count;
            if (p.count && n.count)
                variance = all * (a * a * variance / p.count + b * b * n.variance(c) / n.count);
            else if (!p.count)
                variance = n.variance(c);
        }
        r[c] = static_cast<float>(variance);
    }
    return r;
}

std::uint32_t Film::count(int x, int y) const {
    return pixels_[index(x, y)].count + (negative_.empty() ? 0 : negative_[index(x, y)].count);
}

std::uint32_t Film::drawn(int x, int y) const { return count(x, y) + pixels_[index(x, y)].invalid; }

std::uint64_t Film::invalid_count() const {
    std::uint64_t n = 0;
    for (const PixelSums& p : pixels_) n += p.invalid;
    return n;
}

std::vector<InvalidSample> Film::invalid_samples() const { return invalid_; }

}  // namespace nacre
