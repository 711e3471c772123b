#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "flow/block_areas.hpp"
#include "flow/flow_faults.hpp"
#include "flow/flow_problem.hpp"

namespace d2b {

/// Mends the faults of a plan, round by round.
class FlowMender {
  public:
    /// @param frozen contours that stay as they are; empty for none
    FlowMender(PlanEditor& plan, std::span<const PlanContour> contours, const FlowLimits& limits,
               std::vector<bool> frozen = {})
        : plan_(plan),
          contours_(contours),
          limits_(limits),
          block_area_(block_areas(contours, plan.edges(), limits.metric)),
          frozen_(std::move(frozen)) {}

    /// @return whether anything has changed
    [[nodiscard]] bool round();
    [[nodiscard]] std::vector<FlowProblem> take_changed() { return std::move(changed_); }
    [[nodiscard]] FlowProblem problem(const FlowFault& fault) const;

  private:
    using Merge = std::pair<std::uint32_t, std::uint32_t>;  // a node, and what it is merged into
    [[nodiscard]] double most(std::uint32_t node, double most) const;
    [[nodiscard]] bool is_fresh(const FlowFault& fault) const;
    [[nodiscard]] bool mend(const FlowFault& fault);
    [[nodiscard]] bool mend_angle(const FlowFault& fault);
    [[nodiscard]] bool cut_off(const FlowFault& fault);
    [[nodiscard]] bool mend_gap(const FlowFault& fault);
    [[nodiscard]] bool merge_best(std::vector<Merge> merges);
    [[nodiscard]] std::optional<std::uint32_t> place_on(std::uint32_t edge, FinePoint place);
    void touch(std::uint32_t node);

    PlanEditor& plan_;
    std::span<const PlanContour> contours_;
    const FlowLimits& limits_;
    std::vector<double> block_area_;  // m2, of the block of each contour
    std::vector<bool> frozen_;        // contours
    std::vector<bool> touched_;       // nodes, this round
    std::vector<FlowProblem> changed_;
};

}  // namespace d2b
