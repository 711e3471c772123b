#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/drawn_outlines.hpp"
#include "outline/walls/wall_check.hpp"

namespace d2b {

/// Draws the walls of a cluster and checks them. Conflicting parts follow their trace more closely until no
/// conflict remains.
class WallRounds {
  public:
    /// @param cluster, stop must outlive this
    WallRounds(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop);
    WallRounds(const WallRounds&) = delete;
    WallRounds& operator=(const WallRounds&) = delete;
    ~WallRounds() = default;

    /// Runs rounds until the drawing is valid. Terminates because each round moves a stretch closer to its
    /// trace or uses one of finitely many shifts, and a chain that follows its trace entirely cannot
    /// conflict.
    /// @throws Cancelled
    void settle();
    /// Resulting outlines; this must outlive them.
    [[nodiscard]] DrawnOutlines outlines() const { return {graph_, drawing_, areas_, options_}; }

  private:
    using Edge = SegmentGrid::Edge;
    /// A range of steps of a chain.
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
    std::vector<std::vector<std::uint32_t>> steps_;  // steps in the chain, per vertex of an arc
    std::vector<double> deviations_;                 // per arc
    std::vector<std::uint32_t> far_;                 // arcs that were too far from their traces, ascending
    std::vector<bool> in_conflict_;                  // components, in this round
    DrawnChain drawn_;
    RingAreas areas_;
    WallCheck check_;
    int round_ = 0;
};

}  // namespace d2b
