#include "nacre/measured/marginal_warp.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

/// The interval of ascending `nodes` around `x`: its first node and the share of the second.
std::pair<std::uint32_t, float> interval(const std::vector<float>& nodes, float x) {
    if (nodes.size() < 2) return {0, 0.f};
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const std::size_t i = std::size_t(above - nodes.begin()) - 1;
    return {std::uint32_t(i), std::clamp((x - nodes[i]) / (nodes[i + 1] - nodes[i]), 0.f, 1.f)};
}

/// A place on an axis of `nodes` nodes: the patch and the share of its second node.
struct Place {
    int patch;
    float part;
    Place(float x, int nodes) {
        const float at = std::clamp(x, 0.f, 1.f) * float(nodes - 1);
        patch = std::min(int(at), nodes - 2);
        part = at - float(patch);
    }
};

float lerp(float a, float b, float t) { return a + t * (b - a); }

/// The last patch of 0..patches-1 that begins at or below `target`, and holds anything.
template <class Cumulative>
int find_patch(int patches, float target, Cumulative&& begin) {
    int low = 0, high = patches;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (begin(middle) <= target ? low : high) = middle;
    }
    while (low > 0 && begin(low + 1) <= begin(low)) --low;
    return low;
}

/// t in [0, 1] with integral `mass` of the density a + (b - a) t up to it. This form of the root of
/// the square equation keeps its digits where a and b are nearly equal.
float solve(float a, float b, float mass) {
    const float root = std::sqrt(std::max(a * a + 2.f * mass * (b - a), 0.f));
    const float t = 2.f * mass / std::max(a + root, 1e-30f);
    return std::clamp(t, 0.f, 1.f);
}
float integral(float a, float b, float t) { return t * (a + 0.5f * t * (b - a)); }

}  // namespace

ParameterGrid::ParameterGrid(std::vector<float> slow, std::vector<float> fast)
    : slow_(std::move(slow)), fast_(std::move(fast)) {}

SliceMix ParameterGrid::at(float slow, float fast) const {
    const auto [s, ts] = interval(slow_, slow);
    const auto [f, tf] = interval(fast_, fast);
    const auto n = std::uint32_t(fast_.size());
    SliceMix mix;
    mix.count = 0;
    for (std::uint32_t i = 0; i < 2; ++i)
        for (std::uint32_t j = 0; j < 2; ++j) {
            const float weight = (i ? ts : 1.f - ts) * (j ? tf : 1.f - tf);
            if (weight <= 0.f) continue;
            mix.slice[mix.count] = (s + i) * n + f + j;
            mix.weight[mix.count++] = weight;
        }
    return mix;
}

BilinearTable::BilinearTable(int width, int height, std::vector<float> values)
    : width_(width), height_(height), values_(std::move(values)) {}

float BilinearTable::eval(float x, float y, const SliceMix& mix) const {
    const Place px(x, width_), py(y, height_);
    const std::size_t at = std::size_t(py.patch) * width_ + px.patch;
    float sum = 0.f;
    for (int k = 0; k < mix.count; ++k) {
        const float* v = values_.data() + std::size_t(mix.slice[k]) * width_ * height_ + at;
        sum += mix.weight[k] *
               lerp(lerp(v[0], v[1], px.part), lerp(v[width_], v[width_ + 1], px.part), py.part);
    }
    return sum;
}

MarginalWarp::MarginalWarp(int width, int height, std::vector<float> values)
    : width_(width),
      height_(height),
      values_(std::move(values)),
      along_(values_.size()),
      rows_(values_.size() / width) {
    const std::size_t slice_size = std::size_t(width) * height;
    for (std::size_t first = 0; first < values_.size(); first += slice_size) {
        float* v = values_.data() + first;
        const auto row_sum = [&](int y) {
            double sum = 0.;
            for (int x = 0; x + 1 < width; ++x)
                sum += 0.5 * (double(v[y * width + x]) + v[y * width + x + 1]);
            return sum;
        };
        double total = 0.;
        for (int y = 0; y + 1 < height; ++y) total += 0.5 * (row_sum(y) + row_sum(y + 1));
        if (!(total > 0.)) {
            std::fill(v, v + slice_size, 1.f);
            total = double(width - 1) * (height - 1);
        }
        for (std::size_t i = 0; i < slice_size; ++i) v[i] = float(v[i] / total);
        double rows = 0., before = 0.;
        for (int y = 0; y < height; ++y) {
            double sum = 0.;
            for (int x = 0; x < width; ++x) {
                if (x > 0) sum += 0.5 * (double(v[y * width + x - 1]) + v[y * width + x]);
                along_[first + std::size_t(y) * width + x] = float(sum);
            }
            if (y > 0) rows += 0.5 * (before + sum);
            rows_[first / width + y] = float(rows);
            before = sum;
        }
    }
}

