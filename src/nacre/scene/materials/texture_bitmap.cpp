// <texture type="bitmap">: an image over texture coordinates.
//
//   filename                              EXR, PFM, HDR, PNG or JPEG
//   filter_type  bilinear (default), nearest
//   wrap_mode    repeat (default), mirror, clamp; wrap_mode_v where v is another (nacre's)
//   raw          false; true takes the stored numbers as they are: neither sRGB nor colours
//   to_uv        transform of the texture coordinates
//
// The image's top left corner is at (0, 0), u runs to the right and v downwards, as in Mitsuba 3;
// texel centres lie at half-integer multiples of the texel size. (OBJ files count v upwards; their
// reader turns it round.)
//
// With wavelengths, each texel is a spectrum by itself (uplift.h) and the four spectra around a
// point are mixed. A raw image of three channels counts as its luminance there, since its numbers
// are not a colour.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <mutex>

#include "nacre/image/image.h"
#include "nacre/scene/materials/texture_types.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/uplift.h"

namespace nacre {
namespace {

enum class Wrap { repeat, mirror, clamp };

int wrap_index(int i, int n, Wrap wrap) {
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    switch (wrap) {
        case Wrap::repeat:
            return modulo(i, n);
        case Wrap::mirror: {
            const int j = modulo(i, 2 * n);
            return j < n ? j : 2 * n - 1 - j;
        }
        case Wrap::clamp:
            break;
    }
    return std::clamp(i, 0, n - 1);
}

Wrap wrap_of(std::string_view word) {
    return word == "repeat" ? Wrap::repeat : word == "mirror" ? Wrap::mirror : Wrap::clamp;
}

/// Keeps texel coordinates where int does not overflow; NaN becomes a bound.
float bounded(float x) { return x > -1e9f ? std::min(x, 1e9f) : -1e9f; }

class Bitmap final : public Texture {
  public:
    struct Options {
        ColorRole role;
        bool nearest, raw;
        Wrap wrap_u, wrap_v;
        Transform to_uv;
    };

    Bitmap(const Image& image, const Options& options)
        : options_(options), width_(image.width), height_(image.height) {
        texels_.reserve(std::size_t(width_) * height_);
        double sum = 0.0;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const Vec3f rgb = image.rgb(x, y);
                const bool grey = rgb.x == rgb.y && rgb.y == rgb.z;
                all_grey_ &= grey;
                largest_ = std::max({largest_, rgb.x, rgb.y, rgb.z});
                sum += grey ? rgb.x : luminance(rgb);
                texels_.push_back(rgb);
            }
        mean_ = static_cast<float>(sum / static_cast<double>(texels_.size()));
    }

    Spectral eval(Vec2f uv, const Wavelengths& w) const override {
        if (w.mode == ColorMode::rgb_bands)
            return filter(uv, [&](std::size_t i) {
                return Spectral(texels_[i].x, texels_[i].y, texels_[i].z, 0.f);
            });
        const bool light = options_.role == ColorRole::illuminant && !options_.raw;
        Spectral value;
        if (options_.raw || all_grey_) {
            value = Spectral(eval_scalar(uv));
        } else {
            const std::vector<Uplifted>& spectra = uplifted();
            value = filter(uv, [&](std::size_t i) {
                return spectra[i].scale * spectra[i].shape.eval(w.lambda);
            });
        }
        if (light)
            value *= Spectral(d65_unit(w.lambda[0]), d65_unit(w.lambda[1]), d65_unit(w.lambda[2]),
                              d65_unit(w.lambda[3]));
        return value;
    }

    float eval_scalar(Vec2f uv) const override {
        return filter(
            uv, [&](std::size_t i) { return all_grey_ ? texels_[i].x : luminance(texels_[i]); });
    }

    float max() const override {
        // A coloured reflectance may reach one at some wavelength, other colours twice their
        // largest component (uplift.h), and D65 of Y = 1 stays below 1.3.
        if (options_.raw || (all_grey_ && options_.role != ColorRole::illuminant)) return largest_;
        switch (options_.role) {
            case ColorRole::reflectance:
                return std::max(largest_, 1.f);
            case ColorRole::unbounded:
                return 2.f * largest_;
            case ColorRole::illuminant:
                break;
        }
        return 2.f * 1.3f * largest_;
    }
    float mean() const override { return mean_; }

