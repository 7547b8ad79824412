#include "nacre/denoise/regression.h"

#include "nacre/math/lanes_wide.h"

namespace nacre::denoising {
namespace {

/// Calls f(weights, dx, dy), where the weights of a tile's pixel (x, y) are at y * Tile::width + x.
template <class F>
void for_each_offset(const PatchWeights& patches, const PatchWeights::Weights& weights, F&& f) {
    const float* w = weights.data();
    const int r = patches.radius();
    for (int dy = -r; dy <= r; ++dy)
        for (int dx = -r; dx <= r; ++dx, w += Tile::width * Tile::height) f(w, dx, dy);
}

void add(float* to, Wide what) { (Wide::load(to) + what).store(to); }

/// The packs of a tile's pixels that lie in the picture: f(x, y) of the picture, and the place among
/// the tile's weights.
template <class F>
void for_each_pack(const Tile& tile, const Planes& picture, F&& f) {
    for (int y = 0; y < std::min(Tile::height, picture.height() - tile.y); ++y)
        for (int x = 0; x < std::min(Tile::width, picture.width() - tile.x); x += Wide::size)
            f(tile.x + x, tile.y + y, y * Tile::width + x);
}

/// A fit that is off by the root of so many variances where it says something counts half.
constexpr float unlikely = 16.f;

/// Normal equations of a pack of fits with N features.
template <int N>
struct Fit {
    static constexpr int size = N + 1;
    Wide matrix[size * (size + 1) / 2]{};  // lower triangle, row by row
    Wide right[size][3]{};

    void add(Wide w, const Wide (&row)[size], const Wide (&y)[3]) {
        int at = 0;
        for (int i = 0; i < size; ++i) {
            const Wide wi = w * row[i];
            for (int j = 0; j <= i; ++j) matrix[at++] += wi * row[j];
            for (int c = 0; c < 3; ++c) right[i][c] += wi * y[c];
        }
    }
    /// Leaves the solution in `right`: Cholesky's decomposition.
    void solve(Wide ridge) {
        const auto m = [&](int i, int j) -> Wide& { return matrix[i * (i + 1) / 2 + j]; };
        for (int i = 1; i < size; ++i) m(i, i) += ridge * m(0, 0);
        Wide inverse[size];
        for (int i = 0; i < size; ++i) {
            for (int j = 0; j < i; ++j) {
                Wide sum = m(i, j);
                for (int k = 0; k < j; ++k) sum -= m(i, k) * m(j, k);
                m(i, j) = sum * inverse[j];
            }
            Wide sum = m(i, i);
            for (int k = 0; k < i; ++k) sum -= m(i, k) * m(i, k);
            // Rounding may leave a little less than the ridge, or than nothing.
            sum = max(sum, ridge * m(0, 0) * Wide(0.1f) + Wide(1e-20f));
            inverse[i] = Wide(1.f) / sqrt(sum);
        }
        for (int c = 0; c < 3; ++c) {
            for (int i = 0; i < size; ++i) {
                for (int k = 0; k < i; ++k) right[i][c] -= m(i, k) * right[k][c];
                right[i][c] *= inverse[i];
            }
            for (int i = size - 1; i >= 0; --i) {
                for (int k = i + 1; k < size; ++k) right[i][c] -= m(k, i) * right[k][c];
                right[i][c] *= inverse[i];
            }
        }
    }
};

template <int N>
struct FirstOrder {
    const Planes &values, &features;
    const PatchWeights& patches;
    Wide ridge;
    Planes& sums;  // three planes and that of the weights

    void row(int x, int y, int dx, int dy, Wide (&out)[N + 1]) const {
        out[0] = Wide(1.f);
        for (int i = 0; i < N; ++i)
            out[i + 1] =
                Wide::load(features.at(i, x + dx, y + dy)) - Wide::load(features.at(i, x, y));
    }