float MarginalWarp::mixed(const std::vector<float>& table, std::size_t stride, std::size_t at,
                          const SliceMix& mix) const {
    float sum = 0.f;
    for (int k = 0; k < mix.count; ++k) sum += mix.weight[k] * table[mix.slice[k] * stride + at];
    return sum;
}

MarginalWarp::Point MarginalWarp::sample(float u, float v, const SliceMix& mix) const {
    const std::size_t slice = std::size_t(width_) * height_, w = std::size_t(width_);
    const auto up_to_row = [&](int y) { return mixed(rows_, height_, y, mix); };
    const auto along = [&](std::size_t y, int x) { return mixed(along_, slice, y * w + x, mix); };
    const auto value = [&](std::size_t y, int x) { return mixed(values_, slice, y * w + x, mix); };

    const int y = find_patch(height_ - 1, v, up_to_row);
    const float r0 = along(y, width_ - 1), r1 = along(y + 1, width_ - 1);
    const float ty = solve(r0, r1, v - up_to_row(y));

    const auto up_to_column = [&](int x) { return lerp(along(y, x), along(y + 1, x), ty); };
    const float target = u * lerp(r0, r1, ty);
    const int x = find_patch(width_ - 1, target, up_to_column);
    const float c0 = lerp(value(y, x), value(y + 1, x), ty);
    const float c1 = lerp(value(y, x + 1), value(y + 1, x + 1), ty);
    const float tx = solve(c0, c1, target - up_to_column(x));

    return {(float(x) + tx) / float(width_ - 1), (float(y) + ty) / float(height_ - 1),
            lerp(c0, c1, tx) * float(width_ - 1) * float(height_ - 1)};
}

MarginalWarp::Point MarginalWarp::invert(float px, float py, const SliceMix& mix) const {
    const Place ix(px, width_), iy(py, height_);
    const std::size_t slice = std::size_t(width_) * height_;
    const std::size_t row = std::size_t(iy.patch) * width_, at = row + ix.patch;
    // Everything of the two rows in one pass over the slices.
    float v00 = 0, v10 = 0, v01 = 0, v11 = 0, a0 = 0, a1 = 0, r0 = 0, r1 = 0, below = 0;
    for (int k = 0; k < mix.count; ++k) {
        const float weight = mix.weight[k];
        const float* v = values_.data() + mix.slice[k] * slice + at;
        const float* a = along_.data() + mix.slice[k] * slice;
        v00 += weight * v[0];
        v10 += weight * v[1];
        v01 += weight * v[width_];
        v11 += weight * v[width_ + 1];
        a0 += weight * a[at];
        a1 += weight * a[at + width_];
        r0 += weight * a[row + width_ - 1];
        r1 += weight * a[row + 2 * width_ - 1];
        below += weight * rows_[mix.slice[k] * std::size_t(height_) + iy.patch];
    }
    const float c0 = lerp(v00, v01, iy.part), c1 = lerp(v10, v11, iy.part);
    const float whole = lerp(r0, r1, iy.part);
    const float up_to = lerp(a0, a1, iy.part) + integral(c0, c1, ix.part);
    return {std::min(up_to / std::max(whole, 1e-30f), 1.f),
            std::min(below + integral(r0, r1, iy.part), 1.f),
            lerp(c0, c1, ix.part) * float(width_ - 1) * float(height_ - 1)};
}

float MarginalWarp::density(float px, float py, const SliceMix& mix) const {
    const Place ix(px, width_), iy(py, height_);
    const std::size_t slice = std::size_t(width_) * height_,
                      at = std::size_t(iy.patch) * width_ + ix.patch;
    float sum = 0.f;
    for (int k = 0; k < mix.count; ++k) {
        const float* v = values_.data() + mix.slice[k] * slice + at;
        sum += mix.weight[k] *
               lerp(lerp(v[0], v[1], ix.part), lerp(v[width_], v[width_ + 1], ix.part), iy.part);
    }
    return sum * float(width_ - 1) * float(height_ - 1);
}

}  // namespace nacre
