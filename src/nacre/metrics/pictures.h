#pragma once
// What every comparison of two pictures needs: which pixels count, and that the pictures fit.
#include <cstdint>
#include <functional>
#include <vector>

#include "nacre/image/image.h"

namespace nacre {

/// The pixels that count.
class PixelMask {
  public:
    /// All pixels of pictures of any size.
    PixelMask() = default;
    /// Pixels whose green, or grey, is above 0.5.
    explicit PixelMask(const Image& image);
    /// Pixels for which `counts(x, y)` is true.
    PixelMask(int width, int height, const std::function<bool(int x, int y)>& counts);

    bool operator()(int x, int y) const {
        return counts_.empty() || counts_[std::size_t(y) * width_ + x];
    }
    /// Number of pixels that count in a picture of that size. Throws InputError if the mask has
    /// another size or leaves no pixel.
    std::size_t count(int width, int height) const;

  private:
    int width_ = 0, height_ = 0;
    std::vector<std::uint8_t> counts_;
};

/// Throws InputError if `image` and the reference differ in size; `what` names the image.
void check_same_size(const char* what, const Image& image, const Image& reference);

/// Throws InputError at the first value of `image` that counts and is not finite; `remedy` ends the
/// message.
void check_finite(const char* what, const Image& image, const PixelMask& mask,
                  const char* remedy = "mend it or mask it out");

}  // namespace nacre
