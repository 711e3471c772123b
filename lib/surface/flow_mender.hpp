#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surface/flow_faults.hpp"

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

/// Mends the faults of a partition in rounds. Each round begins with the smallest changes, so that the budget
/// of a block goes far.
class FlowMender {
  public:
    /// @param budget reduced by each change @param frozen contours that stay as they are; empty for none
    FlowMender(PartitionEditor& plan, std::span<const PartitionContour> contours, const FlowLimits& limits,
               BlockBudget& budget, const std::vector<bool>& frozen, const StopToken& stop)
        : plan_(plan),
          contours_(contours),
          limits_(limits),
          budget_(budget),
          frozen_(frozen),
          stop_(stop),
          faults_(plan, contours, limits, stop) {}

    /// @return true if anything has changed
    [[nodiscard]] bool round();
    [[nodiscard]] std::vector<FlowProblem> take_changed() { return std::move(changed_); }

  private:
    using Merge = std::pair<std::uint32_t, std::uint32_t>;  // a node and the node that it is merged into
    /// Area that the edges of a node sweep when it moves, m2.
    struct Swept {
        double outside = 0;  ///< along outlines of blocks
        double inside = 0;   ///< between contours of one block
    };
    [[nodiscard]] double square_metres(Int128 twice_steps) const;
    [[nodiscard]] Swept swept_by(std::uint32_t node, FinePoint place) const;
    [[nodiscard]] std::vector<KnownFault*> in_order();
    template <typename Mend>
    [[nodiscard]] bool try_to(const Mend& mend);
    [[nodiscard]] bool is_frozen(std::uint32_t node) const;
    [[nodiscard]] bool is_fresh(const FlowFault& fault) const;
    [[nodiscard]] bool mend(const FlowFault& fault);
    [[nodiscard]] bool mend_angle(const FlowFault& fault);
    [[nodiscard]] bool cut_off(const FlowFault& fault);
    [[nodiscard]] bool mend_wall(const FlowFault& fault);
    [[nodiscard]] bool ends_a_narrow_place(std::uint32_t gone, std::uint32_t stays, std::uint32_t next) const;
    [[nodiscard]] bool slant(std::uint32_t gone, std::uint32_t stays);
    [[nodiscard]] bool mend_gap(const FlowFault& fault);
    [[nodiscard]] bool is_away(FinePoint place, std::uint32_t node, double metres) const;
    [[nodiscard]] bool cut_corner(const FlowFault& fault);
    [[nodiscard]] bool mend_neck(const FlowFault& fault);
    [[nodiscard]] bool move(std::uint32_t node, FinePoint place);
    [[nodiscard]] bool bend(std::uint32_t edge, FinePoint place);
    [[nodiscard]] bool merge_best(std::vector<Merge> merges, double share = 1);
    [[nodiscard]] std::optional<std::uint32_t> place_on(std::uint32_t edge, FinePoint place);
    [[nodiscard]] FinePoint along(std::uint32_t from, std::uint32_t to, double metres) const;
    void touch(std::uint32_t node);

    PartitionEditor& plan_;
    std::span<const PartitionContour> contours_;
    const FlowLimits& limits_;
    BlockBudget& budget_;
    const std::vector<bool>& frozen_;  // contours
    const StopToken& stop_;
    FlowFaults faults_;
    std::vector<bool> touched_;  // nodes, this round
    std::vector<FlowProblem> changed_;
};

/// Describes a fault that is left. @param plan the partition in which it was found
[[nodiscard]] FlowProblem problem_of(const FlowFault& fault, const PartitionEditor& plan);

}  // namespace d2b::surface
