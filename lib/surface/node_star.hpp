#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// An edge as it is seen from one of its ends.
struct NodeArm {
    std::uint32_t edge = 0;
    std::uint32_t end = 0;  ///< node at its other end
    std::int32_t left = open_ground;
    std::int32_t right = open_ground;
};

/// The edges around each node of a plan, counter-clockwise (y up).
class NodeStars {
  public:
    explicit NodeStars(const Plan& plan);

    [[nodiscard]] const std::vector<NodeArm>& around(std::uint32_t node) const { return arms_[node]; }

  private:
    std::vector<std::vector<NodeArm>> arms_;
};

/// The edges at one node, sorted likewise. @param arms in any order
void sort_around(const Plan& plan, std::uint32_t node, std::vector<NodeArm>& arms);

}  // namespace d2b
