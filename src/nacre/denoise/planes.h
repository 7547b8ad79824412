#pragma once
// Pictures as filters work on them: a plane a channel, with a border that mirrors the picture.
#include <algorithm>
#include <cstddef>
#include <vector>

namespace nacre::denoising {

/// Reach of the filters: nothing beyond is looked at.
inline constexpr int window_radius = 9, patch_radius = 3;

class Planes {
  public:
    /// As wide as windows and patches reach; packs may be loaded at any pixel of the picture.
    static constexpr int border = window_radius + patch_radius, slack = 64;

    Planes() = default;
    Planes(int width, int height, int count)
        : width_(width),
          height_(height),
          count_(count),
          stride_((width + 2 * border + slack + 15) / 16 * 16),
          rows_(height + 2 * border + slack),
          data_(std::size_t(stride_) * rows_ * count) {}

    int width() const { return width_; }
    int height() const { return height_; }
    int count() const { return count_; }
    std::ptrdiff_t stride() const { return stride_; }
    float* at(int plane, int x, int y) {
        return &data_[(std::size_t(plane) * rows_ + std::size_t(y + border)) * stride_ + x +
                      border];
    }
    const float* at(int plane, int x, int y) const {
        return const_cast<Planes*>(this)->at(plane, x, y);
    }

    /// Fills the border from the picture.
    void mirror() {
        const auto inside = [](int i, int n) {
            const int period = 2 * n;
            i = (i % period + period) % period;
            return i < n ? i : period - 1 - i;
        };
        for (int c = 0; c < count_; ++c)
            for (int y = -border; y < height_ + border; ++y) {
                const float* from = at(c, 0, inside(y, height_));
                float* to = at(c, 0, y);
                if (to != from) std::copy_n(from, width_, to);
                for (int x = 1; x <= border; ++x) to[-x] = from[inside(-x, width_)];
                for (int x = 0; x < border; ++x) to[width_ + x] = from[inside(width_ + x, width_)];
            }
    }

  private:
    int width_ = 0, height_ = 0, count_ = 0, stride_ = 0, rows_ = 0;
    std::vector<float> data_;
};

}  // namespace nacre::denoising
