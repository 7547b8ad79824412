#pragma once
// How alike two pixels of a noisy picture are: the weights of NL-means with variances.
//
//   F. Rousselle, C. Knaus, M. Zwicker 2012, Adaptive Rendering with Non-Local Means Filtering,
//   ACM TOG 31(6).
#include <functional>

#include "nacre/denoise/planes.h"

namespace nacre::denoising {

/// A part of the picture that one thread filters at a time.
struct Tile {
    static constexpr int width = 32, height = 2 * window_radius;
    int x, y;
};

/// Weights of the pixels q = p + (dx, dy), |dx|, |dy| <= radius, for the pixels p of a tile:
///
///   exp(-max(0, d2)),  d2 = mean over the patch and the planes of
///       ((u_p - u_q)^2 - (v_p + min(v_p, v_q))) / (1e-10 + k^2 (v_p + v_q))
///
/// where u is the guide and v its variance; d2 is at least a tenth of what the two pixels alone
/// give. 0 beyond the picture's edge.
class PatchWeights {
  public:
    struct Settings {
        int radius = window_radius;
        int patch = patch_radius;
        float k = 1.f;
    };
    PatchWeights(const Planes& guide, const Planes& variance, const Settings& settings);

    /// Has room for one tile's weights: [dy][dx][y][x].
    using Weights = std::vector<float>;
    Weights room() const;
    void of(const Tile& tile, Weights& weights) const;
    int radius() const { return settings_.radius; }
    const Planes& guide() const { return guide_; }
    const Planes& variance() const { return variance_; }
    int side() const { return 2 * settings_.radius + 1; }

  private:
    void offset(const Tile& tile, int dx, int dy, float* sums, float* out) const;

    const Planes &guide_, &variance_;
    Planes inside_;  // 1 within the picture, 0 beyond
    Settings settings_;
};

/// Calls `work` for all tiles of a picture, in parallel but so that two tiles that are worked on at
/// a time have no pixel within reach of both. Whoever adds to pixels around a tile adds in the same
/// order for any number of threads.
void for_each_tile(int width, int height, const std::function<void(const Tile&)>& work);

}  // namespace nacre::denoising
