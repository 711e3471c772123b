#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/drawn_outlines.hpp"
#include "outline/walls/wall_check.hpp"

namespace d2b {

/// Draws the walls of a cluster, checks them, and lets what is in the way follow its trace closer there,
/// until nothing is.
class WallRounds {
  public:
    /// @param cluster, stop must outlive this
    WallRounds(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop);
    WallRounds(const WallRounds&) = delete;
    WallRounds& operator=(const WallRounds&) = delete;
    ~WallRounds() = default;

    /// Ends: each round brings some steps closer to their trace or uses up one of the few shifts, and what
    /// follows the trace all over is in nobody's way. @throws Cancelled
    void settle();
    /// What is drawn; this must outlive it.
    [[nodiscard]] DrawnOutlines outlines() const { return {graph_, drawing_, areas_, options_}; }

  private:
    using Edge = SegmentGrid::Edge;
    /// A stretch of a chain, in steps.
    struct Place {
        std::uint32_t chain;
        std::size_t first;
        std::size_t last;
    };

    void collect(std::vector<std::uint32_t>& changed);
    void check_deviations(const std::vector<std::uint32_t>& changed);
    void resolve(const WallConflicts& conflicts);
    void resolve(Edge a, Edge b);
    [[nodiscard]] Place near(Edge e, Edge other) const;
    bool follow_closer(const Place& place);
    bool follow_nodes(std::uint32_t arc);
    void trace_part(std::uint32_t part);
    [[nodiscard]] int rank(Edge e) const { return graph_.chains[graph_.chain_of[e.arc]].rank; }
    [[nodiscard]] std::size_t margin() const { return std::size_t{2} << std::min(round_ / 6, 16); }

    WallOptions options_;
    const StopRequest& stop_;
    WallGraph graph_;
    WallDrawing drawing_;
    SegmentGrid::Arcs arcs_;
    std::vector<std::vector<std::uint32_t>> steps_;  // of an arc's vertices in its chain
    std::vector<double> deviations_;                 // of an arc
    std::vector<std::uint32_t> far_;                 // arcs that were too far from their traces, ascending
    std::vector<bool> in_conflict_;                  // parts, this round
    DrawnChain drawn_;
    RingAreas areas_;
    WallCheck check_;
    int round_ = 0;
};

}  // namespace d2b
