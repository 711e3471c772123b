#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/fit_walls.hpp"
#include "outline/walls/ring_areas.hpp"
#include "outline/walls/wall_check.hpp"

namespace d2b {

/// Draws the walls of a cluster, checks them, and gives what is in the way a simpler form, until nothing is.
class WallRounds {
  public:
    /// @param cluster, stop must outlive this
    WallRounds(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop);
    WallRounds(const WallRounds&) = delete;
    WallRounds& operator=(const WallRounds&) = delete;
    ~WallRounds() = default;

    /// Begins with what has been settled for the lower levels alone, which is of no use after that.
    void adopt(WallRounds&& low) { drawing_.adopt(std::move(low.drawing_)); }
    /// Ends: each round makes at least one form simpler or uses up one of the few shifts, and the trace is
    /// without fault. @throws Cancelled
    void settle();
    [[nodiscard]] WallOutline outline(std::size_t contour) const;

  private:
    void collect(std::vector<std::uint32_t>& changed);
    void check_deviations(const std::vector<std::uint32_t>& changed);
    void resolve(std::uint32_t a, std::uint32_t b);
    void trace_part(std::uint32_t part);
    void simplify(std::uint32_t chain);
    [[nodiscard]] double arc_length(std::uint32_t arc) const;
    void append(FineRing& to, const ArcUse& use, std::uint32_t number,
                std::vector<CircularArc>& ring_spans) const;

    WallOptions options_;
    const StopRequest& stop_;
    WallGraph graph_;
    WallDrawing drawing_;
    SegmentGrid::Arcs arcs_;
    std::vector<std::vector<CircularArc>> spans_;  // of an arc; `ring` is not used
    std::vector<double> deviations_;               // of an arc
    std::vector<bool> in_conflict_;                // parts, this round
    DrawnChain drawn_;
    RingAreas areas_;
    WallCheck check_;
    int round_ = 0;
};

}  // namespace d2b
