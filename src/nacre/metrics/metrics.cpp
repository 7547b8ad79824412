#include "nacre/metrics/metrics.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {

namespace {

constexpr double two_over_pi = 0.63661977236758134;

void check(const MetricOptions& o) {
    const auto refuse = [](const char* name, double value, const char* range) {
        throw InputError(fmt::format("{}: {} is out of range; it must be {}", name, value, range));
    };
    if (!(o.epsilon > 0) || !std::isfinite(o.epsilon)) refuse("epsilon", o.epsilon, "positive");
    if (!(o.trim >= 0 && o.trim < 1)) refuse("trim", o.trim, "at least 0 and below 1");
    if (o.block < 1) refuse("block", o.block, "at least 1");
    for (const double p : o.percentiles)
        if (!(p >= 0 && p <= 100)) refuse("percentiles", p, "from 0 to 100");
}

void check_variance(const char* what, const Image* variance, const Image& reference,
                    const PixelMask& mask) {
    if (!variance) return;
    check_same_size(what, *variance, reference);
    check_finite(what, *variance, mask);
    for (int y = 0; y < variance->height; ++y)
        for (int x = 0; x < variance->width; ++x) {
            const Vec3f v = variance->rgb(x, y);
            if (mask(x, y) && (v.x < 0 || v.y < 0 || v.z < 0))
                throw InputError(fmt::format("{} is negative at pixel ({}, {}): ({}, {}, {})", what,
                                             x, y, v.x, v.y, v.z));
        }
}

// Sums of one metric, a channel each.
class Sums {
  public:
    void add(int channel, double value, double noise) {
        value_[channel] += value;
        noise_[channel] += noise;
    }
    void add_linear_variance(int channel, double variance) { least_[channel] += variance; }
    // d^2 w of a difference d with variance v: see Metrics::mse.
    void add_square(int channel, double d, double v, double w) {
        add(channel, d * d * w, v * w);
        variance_[channel] += (4. * d * d * v - 2. * v * v) * w * w;
        least_[channel] += 2. * v * v * w * w;
    }
    // |d| w: see Metrics::mape.
    void add_absolute(int channel, double d, double v, double w) {
        add(channel, std::abs(d) * w, std::sqrt(two_over_pi * v) * w);
        least_[channel] += v * w * w;
    }

    // The mean over `n` values of channels `first` to `last`.
    Metric mean(double n, bool noise_known, int first = 0, int last = 2) const {
        Metric m;
        double noise = 0., error = 0.;
        for (int c = first; c <= last; ++c) {
            m.value += value_[c] / n;
            noise += noise_[c] / n;
            error += std::sqrt(std::max(variance_[c], least_[c])) / n;
        }
        if (noise_known) {
            m.noise = noise;
            m.standard_error = error;
        }
        return m;
    }

