#include "nacre/denoise/denoise.h"

#include <array>
#include <cmath>

#include "nacre/denoise/noise.h"
#include "nacre/denoise/regression.h"
#include "nacre/math/error.h"

namespace nacre {
namespace denoising {
namespace {

/// Features that vary by less are noise or nothing.
constexpr float feature_noise = 0.01f;
/// Features that differ by less are of pixels that are equally noisy.
constexpr float alike = 0.05f;

Planes planes_of(const Image& image, int count, float factor = 1.f) {
    Planes planes(image.width, image.height, count);
    for (int c = 0; c < count; ++c)
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const float v = image.at(x, y, c);
                if (!std::isfinite(v))
                    throw InputError(fmt::format(
                        "denoise: channel {} at ({}, {}) is {}; all values must be finite",
                        image.channels[std::size_t(c)], x, y, v));
                *planes.at(c, x, y) = v * factor;
            }
    planes.mirror();
    return planes;
}

/// f(x, y) at every pixel of one plane.
template <class F>
Planes made(int width, int height, F&& f) {
    Planes planes(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) *planes.at(0, x, y) = f(x, y);
    planes.mirror();
    return planes;
}

Planes scaled(const Planes& planes, float factor) {
    Planes result = planes;
    for (int c = 0; c < planes.count(); ++c)
        for (int y = 0; y < planes.height(); ++y)
            for (int x = 0; x < planes.width(); ++x) *result.at(c, x, y) *= factor;
    result.mirror();
    return result;
}

/// The same value wherever `planes` have one.
Planes constant(const Planes& planes, float value) {
    Planes result = planes;
    for (int c = 0; c < planes.count(); ++c)
        for (int y = 0; y < planes.height(); ++y)
            std::fill_n(result.at(c, 0, y), planes.width(), value);
    result.mirror();
    return result;
}

Planes larger(const Planes& a, const Planes& b) {
    Planes result = a;
    for (int c = 0; c < a.count(); ++c)
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                *result.at(c, x, y) = std::max(*a.at(c, x, y), *b.at(c, x, y));
    result.mirror();
    return result;
}

/// Both halves, each filtered by what the other says is alike.
struct Candidate {
    Planes halves[2];
    Planes error;  ///< estimate of the squared error, relative to the brightness
};

/// Brings the picture's mean near 1. A power of two, so that it costs no bits.
float scale_of(const DenoiseInput& input) {
    double sum = 0;
    for (const Image& half : input.halves)
        for (const float v : half.data) sum += std::abs(v);
    const double mean = sum / double(input.halves[0].data.size() * 2);
    return mean > 0 && std::isfinite(mean) ? std::exp2(-float(std::ilogb(mean))) : 1.f;
}

class Denoiser {
  public:
    Denoiser(const DenoiseInput& input, float scale, const Work& work)
        : work_(work),
          colours_{planes_of(input.halves[0], 3, scale), planes_of(input.halves[1], 3, scale)},
          share_{input.share, 1.f - input.share},
          features_(planes_of(input.features, input.features.channel_count())) {
        Planes variance = planes_of(input.variance, 3, scale * scale);
        remove_fireflies(colours_, variance);
        variance_ = calibrated_variance(colours_, variance, share_);
        if (features_.count() > 0) {
            const Planes noise = planes_of(input.feature_variance, features_.count());
            features_ = weighted_mean(features_, PatchWeights(features_, noise, {4, 1, 1.f}));
        }
        mean_ = mean();
        // A pixel whose samples all missed what is rare would else seem sure of itself. Its like are
        // found by features: by colour, all that is noisy would be like it.
        const bool bare = features_.count() == 0;
        const Planes tolerance = bare ? variance_ : constant(features_, alike * alike);
        variance_ =
            larger(variance_, weighted_mean(variance_, PatchWeights(bare ? mean_ : features_,
                                                                    tolerance, {4, 1, 1.f})));
    }