  private:
    struct Uplifted {
        float scale;
        SigmoidPolynomial shape;
    };

    /// Mixes the values `texel(index)` around a point.
    template <class F>
    std::invoke_result_t<F, std::size_t> filter(Vec2f uv, F texel) const {
        const Point3f p = options_.to_uv.point({uv.x, uv.y, 0.f});
        const float x = bounded(p.x * float(width_)), y = bounded(p.y * float(height_));
        const auto index = [&](int i, int j) {
            return std::size_t(wrap_index(j, height_, options_.wrap_v)) * width_ +
                   wrap_index(i, width_, options_.wrap_u);
        };
        if (options_.nearest) return texel(index(int(std::floor(x)), int(std::floor(y))));
        const int i = int(std::floor(x - 0.5f)), j = int(std::floor(y - 0.5f));
        const float a = x - 0.5f - float(i), b = y - 0.5f - float(j);
        return (1.f - b) * ((1.f - a) * texel(index(i, j)) + a * texel(index(i + 1, j))) +
               b * ((1.f - a) * texel(index(i, j + 1)) + a * texel(index(i + 1, j + 1)));
    }

    /// The texels as spectra, made when first asked for: a picture in RGB bands never needs them.
    const std::vector<Uplifted>& uplifted() const {
        std::call_once(uplift_once_, [&] {
            uplifted_.resize(texels_.size());
            // Isolated, lest this thread takes up another piece of the picture meanwhile, which
            // would wait for these very spectra.
            tbb::this_task_arena::isolate([&] {
                tbb::parallel_for(std::size_t(0), texels_.size(), [&](std::size_t i) {
                    const Vec3f& rgb = texels_[i];
                    const float scale = options_.role == ColorRole::reflectance
                                            ? 1.f
                                            : 2.f * std::max({rgb.x, rgb.y, rgb.z});
                    uplifted_[i] = {scale, fit_rgb(scale > 0.f ? rgb / scale : Vec3f())};
                });
            });
        });
        return uplifted_;
    }

    Options options_;
    int width_, height_;
    std::vector<Vec3f> texels_;
    bool all_grey_ = true;
    float largest_ = 0.f, mean_ = 0.f;
    mutable std::once_flag uplift_once_;
    mutable std::vector<Uplifted> uplifted_;
};

}  // namespace

TexturePtr make_bitmap(const SceneNode& node, ColorRole role, BuildContext& context) {
    Bitmap::Options options;
    options.role = role;
    options.nearest = node.get_choice("filter_type", {"bilinear", "nearest"}) == "nearest";
    const std::string wrap = node.get_choice("wrap_mode", {"repeat", "mirror", "clamp"});
    options.wrap_u = options.wrap_v = wrap_of(wrap);
    if (node.has("wrap_mode_v"))
        options.wrap_v = wrap_of(node.get_choice("wrap_mode_v", {"repeat", "mirror", "clamp"}));
    options.raw = node.get_bool("raw", false);
    options.to_uv = node.get_transform("to_uv");

    if (const auto in_memory = context.images.find(&node); in_memory != context.images.end()) {
        node.get_string("picture", "");  // what it is, for the scene's content key
        return std::make_shared<Bitmap>(*in_memory->second, options);
    }
    const Image image = read_image(context.file(node, "filename"), {.raw = options.raw});
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Vec3f rgb = image.rgb(x, y);
            for (int c = 0; c < 3; ++c)
                if (!(rgb[c] >= 0.f && std::isfinite(rgb[c])))
                    node.fail_at("filename",
                                 fmt::format("'{}' has the value {} at pixel ({}, {}); a texture "
                                             "holds finite values that are not negative",
                                             node.get_string("filename"), rgb[c], x, y));
        }
    return std::make_shared<Bitmap>(image, options);
}

}  // namespace nacre
