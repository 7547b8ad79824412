#include "nacre/measured/marginal_warp.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre {
namespace {

/// The interval of ascending `nodes` around `x`: its first node and the share of the second. What is
/// no number has a share of 0.
std::pair<std::uint32_t, float> interval(const std::vector<float>& nodes, float x) {
    if (nodes.size() < 2) return {0, 0.f};
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const std::size_t i = std::size_t(above - nodes.begin()) - 1;
    const float t = (x - nodes[i]) / (nodes[i + 1] - nodes[i]);
    return {std::uint32_t(i), t > 0.f ? std::min(t, 1.f) : 0.f};
}

/// A place on an axis of `nodes` nodes: the patch and the share of its second node.
struct Place {
    int patch;
    float part;
    /// What is no number stands at 0.
    Place(float x, int nodes) {
        const float at = (x > 0.f ? std::min(x, 1.f) : 0.f) * float(nodes - 1);
        patch = std::min(int(at), nodes - 2);
        part = at - float(patch);
    }
};

float lerp(float a, float b, float t) { return a + t * (b - a); }

/// The last patch of 0..patches-1 that begins at or below `target`, and holds anything.
template <class Cumulative>
int find_patch(int patches, float target, Cumulative&& begin) {
    int low = 0;
    for (unsigned step = std::bit_ceil(unsigned(patches)) / 2; step > 0; step /= 2) {
        const int next = std::min(low + int(step), patches - 1);
        low = begin(next) <= target ? next : low;
    }
    while (low > 0 && begin(low + 1) <= begin(low)) --low;
    return low;
}

/// t in [0, 1] with integral `mass` of the density a + (b - a) t up to it. This form of the root of
/// the square equation keeps its digits where a and b are nearly equal.
float solve(float a, float b, float mass) {
    const float root = std::sqrt(std::max(a * a + 2.f * mass * (b - a), 0.f));
    const float t = 2.f * mass / std::max(a + root, 1e-30f);
    // Off the ends where the density is 0: nobody can divide by it.
    return std::clamp(t, a > 0.f ? 0.f : 1e-6f, b > 0.f ? 1.f : 0.999999f);
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

/// The tables of up to N slices as one: mixtures of their entries. Weights beyond those of `mix` are
/// 0, so that loops have a fixed length.
template <int N>
struct MarginalWarp::Slices {
    const float *values[N], *along[N], *rows[N];
    float weight[N];
    int width;

    Slices(const MarginalWarp& w, const SliceMix& mix) : width(w.width_) {
        const std::size_t size = std::size_t(w.width_) * w.height_;
        for (int k = 0; k < N; ++k) {
            values[k] = w.values_.data() + mix.slice[k] * size;
            along[k] = w.along_.data() + mix.slice[k] * size;
            rows[k] = w.rows_.data() + std::size_t(mix.slice[k]) * w.height_;
            weight[k] = mix.weight[k];
        }
    }
    float mixed(const float* const (&table)[N], int at) const {
        float sum = 0.f;
        for (int k = 0; k < N; ++k) sum += weight[k] * table[k][at];
        return sum;
    }
    float up_to_row(int y) const { return mixed(rows, y); }
    float up_to(int y, int x) const { return mixed(along, y * width + x); }
    float value(int y, int x) const { return mixed(values, y * width + x); }
};

template <int N>
MarginalWarp::Point MarginalWarp::sample_of(float u, float v, const SliceMix& mix) const {
    const Slices<N> s(*this, mix);
    const int y = find_patch(height_ - 1, v, [&](int i) { return s.up_to_row(i); });
    const float r0 = s.up_to(y, width_ - 1), r1 = s.up_to(y + 1, width_ - 1);
    const float ty = solve(r0, r1, v - s.up_to_row(y));

    const auto up_to_column = [&](int x) { return lerp(s.up_to(y, x), s.up_to(y + 1, x), ty); };
    const float target = u * lerp(r0, r1, ty);
    const int x = find_patch(width_ - 1, target, up_to_column);
    const float c0 = lerp(s.value(y, x), s.value(y + 1, x), ty);
    const float c1 = lerp(s.value(y, x + 1), s.value(y + 1, x + 1), ty);
    const float tx = solve(c0, c1, target - up_to_column(x));
    return {(float(x) + tx) / float(width_ - 1), (float(y) + ty) / float(height_ - 1),
            lerp(c0, c1, tx) * float(width_ - 1) * float(height_ - 1)};
}

template <int N>
MarginalWarp::Point MarginalWarp::invert_of(float px, float py, const SliceMix& mix) const {
    const Slices<N> s(*this, mix);
    const Place ix(px, width_), iy(py, height_);
    const int x = ix.patch, y = iy.patch;
    const float c0 = lerp(s.value(y, x), s.value(y + 1, x), iy.part);
    const float c1 = lerp(s.value(y, x + 1), s.value(y + 1, x + 1), iy.part);
    const float r0 = s.up_to(y, width_ - 1), r1 = s.up_to(y + 1, width_ - 1);
    const float along = lerp(s.up_to(y, x), s.up_to(y + 1, x), iy.part) + integral(c0, c1, ix.part);
    return {std::min(along / std::max(lerp(r0, r1, iy.part), 1e-30f), 1.f),
            std::min(s.up_to_row(y) + integral(r0, r1, iy.part), 1.f),
            lerp(c0, c1, ix.part) * float(width_ - 1) * float(height_ - 1)};
}

MarginalWarp::Point MarginalWarp::sample(float u, float v, const SliceMix& mix) const {
    return mix.count == 1   ? sample_of<1>(u, v, mix)
           : mix.count == 2 ? sample_of<2>(u, v, mix)
                            : sample_of<4>(u, v, mix);
}

MarginalWarp::Point MarginalWarp::invert(float x, float y, const SliceMix& mix) const {
    return mix.count == 1   ? invert_of<1>(x, y, mix)
           : mix.count == 2 ? invert_of<2>(x, y, mix)
                            : invert_of<4>(x, y, mix);
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
