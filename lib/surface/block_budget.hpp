#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/flow_limits.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Area that all changes together may still take from each block. Touching contours of the lowest level form
/// a block, with everything on top of them.
class BlockBudget {
  public:
    /// @param edges of the partition of these contours, before anything is changed
    BlockBudget(std::span<const PartitionContour> contours, std::span<const PartitionEdge> edges,
                const FlowLimits& limits);

    /// Returns true if the blocks of some contours allow a change. @param contours may hold open_ground and
    /// duplicates @param outside m2 along outlines of blocks @param inside m2 between contours of one block,
    /// limited per change because it takes nothing from the block
    [[nodiscard]] bool allows(std::span<const std::int32_t> contours, double outside, double inside) const;
    /// @param outside m2
    void take(std::span<const std::int32_t> contours, double outside);

  private:
    [[nodiscard]] std::vector<std::uint32_t> blocks_of(std::span<const std::int32_t> contours) const;

    std::vector<std::uint32_t> block_;  // per contour
    std::vector<double> most_;          // m2 per block
    std::vector<double> taken_;         // m2 per block
};

}  // namespace d2b::surface
