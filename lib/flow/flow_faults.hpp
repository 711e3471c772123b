#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "flow/flow_limits.hpp"
#include "surface/partition_editor.hpp"

namespace d2b {

enum class FlowKind {
    wall,   ///< an edge that is too short
    angle,  ///< between two edges that follow each other around a node
    gap,    ///< between a node and an edge with a lower place between them
    neck    ///< between a node and an edge of one contour, on which nothing stands there: a narrow part
};

/// What a flow solver cannot take.
struct FlowFault {
    FlowKind kind = FlowKind::wall;
    std::uint32_t node = 0;
    std::uint32_t one = 0;    ///< wall: its other end, or what lies on the way to it; angle: end of the first
                              ///< edge; gap and neck: the edge
    std::uint32_t other = 0;  ///< angle: end of the second edge
    double size = 0;          ///< m, or degrees
    FinePoint place;          ///< gap and neck: of the edge, nearest to the node
};

/// A fault and where it was found.
struct KnownFault {
    std::uint32_t found_at = 0;  ///< walls: edge; angles, gaps and necks: node
    FlowFault fault;
    bool tried = false;  ///< in vain, since something has changed near it
};

/// All that falls short of the limits while a plan changes. Edges that run on straight at a node that has no
/// third one are one wall. If a gap or a neck ends in a wedge, its angle counts instead of its width.
class FlowFaults {
  public:
    /// @throws Cancelled
    FlowFaults(const PartitionEditor& plan, std::span<const PartitionContour> contours,
               const FlowLimits& limits, const StopToken& stop);
    ~FlowFaults();
    FlowFaults(const FlowFaults&) = delete;
    FlowFaults& operator=(const FlowFaults&) = delete;

    /// Looks again at what lies near changes of the plan, and nowhere else.
    /// @param changes as take_changes() of the plan has them @throws Cancelled
    void update(std::span<const std::pair<std::uint32_t, std::uint32_t>> changes);
    /// In the order of edges.
    [[nodiscard]] const std::vector<KnownFault>& walls() const { return walls_; }
    [[nodiscard]] std::vector<KnownFault>& walls() { return walls_; }
    /// Angles, gaps and necks in the order of nodes.
    [[nodiscard]] const std::vector<KnownFault>& corners() const { return corners_; }
    [[nodiscard]] std::vector<KnownFault>& corners() { return corners_; }

  private:
    class Finder;
    void look_at(std::span<const std::uint32_t> edges, std::span<const std::uint32_t> nodes);

    const PartitionEditor& plan_;
    const FlowLimits& limits_;
    const StopToken& stop_;
    std::unique_ptr<Finder> finder_;
    std::vector<KnownFault> walls_;
    std::vector<KnownFault> corners_;
    std::vector<double> reach_;  // of each node: how far off edges have a say in what was found there, m
};

/// All of them, once; walls before angles, gaps and necks.
[[nodiscard]] std::vector<FlowFault> find_faults(const PartitionEditor& plan,
                                                 std::span<const PartitionContour> contours,
                                                 const FlowLimits& limits, const StopToken& stop = {});

}  // namespace d2b