    Planes run() {
        std::array<Candidate, 2> candidates{candidate(0.5f), candidate(1.f)};
        const Planes choice = chosen(candidates);
        Planes result(mean_.width(), mean_.height(), 3);
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < result.height(); ++y)
                for (int x = 0; x < result.width(); ++x) {
                    const auto of = [&](const Candidate& k) {
                        const float a = *k.halves[0].at(c, x, y), b = *k.halves[1].at(c, x, y);
                        return a + (b - a) * share_[1];
                    };
                    const float narrow = of(candidates[0]), wide = of(candidates[1]);
                    *result.at(c, x, y) = narrow + (wide - narrow) * *choice.at(0, x, y);
                }
        return result;
    }

  private:
    Planes mean() const {
        Planes result(colours_[0].width(), colours_[0].height(), 3);
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < result.height(); ++y)
                for (int x = 0; x < result.width(); ++x) {
                    const float a = *colours_[0].at(c, x, y), b = *colours_[1].at(c, x, y);
                    *result.at(c, x, y) = a + (b - a) * share_[1];
                }
        result.mirror();
        return result;
    }

    Candidate candidate(float k) const {
        Candidate result;
        for (int h = 0; h < 2; ++h) {
            work_.check();
            const Planes noise = scaled(variance_, 1.f / share_[1 - h]);
            result.halves[h] = first_order(colours_[h], features_, feature_noise,
                                           PatchWeights(colours_[1 - h], noise, {.k = k}));
        }
        // The other half, which is right but noisy, tells the error of each.
        const Planes noisy = made(mean_.width(), mean_.height(), [&](int x, int y) {
            float sum = 0.f;
            for (int h = 0; h < 2; ++h)
                for (int c = 0; c < 3; ++c) {
                    const float m = *mean_.at(c, x, y),
                                d = *result.halves[h].at(c, x, y) - *colours_[1 - h].at(c, x, y),
                                v = *variance_.at(c, x, y) / share_[1 - h];
                    sum += (d * d - v) / (m * m + v + 1e-6f);
                }
            return sum;
        });
        result.error = weighted_mean(noisy, PatchWeights(mean_, variance_, {.patch = 1}));
        return result;
    }

    /// How much of the wider candidate is taken, in [0, 1].
    Planes chosen(const std::array<Candidate, 2>& candidates) const {
        const Planes better = made(mean_.width(), mean_.height(), [&](int x, int y) {
            return *candidates[1].error.at(0, x, y) <= *candidates[0].error.at(0, x, y) ? 1.f : 0.f;
        });
        return weighted_mean(better, PatchWeights(mean_, variance_, {.patch = 1}));
    }

    const Work& work_;
    std::array<Planes, 2> colours_;
    std::array<float, 2> share_;
    Planes features_, variance_, mean_;
};

}  // namespace
}  // namespace denoising

Image denoise(const DenoiseInput& input, const Work& work) {
    using namespace denoising;
    const Image& first = input.halves[0];
    for (const Image* image :
         {&input.halves[1], &input.variance, &input.features, &input.feature_variance})
        if (image->channel_count() > 0 &&
            (image->width != first.width || image->height != first.height))
            throw InputError(fmt::format("denoise: images of {} x {} and {} x {} pixels",
                                         first.width, first.height, image->width, image->height));
    if (input.features.channel_count() > most_features)
        throw InputError(fmt::format("denoise: {} features; at most {}",
                                     input.features.channel_count(), most_features));
    bool positive = true;
    for (const Image& half : input.halves)
        for (const float v : half.data) positive = positive && v >= 0.f;
    const float scale = scale_of(input);
    Denoiser denoiser(input, scale, work);
    const Planes result = denoiser.run();
    Image image(first.width, first.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                // A line through noise may lead below what light can be.
                const float v = *result.at(c, x, y) / scale;
                image.at(x, y, c) = positive ? std::max(v, 0.f) : v;
            }
    return image;
}

}  // namespace nacre
