#pragma once
// Pictures for the tests of comparisons.
#include <cmath>
#include <string>

#include "nacre/image/image.h"
#include "nacre/math/random.h"
#include "tests/support/error_of.h"

namespace nacre::test {

inline Image constant(int width, int height, Vec3f rgb) {
    Image r(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) r.at(x, y, c) = rgb[c];
    return r;
}

/// Smooth, colourful, within [0.1, 0.9].
inline Image waves(int width, int height) {
    Image r(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                r.at(x, y, c) = 0.5f + 0.4f * std::sin(0.11f * float(x) + 1.3f * float(c)) *
                                           std::cos(0.07f * float(y) - 0.7f * float(c));
    return r;
}

/// Adds Gaussian noise of standard deviation `sigma`, independent in every value.
inline Image with_noise(Image image, double sigma, std::uint64_t seed) {
    Random random(stream_key(seed, 0));
    for (float& v : image.data) {
        const Vec2f u = random.next2();
        v += static_cast<float>(sigma * std::sqrt(-2. * std::log(1. - double(u.x))) *
                                std::cos(6.283185307179586 * double(u.y)));
    }
    return image;
}

}  // namespace nacre::test
