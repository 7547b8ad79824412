#include "nacre/measured/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/random.h"

namespace nacre {
namespace {

using TreePoint = PointTree::Point;

/// Coordinates in steps of `grain`, so that many distances are equal; 0: any.
std::vector<TreePoint> tree_points(int count, int dimensions, float grain, Random& random) {
    std::vector<TreePoint> all(std::size_t(count), TreePoint{});
    for (TreePoint& p : all)
        for (int k = 0; k < dimensions; ++k) {
            const float x = random.next();
            p[k] = grain > 0.f ? grain * std::floor(x / grain) : x;
        }
    return all;
}

}  // namespace

TEST(PointTree, FindsWhatLookingAtAllFinds) {
    Random random(stream_key(9, 9));
    for (const float grain : {0.f, 0.125f})
        for (const int dimensions : {1, 3, 4})
            for (const int count : {0, 1, 7, 8, 9, 17, 500}) {
                const auto points = tree_points(count, dimensions, grain, random);
                const PointTree tree(points);
                EXPECT_EQ(tree.size(), points.size());
                for (const TreePoint& p : tree_points(40, dimensions, grain, random)) {
                    std::vector<std::pair<double, std::uint32_t>> all;
                    for (std::size_t i = 0; i < points.size(); ++i) {
                        double sum = 0.;
                        for (int k = 0; k < 4; ++k)
                            sum += (p[k] - points[i][k]) * (p[k] - points[i][k]);
                        all.emplace_back(std::sqrt(sum), std::uint32_t(i));
                    }
                    std::sort(all.begin(), all.end());
                    for (const int wanted : {1, 9, PointTree::most}) {
                        PointTree::Near found[PointTree::most];
                        const int n = tree.nearest(p, wanted, found);
                        ASSERT_EQ(n, std::min(wanted, count));
                        for (int i = 0; i < n; ++i) {
                            EXPECT_NEAR(found[i].distance, all[i].first, 1e-15);
                            // Of equal distances the lower position; rounding tells others apart.
                            if (grain > 0.f) {
                                EXPECT_EQ(found[i].index, all[i].second);
                            }
                        }
                    }
                }
            }
}

}  // namespace nacre
