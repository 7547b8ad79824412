#include "nacre/denoise/patch_weights.h"

#include <tbb/parallel_for.h>

#include "nacre/math/lanes_wide.h"

namespace nacre::denoising {
namespace {

constexpr int padded_width =
                  (Tile::width + 2 * patch_radius + Wide::size - 1) / Wide::size * Wide::size,
              padded_height = Tile::height + 2 * patch_radius;

/// A highlight of one pixel is little among the pixels of a patch.
constexpr float own_weight = 0.1f;

}  // namespace

PatchWeights::PatchWeights(const Planes& guide, const Planes& variance, const Settings& settings)
    : guide_(guide),
      variance_(variance),
      inside_(guide.width(), guide.height(), 1),
      settings_(settings) {
    for (int y = 0; y < guide.height(); ++y) std::fill_n(inside_.at(0, 0, y), guide.width(), 1.f);
}

PatchWeights::Weights PatchWeights::room() const {
    return Weights(std::size_t(side()) * side() * Tile::width * Tile::height);
}

void PatchWeights::of(const Tile& tile, Weights& weights) const {
    std::vector<float> sums(2 * std::size_t(padded_width + Wide::size) * padded_height);
    float* out = weights.data();
    for (int dy = -settings_.radius; dy <= settings_.radius; ++dy)
        for (int dx = -settings_.radius; dx <= settings_.radius; ++dx) {
            offset(tile, dx, dy, sums.data(), out);
            out += Tile::width * Tile::height;
        }
}

void PatchWeights::offset(const Tile& tile, int dx, int dy, float* sums, float* out) const {
    const int f = settings_.patch, columns = Tile::width + 2 * f, rows = Tile::height + 2 * f;
    constexpr int stride = padded_width + Wide::size;
    float* const differences = sums;
    float* const column_sums = sums + std::size_t(stride) * padded_height;
    const Wide k2(settings_.k * settings_.k);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; x += Wide::size) {
            Wide sum(0.f);
            for (int c = 0; c < guide_.count(); ++c) {
                const int px = tile.x + x - f, py = tile.y + y - f;
                const Wide u = Wide::load(guide_.at(c, px, py)),
                           v = Wide::load(variance_.at(c, px, py)),
                           uq = Wide::load(guide_.at(c, px + dx, py + dy)),
                           vq = Wide::load(variance_.at(c, px + dx, py + dy));
                const Wide d = u - uq;
                sum += (d * d - (v + min(v, vq))) / (Wide(1e-10f) + k2 * (v + vq));
            }
            sum.store(differences + y * stride + x);
        }
    const Wide share(1.f / float((2 * f + 1) * (2 * f + 1) * guide_.count()));
    const Wide own_share(own_weight / float(guide_.count()));
    for (int y = 0; y < Tile::height; ++y) {
        for (int x = 0; x < columns; x += Wide::size) {
            Wide sum(0.f);
            for (int i = 0; i <= 2 * f; ++i) sum += Wide::load(differences + (y + i) * stride + x);
            sum.store(column_sums + x);
        }
        for (int x = 0; x < Tile::width; x += Wide::size) {
            Wide sum(0.f);
            for (int i = 0; i <= 2 * f; ++i) sum += Wide::load(column_sums + x + i);
            const Wide own = Wide::load(differences + (y + f) * stride + x + f) * own_share;
            const Wide d2 = max(max(sum * share, own), Wide(0.f));
            const int px = tile.x + x, py = tile.y + y;
            Wide w = exp(-min(d2, Wide(80.f))) * Wide::load(inside_.at(0, px, py)) *
                     Wide::load(inside_.at(0, px + dx, py + dy));
            // What is this unlike only makes the equations ill-conditioned.
            w = select(w > Wide(1e-4f), w, Wide(0.f));
            w.store(out + y * Tile::width + x);
        }
    }
}

void for_each_tile(int width, int height, const std::function<void(const Tile&)>& work) {
    const int columns = (width + Tile::width - 1) / Tile::width,
              rows = (height + Tile::height - 1) / Tile::height;
    // Tiles of every other row and column are apart by more than they reach.
    static_assert(Tile::width >= 2 * window_radius && Tile::height >= 2 * window_radius);
    for (int odd_y = 0; odd_y < 2; ++odd_y)
        for (int odd_x = 0; odd_x < 2; ++odd_x) {
            const int nx = (columns - odd_x + 1) / 2, ny = (rows - odd_y + 1) / 2;
            tbb::parallel_for(0, nx * ny, [&](int i) {
                work({(2 * (i % nx) + odd_x) * Tile::width, (2 * (i / nx) + odd_y) * Tile::height});
            });
        }
}

}  // namespace nacre::denoising
