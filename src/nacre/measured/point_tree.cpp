#include "nacre/measured/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nacre {

/// The best so far, nearest first.
struct PointTree::Search {
    Point p;
    int wanted;
    Near* found;
    int count = 0;
    Point apart{};  ///< along each axis, from p to the part that is looked at

    double farthest = std::numeric_limits<double>::infinity();  ///< beyond this nothing counts

    void offer(double distance, std::uint32_t index) {
        const auto before = [&](const Near& n) {
            return n.distance < distance || (n.distance == distance && n.index < index);
        };
        const bool full = count == wanted;
        if (full && before(found[count - 1])) return;
        int at = full ? count - 1 : count++;
        for (; at > 0 && !before(found[at - 1]); --at) found[at] = found[at - 1];
        found[at] = {distance, index};
        if (count == wanted) farthest = found[count - 1].distance;
    }
};

PointTree::PointTree(std::vector<Point> points) : size_(points.size()) {
    std::vector<std::uint32_t> index(points.size());
    std::iota(index.begin(), index.end(), 0u);
    if (!index.empty()) build(points, index);
}

void PointTree::build(const std::vector<Point>& points, std::span<std::uint32_t> part) {
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    if (part.size() <= bucket) {
        nodes_[node].other = std::uint32_t(leaves_.size());
        Leaf& leaf = leaves_.emplace_back();
        leaf.count = int(part.size());
        for (int i = 0; i < leaf.count; ++i) {
            leaf.index[i] = part[i];
            for (int k = 0; k < 4; ++k) leaf.at[k][i] = points[part[i]][k];
        }
        return;
    }
    Point low = points[part[0]], high = low;
    for (const std::uint32_t i : part)
        for (int k = 0; k < 4; ++k) {
            low[k] = std::min(low[k], points[i][k]);
            high[k] = std::max(high[k], points[i][k]);
        }
    int axis = 0;
    for (int k = 1; k < 4; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    // Whole leaves below the split.
    const std::size_t middle = (part.size() / 2 + bucket - 1) / bucket * bucket;
    std::nth_element(
        part.begin(), part.begin() + std::ptrdiff_t(middle), part.end(),
        [&](std::uint32_t a, std::uint32_t b) {
            return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
        });
    nodes_[node].axis = axis;
    nodes_[node].split = points[part[middle]][axis];
    build(points, part.first(middle));
    nodes_[node].other = std::uint32_t(nodes_.size());
    build(points, part.subspan(middle));
}

/// `within`: the squared distance from p to the part of space that the node holds (S. Arya, D. Mount
/// 1993, Algorithms for Fast Vector Quantization, Data Compression Conference).
void PointTree::search(std::uint32_t at, double within, Search& s) const {
    const Node& node = nodes_[at];
    if (node.axis < 0) {
        const Leaf& leaf = leaves_[node.other];
        double distance[bucket] = {};
        for (int k = 0; k < 4; ++k)
            for (int i = 0; i < bucket; ++i) {
                const double d = s.p[k] - leaf.at[k][i];
                distance[i] += d * d;
            }
        for (int i = 0; i < leaf.count; ++i)
            if (distance[i] <= s.farthest) s.offer(distance[i], leaf.index[i]);
        return;
    }
    const double beyond = s.p[node.axis] - node.split;
    const bool right = beyond >= 0.;
    search(right ? node.other : at + 1, within, s);
    double& apart = s.apart[node.axis];
    const double before = apart, there = within + (beyond * beyond - before * before);
    // Rounding must not hide what is as near.
    if (there * (1. - 1e-12) > s.farthest) return;
    apart = beyond;
    search(right ? at + 1 : node.other, there, s);
    apart = before;
}

int PointTree::nearest(const Point& p, int count, Near* found) const {
    Search s{p, std::min(count, most), found};
    if (size_ > 0 && s.wanted > 0) search(0, 0., s);
    for (int i = 0; i < s.count; ++i) found[i].distance = std::sqrt(found[i].distance);
    return s.count;
}

}  // namespace nacre
