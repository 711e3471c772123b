#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/block_budget.hpp"
#include "surface/flow_limits.hpp"
#include "surface/flow_problem.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Result of changing a partition.
struct FlowOutlines {
    std::vector<FinePolygon> outlines;  ///< per contour
    std::vector<FlowProblem> problems;
    std::size_t left = 0;  ///< number of faults
};

/// Alternates mending and taking apart, because mending makes corners touch, and taking these apart makes
/// short walls.
class FlowPasses {
  public:
    FlowPasses(PlanarPartition plan, std::span<const PartitionContour> contours, const FlowLimits& limits,
               std::vector<bool> frozen)
        : plan_(std::move(plan)),
          contours_(contours),
          limits_(limits),
          frozen_(std::move(frozen)),
          budget_(contours, plan_.edges, limits) {
        frozen_.resize(contours.size());
    }

    /// @return std::nullopt if a contour would be broken or outlines would cross
    [[nodiscard]] std::optional<FlowOutlines> make(std::span<const PartitionContour> leveled,
                                                   const StopToken& stop);

  private:
    void mend(const StopToken& stop);
    [[nodiscard]] bool take_apart(std::span<const PartitionContour> leveled, const StopToken& stop);
    void straighten();
    [[nodiscard]] bool is_sound(const std::vector<FinePolygon>& outlines, const StopToken& stop) const;

    PlanarPartition plan_;
    std::span<const PartitionContour> contours_;
    const FlowLimits& limits_;
    std::vector<bool> frozen_;  // contours; those that a pass breaks are added
    BlockBudget budget_;        // shared by all passes
    std::vector<FlowProblem> problems_;
};

}  // namespace d2b::surface
