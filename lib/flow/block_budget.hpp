#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flow/flow_limits.hpp"
#include "surface/planar_partition.hpp"

namespace d2b {

/// How much of each block changes may still take, all of them together. Touching contours of the lowest level
/// are a block, with what stands on them.
class BlockBudget {
  public:
    /// @param edges of the partition of these contours, before anything is changed
    BlockBudget(std::span<const PartitionContour> contours, std::span<const PartitionEdge> edges,
                const FlowLimits& limits);

    /// Whether a change may take so much of the blocks of some contours, which may name open_ground, and a
    /// contour several times. @param outside m2 at outlines of blocks @param inside m2 between the contours
    /// of one, which take nothing of it: here the limit is that of a change alone
    [[nodiscard]] bool allows(std::span<const std::int32_t> contours, double outside, double inside) const;
    /// @param outside m2
    void take(std::span<const std::int32_t> contours, double outside);

  private:
    [[nodiscard]] std::vector<std::uint32_t> blocks_of(std::span<const std::int32_t> contours) const;

    std::vector<std::uint32_t> block_;  // of each contour
    std::vector<double> most_;          // m2, by block
    std::vector<double> taken_;         // likewise
};

}  // namespace d2b