  private:
    double value_[3]{}, noise_[3]{}, variance_[3]{};
    double least_[3]{};  // what the variance is at least
};

Vec3d variance_at(const UncertainPicture& a, const UncertainPicture& b, int x, int y) {
    Vec3d v{0., 0., 0.};
    if (a.variance) v += Vec3d(a.variance->rgb(x, y));
    if (b.variance) v += Vec3d(b.variance->rgb(x, y));
    return v;
}

BlockError block_error(const UncertainPicture& picture, const UncertainPicture& reference,
                       const PixelMask& mask, int side, bool noise_known) {
    const Image& p = picture.mean;
    BlockError r;
    Sums sums;
    for (int y0 = 0; y0 <= p.height - side; y0 += side)
        for (int x0 = 0; x0 <= p.width - side; x0 += side) {
            Vec3d sum_p{0., 0., 0.}, sum_t = sum_p, variance_p = sum_p, variance_t = sum_p;
            bool whole = true;
            for (int y = y0; y < y0 + side && whole; ++y)
                for (int x = x0; x < x0 + side; ++x) {
                    whole = whole && mask(x, y);
                    if (!whole) break;
                    sum_p += Vec3d(p.rgb(x, y));
                    sum_t += Vec3d(reference.mean.rgb(x, y));
                    if (picture.variance) variance_p += Vec3d(picture.variance->rgb(x, y));
                    if (reference.variance) variance_t += Vec3d(reference.variance->rgb(x, y));
                }
            for (int c = 0; c < 3 && whole; ++c) {
                if (!(sum_t[c] > 0)) continue;
                const double ratio = sum_p[c] / sum_t[c];
                // Of a ratio, to first order.
                const double v =
                    (variance_p[c] + ratio * ratio * variance_t[c]) / (sum_t[c] * sum_t[c]);
                sums.add_square(c, ratio - 1., v, 1.);
                ++r.blocks;
            }
        }
    if (r.blocks) r.mean_square = sums.mean(r.blocks, noise_known);
    return r;
}

double percentile(const std::vector<double>& sorted, double percent) {
    const double at = percent / 100. * static_cast<double>(sorted.size() - 1);
    const std::size_t low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

double mean_of_all_but_the_worst(std::vector<double>& values, double trim) {
    std::sort(values.begin(), values.end());
    const double size = static_cast<double>(values.size());
    const std::size_t kept = values.size() - static_cast<std::size_t>(size * trim);
    double sum = 0.;
    for (std::size_t i = 0; i < kept; ++i) sum += values[i];
    return sum / static_cast<double>(kept);
}

template <class F>
Image error_image(const Image& picture, const Image& reference, double epsilon, F&& error) {
    check_same_size("the picture", picture, reference);
    check({.epsilon = epsilon});
    Image r(picture.width, picture.height);
    for (int y = 0; y < r.height; ++y)
        for (int x = 0; x < r.width; ++x) {
            const Vec3f p = picture.rgb(x, y), t = reference.rgb(x, y);
            for (int c = 0; c < 3; ++c)
                r.at(x, y, c) = static_cast<float>(error(double(p[c]), double(t[c])));
        }
    return r;
}

}  // namespace

std::optional<Image> variance_of_mean(const Image& picture) {
    const auto samples_text = picture.metadata.find("nacre.samples");
    const auto complete = picture.metadata.find("nacre.complete");
    if (samples_text == picture.metadata.end() || complete == picture.metadata.end() ||
        complete->second != "yes")
        return {};
    const std::string& text = samples_text->second;
    int samples = 0;
    std::from_chars(text.data(), text.data() + text.size(), samples);
    if (samples < 2) return {};  // no variance can be told from one sample
    std::vector<std::string> names = {"R", "G", "B"};
    if (picture.channel("variance.Y") >= 0) names = {"Y"};
    Image r(picture.width, picture.height, names);
    for (std::size_t c = 0; c < names.size(); ++c) {
        const int from = picture.channel("variance." + names[c]);
        if (from < 0) return {};
        for (int y = 0; y < r.height; ++y)
            for (int x = 0; x < r.width; ++x)
                r.at(x, y, static_cast<int>(c)) =
                    picture.at(x, y, from) / static_cast<float>(samples);
    }
    return r;
}

double BlockError::rms() const { return std::sqrt(mean_square.value); }

Metrics compare(const UncertainPicture& picture, const UncertainPicture& reference,
                const PixelMask& mask, const MetricOptions& options) {
    const Image &p = picture.mean, &t = reference.mean;
    check(options);
    check_same_size("the picture", p, t);
    Metrics m;
    m.pixels = mask.count(p.width, p.height);
    check_finite("the picture", p, mask);
    check_finite("the reference", t, mask);
    check_variance("the variance of the picture", picture.variance, t, mask);
    check_variance("the variance of the reference", reference.variance, t, mask);

    const double epsilon = options.epsilon;
    Sums bias, mse, rel_mse, mape, smape;
    std::vector<double> value_errors, pixel_errors;
    value_errors.reserve(3 * m.pixels);
    pixel_errors.reserve(m.pixels);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!mask(x, y)) continue;
            const Vec3d a(p.rgb(x, y)), b(t.rgb(x, y)), v = variance_at(picture, reference, x, y);
            double pixel_error = 0.;
            for (int c = 0; c < 3; ++c) {
                const double d = a[c] - b[c], relative = 1. / (b[c] * b[c] + epsilon);
                m.mean_picture[c] += a[c] / static_cast<double>(m.pixels);
                m.mean_reference[c] += b[c] / static_cast<double>(m.pixels);
                bias.add(c, d, 0.);
                bias.add_linear_variance(c, v[c]);
                mse.add_square(c, d, v[c], 1.);
                rel_mse.add_square(c, d, v[c], relative);
                mape.add_absolute(c, d, v[c], 1. / (std::abs(b[c]) + epsilon));
                smape.add_absolute(c, d, v[c], 1. / (std::abs(a[c]) + std::abs(b[c]) + epsilon));
                value_errors.push_back(d * d * relative);
                pixel_error += d * d * relative / 3.;
            }
            pixel_errors.push_back(std::sqrt(pixel_error));
        }

    const bool noise_known = picture.variance || reference.variance;
    const double pixels = static_cast<double>(m.pixels), values = 3. * pixels;
    for (int c = 0; c < 3; ++c) m.channel_bias[c] = bias.mean(pixels, noise_known, c, c);
    m.bias = bias.mean(values, noise_known);
    m.mse = mse.mean(values, noise_known);
    m.rel_mse = rel_mse.mean(values, noise_known);
    m.rel_mse_trimmed = mean_of_all_but_the_worst(value_errors, options.trim);
    m.mape = mape.mean(values, noise_known);
    m.smape = smape.mean(values, noise_known);
    m.block = block_error(picture, reference, mask, options.block, noise_known);
    std::sort(pixel_errors.begin(), pixel_errors.end());
    for (const double percent : options.percentiles)
        m.percentiles.emplace_back(percent, percentile(pixel_errors, percent));
    return m;
}

Image signed_relative_error(const Image& picture, const Image& reference, double epsilon) {
    return error_image(picture, reference, epsilon,
                       [=](double p, double t) { return (p - t) / (std::abs(t) + epsilon); });
}

Image squared_relative_error(const Image& picture, const Image& reference, double epsilon) {
    return error_image(picture, reference, epsilon,
                       [=](double p, double t) { return (p - t) * (p - t) / (t * t + epsilon); });
}

}  // namespace nacre
