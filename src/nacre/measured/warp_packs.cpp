#include "nacre/measured/warp_packs.h"

#include <bit>

namespace nacre {
namespace {

Pack clamped(Pack x, Pack low, Pack high) { return min(max(x, low), high); }
Pack lerp(Pack a, Pack b, Pack t) { return a + t * (b - a); }
Pack integral(Pack a, Pack b, Pack t) { return t * (a + Pack(0.5f) * t * (b - a)); }

PackInts choose(PackMask m, PackInts yes, PackInts no) { return m.v ? yes : no; }
PackInts whole(int i) { return PackInts{} + i; }
PackInts at_most(PackInts a, int most) { return a < most ? a : whole(most); }

struct Place {
    PackInts patch;
    Pack part;
    /// What is no number stands at 0.
    Place(Pack x, int nodes) {
        const Pack at = select(x > Pack(0.f), min(x, Pack(1.f)), Pack(0.f)) * Pack(nodes - 1);
        patch = at_most(to_ints(at), nodes - 2);
        part = at - to_floats<pack_size>(patch);
    }
};

/// The interval of ascending `nodes` around `x`, by counting those below: there are few.
Place interval(const std::vector<float>& nodes, Pack x) {
    Place p(Pack(0.f), 2);
    if (nodes.size() < 2) return p;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) p.patch -= (x >= Pack(nodes[i])).v;
    const auto [low, high] = gather_pair<pack_size>(nodes.data(), p.patch);
    const Pack t = (x - low) / (high - low);
    p.part = select(t > Pack(0.f), min(t, Pack(1.f)), Pack(0.f));
    return p;
}

/// MarginalWarp::Slices, for each lane another mixture.
template <int N>
struct Slices {
    const float *values, *along, *rows;
    PackInts first[N], first_row[N];
    const Pack* weight;

    Slices(const MarginalWarp& w, const PackMix& mix)
        : values(w.values().data()),
          along(w.along().data()),
          rows(w.rows().data()),
          weight(mix.weight) {
        for (int k = 0; k < N; ++k) {
            first_row[k] = mix.slice[k] * w.height();
            first[k] = first_row[k] * w.width();
        }
    }
    Pack up_to_row(PackInts y) const {
        Pack sum(0.f);
        for (int k = 0; k < N; ++k) sum += weight[k] * gather<pack_size>(rows, first_row[k] + y);
        return sum;
    }
    Pack up_to(PackInts node) const {
        Pack sum(0.f);
        for (int k = 0; k < N; ++k) sum += weight[k] * gather<pack_size>(along, first[k] + node);
        return sum;
    }
    /// Of the nodes at `node` and right of it.
    LanePair<pack_size> value(PackInts node) const {
        LanePair<pack_size> sum{Pack(0.f), Pack(0.f)};
        for (int k = 0; k < N; ++k) {
            const auto v = gather_pair<pack_size>(values, first[k] + node);
            sum.first += weight[k] * v.first;
            sum.second += weight[k] * v.second;
        }
        return sum;
    }
};

/// The last patch that begins at or below `target`, and holds anything.
template <class Cumulative>
PackInts find_patch(int patches, Pack target, Cumulative&& begin) {
    PackInts low{};
    for (unsigned step = std::bit_ceil(unsigned(patches)) / 2; step > 0; step /= 2) {
        const PackInts next = at_most(low + int(step), patches - 1);
        low = choose(begin(next) <= target, next, low);
    }
    for (;;) {
        PackMask empty = begin(low + 1) <= begin(low);
        empty.v &= low > 0;
        if (!bits(empty)) return low;
        low += empty.v;
    }
}

Pack solve(Pack a, Pack b, Pack mass) {
    const Pack zero(0.f), two(2.f);
    const Pack root = fast_sqrt(max(a * a + two * mass * (b - a), zero));
    const Pack t = two * mass / max(a + root, Pack(1e-30f));
    return clamped(t, if_else(a > zero, 0.f, 1e-6f), if_else(b > zero, 1.f, 0.999999f));
}

template <int N>
PackPoint sample_of(const MarginalWarp& warp, Pack u, Pack v, const PackMix& mix) {
    const Slices<N> s(warp, mix);
    const int width = warp.width(), height = warp.height(), last = width - 1;
    const auto row = [&](PackInts y) { return s.up_to_row(y); };
    const PackInts y = find_patch(height - 1, v, row), node = y * width;
    const Pack r0 = s.up_to(node + last), r1 = s.up_to(node + (width + last));
    const Pack ty = solve(r0, r1, v - row(y));
    const auto up_to = [&](PackInts x) {
        return lerp(s.up_to(node + x), s.up_to(node + x + width), ty);
    };
    const Pack target = u * lerp(r0, r1, ty);
    const PackInts x = find_patch(width - 1, target, up_to);
    const auto v0 = s.value(node + x), v1 = s.value(node + x + width);
    const Pack c0 = lerp(v0.first, v1.first, ty), c1 = lerp(v0.second, v1.second, ty);
    const Pack tx = solve(c0, c1, target - up_to(x));
    return {(to_floats<pack_size>(x) + tx) * Pack(1.f / float(last)),
            (to_floats<pack_size>(y) + ty) * Pack(1.f / float(height - 1)),
            lerp(c0, c1, tx) * Pack(float(last) * float(height - 1))};
}

template <int N>
PackPoint invert_of(const MarginalWarp& warp, Pack px, Pack py, const PackMix& mix) {
    const Slices<N> s(warp, mix);
    const int width = warp.width(), height = warp.height(), last = width - 1;
    const Place x(px, width), y(py, height);
    const PackInts row = y.patch * width, node = row + x.patch;
    const auto v0 = s.value(node), v1 = s.value(node + width);
    const Pack c0 = lerp(v0.first, v1.first, y.part), c1 = lerp(v0.second, v1.second, y.part);
    const Pack r0 = s.up_to(row + last), r1 = s.up_to(row + (width + last));
    const Pack along =
        lerp(s.up_to(node), s.up_to(node + width), y.part) + integral(c0, c1, x.part);
    return {min(along / max(lerp(r0, r1, y.part), Pack(1e-30f)), Pack(1.f)),
            min(s.up_to_row(y.patch) + integral(r0, r1, y.part), Pack(1.f)),
            lerp(c0, c1, x.part) * Pack(float(last) * float(height - 1))};
}

template <int N>
Pack density_of(const MarginalWarp& warp, Pack px, Pack py, const PackMix& mix) {
    const Slices<N> s(warp, mix);
    const int width = warp.width(), height = warp.height();
    const Place x(px, width), y(py, height);
    const PackInts node = y.patch * width + x.patch;
    const auto v0 = s.value(node), v1 = s.value(node + width);
    return lerp(lerp(v0.first, v0.second, x.part), lerp(v1.first, v1.second, x.part), y.part) *
           Pack(float(width - 1) * float(height - 1));
}

}  // namespace

