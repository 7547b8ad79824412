#include "nacre/measured/point_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre {

/// The best so far, nearest first.
struct PointTree::Search {
    Point p;
    int wanted;
    Near* found;
    int count = 0;

    bool full() const { return count == wanted; }
    void offer(double distance, std::uint32_t index) {
        const auto before = [&](const Near& n) {
            return n.distance < distance || (n.distance == distance && n.index < index);
        };
        if (full() && before(found[count - 1])) return;
        int at = full() ? count - 1 : count++;
        for (; at > 0 && !before(found[at - 1]); --at) found[at] = found[at - 1];
        found[at] = {distance, index};
    }
};

PointTree::PointTree(std::vector<Point> points)
    : points_(std::move(points)), index_(points_.size()), axis_(points_.size()) {
    std::iota(index_.begin(), index_.end(), 0u);
    build(0, points_.size());
    std::vector<Point> sorted(points_.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = points_[index_[i]];
    points_ = std::move(sorted);
}

void PointTree::build(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return;
    Point low = points_[index_[begin]], high = low;
    for (std::size_t i = begin; i < end; ++i)
        for (int k = 0; k < 4; ++k) {
            low[k] = std::min(low[k], points_[index_[i]][k]);
            high[k] = std::max(high[k], points_[index_[i]][k]);
        }
    int axis = 0;
    for (int k = 1; k < 4; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = (begin + end) / 2;
    const auto first = index_.begin();
    std::nth_element(first + std::ptrdiff_t(begin), first + std::ptrdiff_t(middle),
                     first + std::ptrdiff_t(end), [&](std::uint32_t a, std::uint32_t b) {
                         return points_[a][axis] != points_[b][axis]
                                    ? points_[a][axis] < points_[b][axis]
                                    : a < b;
                     });
    axis_[middle] = std::uint8_t(axis);
    build(begin, middle);
    build(middle + 1, end);
}

void PointTree::search(std::size_t begin, std::size_t end, Search& s) const {
    if (begin >= end) return;
    const std::size_t middle = (begin + end) / 2;
    const Point& q = points_[middle];
    double distance = 0.;
    for (int k = 0; k < 4; ++k) distance += (s.p[k] - q[k]) * (s.p[k] - q[k]);
    s.offer(distance, index_[middle]);
    if (end - begin == 1) return;
    const double beyond = s.p[axis_[middle]] - q[axis_[middle]];
    const bool right = beyond >= 0.;
    right ? search(middle + 1, end, s) : search(begin, middle, s);
    if (!s.full() || beyond * beyond <= s.found[s.count - 1].distance)
        right ? search(begin, middle, s) : search(middle + 1, end, s);
}

int PointTree::nearest(const Point& p, int count, Near* found) const {
    Search s{p, std::min(count, most), found};
    search(0, points_.size(), s);
    for (int i = 0; i < s.count; ++i) found[i].distance = std::sqrt(found[i].distance);
    return s.count;
}

}  // namespace nacre
