#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// Edge as seen from one of its ends (a half-edge).
struct NodeArm {
    std::uint32_t edge = 0;
    std::uint32_t end = 0;  ///< node at the other end
    std::int32_t left = open_ground;
    std::int32_t right = open_ground;
};

/// Edges around each node of a plan, counter-clockwise (y up).
class NodeStars {
  public:
    explicit NodeStars(const Plan& plan);

    [[nodiscard]] const std::vector<NodeArm>& around(std::uint32_t node) const { return arms_[node]; }

  private:
    std::vector<std::vector<NodeArm>> arms_;
};

/// Sorts the edges at one node counter-clockwise. @param arms in any order
void sort_around(const Plan& plan, std::uint32_t node, std::vector<NodeArm>& arms);

}  // namespace d2b
