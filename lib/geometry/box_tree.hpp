#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Axis-aligned bounding box; empty until something is added.
struct Box {
    double left = std::numeric_limits<double>::infinity();
    double low = std::numeric_limits<double>::infinity();
    double right = -std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(Position p) { add(Box{p.x, p.y, p.x, p.y}); }
    void add(const Box& other) {
        left = std::min(left, other.left);
        low = std::min(low, other.low);
        right = std::max(right, other.right);
        high = std::max(high, other.high);
    }
    [[nodiscard]] bool empty() const { return left > right; }
    [[nodiscard]] Position centre() const { return {(left + right) / 2, (low + high) / 2}; }
    /// True if the boxes share a point.
    [[nodiscard]] bool intersects(const Box& other) const {
        return left <= other.right && right >= other.left && low <= other.high && high >= other.low;
    }
    /// Squared distance from a position; 0 inside.
    [[nodiscard]] double squared_distance(Position p) const {
        const double dx = std::max({left - p.x, 0.0, p.x - right});
        const double dy = std::max({low - p.y, 0.0, p.y - high});
        return dx * dx + dy * dy;
    }
};

[[nodiscard]] Box box_of(std::span<const Position> positions);
/// In columns and rows. Exact, because lattices have far fewer than 2^53 steps.
[[nodiscard]] Box box_of(const FineSegment& segment);
[[nodiscard]] Box box_of(std::span<const WorldPolygon> polygons);

/// Static index of boxes: Boost's R-tree, bulk-loaded. Thread-safe.
class BoxTree {
  public:
    explicit BoxTree(const std::vector<Box>& boxes);
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;
    ~BoxTree();

    /// Calls visit(i) for every box i that intersects `box`, in an order that depends only on the boxes.
    void query(const Box& box, const std::function<void(std::size_t)>& visit) const;
    [[nodiscard]] bool intersects_any(const Box& box) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
