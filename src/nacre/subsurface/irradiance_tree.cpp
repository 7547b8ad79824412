#include "nacre/subsurface/irradiance_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <numeric>

#include "nacre/math/lanes_wide.h"

namespace nacre {

namespace {

constexpr int lanes = Wide::size;
// Levels of a tree of 2^32 points over 8 lanes, and the siblings that wait at each.
constexpr int stack_size = 11 * lanes;
constexpr std::uint32_t all_lanes = (1u << lanes) - 1u;
// A distance that every point is beyond: points of leaves are always taken.
constexpr float always = -1.f;

// exp(-x) for x >= 0, to 5e-5, 0 beyond 87: 2^i 2^f with Taylor's polynomial for |f| <= 1/2. The
// sum over groups is off by far more.
Wide fast_exp_minus(Wide x) {
    const Wide y = max(x * Wide(-std::numbers::log2e_v<float>), Wide(-126.f));
    constexpr float magic = 0x1.8p23f;  // rounds to whole numbers, which end up in the lowest bits
    const Wide rounded = y + Wide(magic), f = y - (rounded - Wide(magic));
    Wide p(0.009618129f);
    for (const float c : {0.05550411f, 0.24022651f, 0.69314718f, 1.f}) p = p * f + Wide(c);
    using Int = Mask<float, lanes>::Native;
    const Int exponent = std::bit_cast<Int>(rounded.v) << 23;
    return Wide::from(std::bit_cast<Wide::Native>(std::bit_cast<Int>(p.v) + exponent));
}

}  // namespace

struct IrradianceTree::Builder {
    IrradianceTree& tree;
    std::span<const Point3f> points;
    std::span<const float> area, power;
    float epsilon;
    std::vector<std::uint32_t> order;

    struct Group {
        Vec3d centre, by_area;  // sums, weighted by power and by area
        double weight = 0., area = 0.;
        std::array<double, max_bands> power{};
        Vec3d lower{1e30, 1e30, 1e30}, upper{-1e30, -1e30, -1e30};
    };

    // Makes the node over order[begin, end) and its descendants; returns its number.
    std::int32_t node(std::size_t begin, std::size_t end, Group& sum) {
        const std::int32_t n = static_cast<std::int32_t>(tree.child_.size() / lanes);
        tree.child_.resize(tree.child_.size() + lanes, -1);
        tree.data_.resize(tree.data_.size() + tree.stride_, 0.f);
        // Children hold a full power of the number of lanes, so that only the first node of each
        // level has room to spare.
        std::size_t capacity = 1;
        while (capacity * lanes < end - begin) capacity *= lanes;
        split(begin, end, capacity);
        int lane = 0;
        for (std::size_t from = begin; from < end; from += capacity, ++lane) {
            Group group;
            std::int32_t child = -1;
            if (capacity == 1)
                group = point(order[from]);
            else
                child = node(from, std::min(from + capacity, end), group);
            store(n, lane, group, child);
            add(sum, group);
        }
        for (; lane < lanes; ++lane) data(n)[3 * lanes + lane] = always;
        return n;
    }

    float* data(std::int32_t n) { return tree.data_.data() + n * tree.stride_; }

    // Orders [begin, end) into pieces of `capacity` that are compact in space.
    void split(std::size_t begin, std::size_t end, std::size_t capacity) {
        const std::size_t pieces = (end - begin + capacity - 1) / capacity;
        if (pieces < 2) return;
        Point3f lower = points[order[begin]], upper = lower;
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                lower[k] = std::min(lower[k], points[order[i]][k]);
                upper[k] = std::max(upper[k], points[order[i]][k]);
            }
        const Vec3f size = upper - lower;
        const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0
                                 : size.y >= size.z                   ? 1
                                                                      : 2;
        const std::size_t middle = begin + pieces / 2 * capacity;
        std::nth_element(
            order.begin() + std::ptrdiff_t(begin), order.begin() + std::ptrdiff_t(middle),
            order.begin() + std::ptrdiff_t(end),
            [&](std::uint32_t a, std::uint32_t b) { return points[a][axis] < points[b][axis]; });
        split(begin, middle, capacity);
        split(middle, end, capacity);
    }

    Group point(std::uint32_t i) const {
        Group g;
        const Vec3d p(points[i]);
        g.lower = g.upper = p;
        g.area = area[i];
        for (int b = 0; b < tree.bands_; ++b) {
            g.power[b] = power[i * std::size_t(tree.bands_) + b];
            g.weight += g.power[b];
        }
        g.centre = p * g.weight;
        g.by_area = p * g.area;
        return g;
    }

