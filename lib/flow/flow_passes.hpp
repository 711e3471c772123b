#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "flow/block_budget.hpp"
#include "flow/flow_limits.hpp"
#include "flow/flow_problem.hpp"
#include "surface/planar_partition.hpp"

namespace d2b {

/// What changing a plan has come to.
struct FlowOutlines {
    std::vector<FinePolygon> outlines;  ///< of all contours
    std::vector<FlowProblem> problems;
    std::size_t left = 0;  ///< faults
};

/// Mending makes corners touch, and taking these apart makes short walls.
class FlowPasses {
  public:
    FlowPasses(PlanarPartition plan, std::span<const PartitionContour> contours, const FlowLimits& limits,
               const std::vector<bool>& frozen)
        : plan_(std::move(plan)),
          contours_(contours),
          limits_(limits),
          frozen_(frozen),
          budget_(contours, plan_.edges, limits) {}

    /// @return nothing where outlines would not be what they are to be
    [[nodiscard]] std::optional<FlowOutlines> make(std::span<const PartitionContour> leveled,
                                                   const StopToken& stop);
    /// Contours that were in pieces or gone, where that was the reason.
    [[nodiscard]] const std::vector<std::uint32_t>& broken() const { return broken_; }

  private:
    void mend(const StopToken& stop);
    [[nodiscard]] bool take_apart(std::span<const PartitionContour> leveled, const StopToken& stop);
    void straighten();
    [[nodiscard]] bool is_sound(const std::vector<FinePolygon>& outlines) const;

    PlanarPartition plan_;
    std::span<const PartitionContour> contours_;
    const FlowLimits& limits_;
    const std::vector<bool>& frozen_;
    BlockBudget budget_;  // of all passes together
    std::vector<FlowProblem> problems_;
    std::vector<std::uint32_t> broken_;
};

}  // namespace d2b
