#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/flow_limits.hpp"
#include "surface/partition_editor.hpp"

namespace d2b::surface {

enum class FlowKind {
    wall,     ///< an edge that is too short
    angle,    ///< between two consecutive edges around a node
    gap,      ///< between a node and an edge with a lower place between them
    neck,     ///< between a node and an edge of one contour, on which nothing stands there: a narrow part
    touch,    ///< outlines that touch in a corner
    crossing  ///< outlines that cross
};

/// A place of a partition that is too short, sharp or narrow for a flow solver.
struct FlowFault {
    FlowKind kind = FlowKind::wall;
    std::uint32_t node = 0;
    std::uint32_t one = 0;    ///< wall: its other end, or a node on the way there; angle: end of the first
                              ///< edge; gap and neck: the edge
    std::uint32_t other = 0;  ///< angle: end of the second edge
    double size = 0;          ///< m, or degrees
    FinePoint place;          ///< gap and neck: of the edge, nearest to the node
};

/// A fault of the outlines and its outcome.
struct FlowProblem {
    FlowKind kind = FlowKind::wall;
    double before = 0;  ///< m; degrees for angles
    double after = 0;
    bool changed = false;
    FinePoint place;
    std::vector<std::int32_t> contours;  ///< contours next to it
};

/// A fault and the edge or node at which it was found.
struct KnownFault {
    std::uint32_t found_at = 0;  ///< walls: edge; angles, gaps and necks: node
    FlowFault fault;
    bool tried = false;  ///< without success since the last change near it
};

/// All faults of a partition, kept up to date while it changes. Edges that go straight on at a node of two
/// edges are one wall. If a gap or a neck ends in a wedge, its angle counts instead of its width.
class FlowFaults {
  public:
    /// @throws Cancelled
    FlowFaults(const PartitionEditor& plan, std::span<const PartitionContour> contours,
               const FlowLimits& limits, const StopToken& stop);
    ~FlowFaults();
    FlowFaults(const FlowFaults&) = delete;
    FlowFaults& operator=(const FlowFaults&) = delete;

    /// Searches again near changes, because the rest of the partition keeps its faults.
    /// @param changes as take_changes() of the plan has them @throws Cancelled
    void update(std::span<const std::pair<std::uint32_t, std::uint32_t>> changes);
    /// Sorted by edge.
    [[nodiscard]] const std::vector<KnownFault>& walls() const { return walls_; }
    [[nodiscard]] std::vector<KnownFault>& walls() { return walls_; }
    /// Angles, gaps and necks, sorted by node.
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
    std::vector<double> reach_;  // per node: distance within which edges affect its faults, m
};

/// Finds all faults; walls come before angles, gaps and necks. A gap or neck between two corners is one
/// fault.
[[nodiscard]] std::vector<FlowFault> find_faults(const PartitionEditor& plan,
                                                 std::span<const PartitionContour> contours,
                                                 const FlowLimits& limits, const StopToken& stop = {});

}  // namespace d2b::surface
