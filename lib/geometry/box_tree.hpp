#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/box.hpp"

namespace d2b {

/// Static index of boxes: Boost's R-tree, bulk-loaded. Thread-safe.
class BoxTree {
  public:
    explicit BoxTree(const std::vector<Box>& boxes);
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;
    ~BoxTree();

    /// Calls visit(i) for every box i that intersects `box`, in an order that depends only on the boxes.
    void query(const Box& box, const std::function<void(std::size_t)>& visit) const;
    [[nodiscard]] bool meets_any(const Box& box) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