PackMix slices_at(const ParameterGrid& grid, Pack slow, Pack fast) {
    const Place f = interval(grid.fast(), fast);
    const int fast_nodes = int(grid.fast().size()), next = fast_nodes > 1;
    PackMix mix;
    mix.slice[0] = f.patch;
    mix.slice[1] = f.patch + next;
    mix.weight[0] = Pack(1.f) - f.part;
    mix.weight[1] = f.part;
    if (grid.slow().size() < 2) return mix;
    const Place s = interval(grid.slow(), slow);
    mix.count = 4;
    for (int k = 0; k < 2; ++k) {
        mix.slice[2 + k] = mix.slice[k] + (s.patch + 1) * fast_nodes;
        mix.slice[k] += s.patch * fast_nodes;
        mix.weight[2 + k] = s.part * mix.weight[k];
        mix.weight[k] *= Pack(1.f) - s.part;
    }
    return mix;
}

Pack eval(const BilinearTable& table, Pack px, Pack py) {
    const Place x(px, table.width()), y(py, table.height());
    const float* values = table.values().data();
    const PackInts node = y.patch * table.width() + x.patch;
    const auto v0 = gather_pair<pack_size>(values, node),
               v1 = gather_pair<pack_size>(values + table.width(), node);
    return lerp(lerp(v0.first, v0.second, x.part), lerp(v1.first, v1.second, x.part), y.part);
}

PackPoint sample(const MarginalWarp& warp, Pack u, Pack v, const PackMix& mix) {
    return mix.count == 2 ? sample_of<2>(warp, u, v, mix) : sample_of<4>(warp, u, v, mix);
}

PackPoint invert(const MarginalWarp& warp, Pack x, Pack y, const PackMix& mix) {
    return mix.count == 2 ? invert_of<2>(warp, x, y, mix) : invert_of<4>(warp, x, y, mix);
}

Pack density(const MarginalWarp& warp, Pack x, Pack y, const PackMix& mix) {
    return mix.count == 2 ? density_of<2>(warp, x, y, mix) : density_of<4>(warp, x, y, mix);
}

}  // namespace nacre
