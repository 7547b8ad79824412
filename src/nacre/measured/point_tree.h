#pragma once
// The points nearest to another one, of up to four coordinates.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nacre {

/// A balanced k-d tree (J. L. Bentley 1975, Multidimensional Binary Search Trees Used for
/// Associative Searching, Communications of the ACM 18(9)) with up to eight points a leaf, whose
/// distances are taken together.
class PointTree {
  public:
    using Point = std::array<double, 4>;
    struct Near {
        double distance;  ///< squared while searching, then itself
        std::uint32_t index;
    };
    static constexpr int most = 16;

    PointTree() = default;
    explicit PointTree(std::vector<Point> points);
    std::size_t size() const { return size_; }

    /// The `count` (at most `most`) nearest to `p`, nearest first, by their positions in what was
    /// given; how many there are. Equal distances: the lower position first.
    int nearest(const Point& p, int count, Near* found) const;

  private:
    static constexpr int bucket = 8;
    /// Inner nodes have what lies below the split next to them; leaves have none.
    struct Node {
        double split = 0.;
        std::int32_t axis = -1;   ///< -1: a leaf
        std::uint32_t other = 0;  ///< the node beyond the split; of a leaf, which one it is
    };
    struct Leaf {
        double at[4][bucket] = {};
        std::array<std::uint32_t, bucket> index{};
        int count = 0;
    };
    void build(const std::vector<Point>& points, std::span<std::uint32_t> part);
    struct Search;
    void search(std::uint32_t node, double within, Search& s) const;

    std::size_t size_ = 0;
    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
};

}  // namespace nacre
