#pragma once
// The points nearest to another one, of up to four coordinates.
#include <array>
#include <cstdint>
#include <vector>

namespace nacre {

/// A balanced k-d tree (J. L. Bentley 1975, Multidimensional Binary Search Trees Used for
/// Associative Searching, Communications of the ACM 18(9)).
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
    std::size_t size() const { return points_.size(); }

    /// The `count` (at most `most`) nearest to `p`, nearest first, by their positions in what was
    /// given; how many there are. Equal distances: the lower position first.
    int nearest(const Point& p, int count, Near* found) const;

  private:
    void build(std::size_t begin, std::size_t end);
    struct Search;
    void search(std::size_t begin, std::size_t end, Search& s) const;

    std::vector<Point> points_;         ///< by position in the tree
    std::vector<std::uint32_t> index_;  ///< what was given there
    std::vector<std::uint8_t> axis_;    ///< along which the range with this middle is split
};

}  // namespace nacre
