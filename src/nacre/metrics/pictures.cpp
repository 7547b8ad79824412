#include "nacre/metrics/pictures.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {

PixelMask::PixelMask(const Image& image)
    : PixelMask(image.width, image.height, [&](int x, int y) { return image.rgb(x, y).y > 0.5f; }) {
}

PixelMask::PixelMask(int width, int height, const std::function<bool(int x, int y)>& counts)
    : width_(width), height_(height) {
    if (width < 1 || height < 1)
        throw InputError(fmt::format(
            "a mask of {} x {} pixels cannot be made; both sides must be positive", width, height));
    counts_.reserve(std::size_t(width) * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) counts_.push_back(counts(x, y));
}

std::size_t PixelMask::count(int width, int height) const {
    if (counts_.empty()) return std::size_t(width) * height;
    if (width_ != width || height_ != height)
        throw InputError(
            fmt::format("the mask has {} x {} pixels, but the pictures have {} x {}; make it of "
                        "their size",
                        width_, height_, width, height));
    const std::ptrdiff_t n = std::count(counts_.begin(), counts_.end(), 1);
    if (n == 0)
        throw InputError(
            "the mask leaves no pixel; its green must be above 0.5 where a pixel counts");
    return static_cast<std::size_t>(n);
}

void check_same_size(const char* what, const Image& image, const Image& reference) {
    if (image.width != reference.width || image.height != reference.height)
        throw InputError(
            fmt::format("{} has {} x {} pixels, but the reference has {} x {}; compare pictures of "
                        "one size",
                        what, image.width, image.height, reference.width, reference.height));
    if (image.data.empty()) throw InputError(fmt::format("{} has no pixels", what));
}

void check_finite(const char* what, const Image& image, const PixelMask& mask, const char* remedy) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (!mask(x, y)) continue;
            const Vec3f v = image.rgb(x, y);
            if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
                throw InputError(fmt::format("{} is not finite at pixel ({}, {}): ({}, {}, {}); {}",
                                             what, x, y, v.x, v.y, v.z, remedy));
        }
}

}  // namespace nacre
