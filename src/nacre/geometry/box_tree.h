#pragma once
// Many boxes, and which of them hold a point.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nacre/geometry/mesh.h"

namespace nacre {

class BoxTree {
  public:
    BoxTree();
    /// Throws RunError if memory does not suffice.
    explicit BoxTree(std::vector<Box3f> boxes);
    ~BoxTree();
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;

    bool empty() const { return !impl_; }
    std::size_t size() const;
    /// Writes the indices of the boxes that hold `p` to `found`, whose contents are dropped, in the
    /// order of their indices.
    void holding(const Point3f& p, std::vector<std::uint32_t>& found) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace nacre