    void operator()(const Tile& tile) const {
        PatchWeights::Weights weights = patches.room();
        patches.of(tile, weights);
        for_each_pack(tile, values, [&](int x, int y, int place) {
            Fit<N> fit;
            Wide f[N + 1], value[3], own[3];
            for (int c = 0; c < 3; ++c) own[c] = Wide::load(values.at(c, x, y));
            for_each_offset(patches, weights, [&](const float* w, int dx, int dy) {
                row(x, y, dx, dy, f);
                for (int c = 0; c < 3; ++c)
                    value[c] = Wide::load(values.at(c, x + dx, y + dy)) - own[c];
                fit.add(Wide::load(w + place), f, value);
            });
            fit.solve(ridge);
            for_each_offset(patches, weights, [&](const float* w, int dx, int dy) {
                row(x, y, dx, dy, f);
                Wide change[3], off(0.f);
                for (int c = 0; c < 3; ++c) {
                    // Relative to what is there, so that what is even stays so to the last bit.
                    const int qx = x + dx, qy = y + dy;
                    change[c] = own[c] - Wide::load(values.at(c, qx, qy));
                    for (int i = 0; i <= N; ++i) change[c] += fit.right[i][c] * f[i];
                    const Wide guide = Wide::load(patches.guide().at(c, qx, qy)),
                               v = Wide::load(patches.variance().at(c, qx, qy));
                    const Wide d = change[c] + Wide::load(values.at(c, qx, qy)) - guide;
                    off += d * d / (v + Wide(1e-10f) + Wide(1e-6f) * guide * guide);
                }
                off *= Wide(1.f / (3.f * unlikely));
                const Wide weight = Wide::load(w + place) / (Wide(1.f) + off * off);
                for (int c = 0; c < 3; ++c) add(sums.at(c, x + dx, y + dy), weight * change[c]);
                add(sums.at(3, x + dx, y + dy), weight);
            });
        });
    }
};

/// The values with the weighted means of the changes.
Planes changed(const Planes& values, const Planes& sums) {
    const int count = values.count();
    Planes result(sums.width(), sums.height(), count);
    for (int c = 0; c < count; ++c)
        for (int y = 0; y < sums.height(); ++y)
            for (int x = 0; x < sums.width(); ++x)
                *result.at(c, x, y) =
                    *values.at(c, x, y) + *sums.at(c, x, y) / *sums.at(count, x, y);
    result.mirror();
    return result;
}

}  // namespace

Planes weighted_mean(const Planes& values, const PatchWeights& patches) {
    const int n = values.count();
    Planes sums(values.width(), values.height(), n + 1);
    for_each_tile(values.width(), values.height(), [&](const Tile& tile) {
        PatchWeights::Weights weights = patches.room();
        patches.of(tile, weights);
        for_each_pack(tile, values, [&](int x, int y, int place) {
            for_each_offset(patches, weights, [&](const float* at, int dx, int dy) {
                const Wide w = Wide::load(at + place);
                for (int c = 0; c < n; ++c)
                    add(sums.at(c, x, y), w * (Wide::load(values.at(c, x + dx, y + dy)) -
                                               Wide::load(values.at(c, x, y))));
                add(sums.at(n, x, y), w);
            });
        });
    });
    return changed(values, sums);
}

Planes first_order(const Planes& values, const Planes& features, float feature_noise,
                   const PatchWeights& patches) {
    Planes sums(values.width(), values.height(), 4);
    const Wide ridge(feature_noise * feature_noise);
    const auto run = [&]<int N>(std::integral_constant<int, N>) {
        for_each_tile(values.width(), values.height(),
                      FirstOrder<N>{values, features, patches, ridge, sums});
    };
    switch (features.count()) {
        case 0:
            run(std::integral_constant<int, 0>{});
            break;
        case 1:
            run(std::integral_constant<int, 1>{});
            break;
        case 2:
            run(std::integral_constant<int, 2>{});
            break;
        case 3:
            run(std::integral_constant<int, 3>{});
            break;
        case 4:
            run(std::integral_constant<int, 4>{});
            break;
        case 5:
            run(std::integral_constant<int, 5>{});
            break;
        case 6:
            run(std::integral_constant<int, 6>{});
            break;
        case 7:
            run(std::integral_constant<int, 7>{});
            break;
        default:
            run(std::integral_constant<int, 8>{});
            break;
    }
    return changed(values, sums);
}

}  // namespace nacre::denoising