    void add(Group& sum, const Group& g) const {
        sum.centre += g.centre;
        sum.by_area += g.by_area;
        sum.weight += g.weight;
        sum.area += g.area;
        for (int b = 0; b < tree.bands_; ++b) sum.power[b] += g.power[b];
        for (std::size_t k = 0; k < 3; ++k) {
            sum.lower[k] = std::min(sum.lower[k], g.lower[k]);
            sum.upper[k] = std::max(sum.upper[k], g.upper[k]);
        }
    }

    void store(std::int32_t n, int lane, const Group& g, std::int32_t child) {
        // Where no power enters, the centre of the area will do; where there is no area either, as
        // of points that coincide with others, that of the box.
        const Vec3d centre = g.weight > 0. ? g.centre / g.weight
                             : g.area > 0. ? g.by_area / g.area
                                           : (g.lower + g.upper) * 0.5;
        float* d = data(n);
        for (std::size_t k = 0; k < 3; ++k) d[k * lanes + lane] = float(centre[k]);
        float accept = always;
        if (child >= 0) {
            // Outside of the group: beyond the farthest corner of its box.
            double reach2 = 0.;
            for (std::size_t k = 0; k < 3; ++k) {
                const double reach = std::max(centre[k] - g.lower[k], g.upper[k] - centre[k]);
                reach2 += reach * reach;
            }
            accept = epsilon > 0.f ? float(std::max(g.area / epsilon, reach2))
                                   : std::numeric_limits<float>::infinity();
        }
        d[3 * lanes + lane] = accept;
        for (int b = 0; b < tree.bands_; ++b) d[(4 + b) * lanes + lane] = float(g.power[b]);
        tree.child_[std::size_t(n) * lanes + lane] = child;
    }
};

IrradianceTree::IrradianceTree(std::span<const Point3f> points, std::span<const float> area,
                               std::span<const float> power, int bands, float epsilon)
    : bands_(bands), stride_(std::size_t(4 + bands) * lanes) {
    if (points.empty()) return;
    Builder builder{*this, points, area, power, epsilon, std::vector<std::uint32_t>(points.size())};
    std::iota(builder.order.begin(), builder.order.end(), 0u);
    Builder::Group all;
    builder.node(0, points.size(), all);
}

void IrradianceTree::gather(const Point3f& at, std::span<const DipoleKernel> kernels,
                            float* exitance) const {
    std::fill_n(exitance, bands_, 0.f);
    if (child_.empty()) return;
    Wide sums[max_bands];
    std::int32_t stack[stack_size];
    int depth = 0;
    stack[depth++] = 0;
    const Wide x(at.x), y(at.y), z(at.z);
    while (depth > 0) {
        const std::int32_t n = stack[--depth];
        const float* d = data_.data() + n * stride_;
        const Wide dx = Wide::load(d) - x, dy = Wide::load(d + lanes) - y,
                   dz = Wide::load(d + 2 * lanes) - z;
        const Wide r2 = dx * dx + dy * dy + dz * dz;
        const Wide accepted = Wide::load(d + 3 * lanes);
        const auto taken = r2 > accepted;
        // Unused lanes count as taken: their power is 0.
        const std::uint32_t far = greater_bits(r2, accepted);
        const std::int32_t* child = child_.data() + std::size_t(n) * lanes;
        for (std::uint32_t near = ~far & all_lanes; near; near &= near - 1)
            stack[depth++] = child[std::countr_zero(near)];
        if (far == 0) continue;
        for (int b = 0; b < bands_; ++b) {
            const DipoleKernel& k = kernels[std::size_t(b)];
            const auto source = [&](const DipoleKernel::Source& s) {
                const Wide d2 = r2 + Wide(s.z2);
                const Wide inverse = fast_rsqrt(d2);
                const Wide t = Wide(k.sigma_tr) * d2 * inverse;
                return fast_exp_minus(t) * inverse *
                       (Wide(s.p) + Wide(s.q) * (Wide(1.f) + t) * inverse * inverse);
            };
            const Wide power = select(taken, Wide::load(d + (4 + b) * lanes), Wide(0.f));
            sums[b] += power * (source(k.real) + source(k.image));
        }
    }
    for (int b = 0; b < bands_; ++b) exitance[b] = sum(sums[b]);
}

}  // namespace nacre
