#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "dem2buildings/feature_sink.hpp"

namespace d2b {

/// A rectangle along the axes; empty until something is added.
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
    /// Whether they share a point.
    [[nodiscard]] bool meets(const Box& other) const {
        return left <= other.right && right >= other.left && low <= other.high && high >= other.low;
    }
    /// 0 for a position in it.
    [[nodiscard]] double squared_distance(Position p) const {
        const double dx = std::max({left - p.x, 0.0, p.x - right});
        const double dy = std::max({low - p.y, 0.0, p.y - high});
        return dx * dx + dy * dy;
    }
};

[[nodiscard]] Box box_of(std::span<const Position> positions);
[[nodiscard]] Box box_of(std::span<const WorldPolygon> polygons);

/// Finds boxes among many: a binary tree, halved by the median of their centres.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Box> boxes);

    /// Calls visit(i) for every box i that meets `box`.
    template <typename Visit>
    void query(const Box& box, const Visit& visit) const {
        descend([&](const Box& other) { return other.meets(box); }, visit);
    }

    /// The smallest squared distance of a position to what is in the boxes, or `limit` where all is farther.
    /// @param squared_distance of the thing in box i, called where it may be less than what was found so far
    template <typename Distance>
    [[nodiscard]] double nearest(Position p, double limit, const Distance& squared_distance) const {
        descend([&](const Box& box) { return box.squared_distance(p) < limit; },
                [&](std::size_t i) { limit = std::min(limit, squared_distance(i)); });
        return limit;
    }

  private:
    struct Node {
        Box box;
        std::uint32_t begin = 0;  // in order_
        std::uint32_t end = 0;
        std::uint32_t right = 0;  // the right child, the left one being the next node; 0: a leaf
    };
    void build(std::size_t begin, std::size_t end);

    template <typename Enter, typename Visit>
    void descend(const Enter& enter, const Visit& visit) const {
        constexpr std::size_t deepest = 64;
        std::array<std::uint32_t, deepest> waiting{};
        std::size_t count = nodes_.empty() ? 0 : 1;
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!enter(node.box))
                continue;
            if (node.right != 0) {
                waiting[count++] = node.right;
                waiting[count++] = at + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (enter(boxes_[order_[i]]))
                    visit(std::size_t{order_[i]});
        }
    }

    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace d2b
