// Which of many boxes hold a point: the same as by looking at all.
#include "nacre/geometry/box_tree.h"

#include <gtest/gtest.h>

#include "nacre/math/random.h"

namespace nacre {
namespace {

TEST(BoxTree, FindsWhatLookingAtAllFinds) {
    Random random(4);
    const auto place = [&] { return Point3f{random.next(), random.next(), random.next()}; };
    std::vector<Box3f> boxes(3000);
    for (Box3f& box : boxes) {
        box.extend(place());
        // Small ones, long ones and a few that hold nearly everything.
        const float size = random.next() < 0.1f ? 1.f : 0.1f;
        box.extend(box.lower + (place() - Point3f{0.5f, 0.5f, 0.5f}) * size);
    }
    const BoxTree tree(boxes);
    EXPECT_EQ(tree.size(), boxes.size());
    std::vector<std::uint32_t> found;
    std::size_t sum = 0;
    for (int i = 0; i < 2000; ++i) {
        const Point3f p = place();
        std::vector<std::uint32_t> all;
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            const Box3f& b = boxes[k];
            if (p.x >= b.lower.x && p.x <= b.upper.x && p.y >= b.lower.y && p.y <= b.upper.y &&
                p.z >= b.lower.z && p.z <= b.upper.z)
                all.push_back(k);
        }
        tree.holding(p, found);
        ASSERT_EQ(found, all) << i;
        sum += all.size();
    }
    EXPECT_GT(sum, 2000u);
}

TEST(BoxTree, EmptyOnesHoldNothing) {
    std::vector<std::uint32_t> found{1, 2};
    BoxTree().holding({}, found);
    EXPECT_TRUE(found.empty());
    EXPECT_TRUE(BoxTree(std::vector<Box3f>{}).empty());
}

}  // namespace
}  // namespace nacre
