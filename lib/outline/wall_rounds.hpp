#pragma once

#include <cstdint>
#include <vector>

#include "outline/wall_check.hpp"
#include "outline/wall_fit.hpp"
#include "outline/wall_marks.hpp"

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
    using Wall = WallDrawing::Wall;
    struct Ring {
        const std::vector<ArcUse>* uses = nullptr;
        std::int64_t traced = 0;  // area, in cells
        int level = 0;
        bool waits = false;  // to be measured
        double missing = 0;  // area, when walls were moved last
        double asked = 0;    // of them
    };

    void find_rings();
    void collect(std::vector<std::uint32_t>& changed);
    void add_area(std::uint32_t arc);
    void let_wait(std::uint32_t ring);
    void check_deviations(const std::vector<std::uint32_t>& changed);
    void resolve(std::uint32_t a, std::uint32_t b);
    void trace_part(std::uint32_t part);
    void simplify(std::uint32_t chain);
    [[nodiscard]] std::uint32_t part_of(std::uint32_t arc) const {
        return graph_.part_of[graph_.chain_of[arc]];
    }

    void check_areas();
    [[nodiscard]] Int128 twice_area(const std::vector<ArcUse>& ring) const;
    void correct(Ring& ring, double missing);
    void simplify_last(const Ring& ring);
    [[nodiscard]] double arc_length(std::uint32_t arc) const;
    void append(FineRing& to, const ArcUse& use, std::uint32_t number,
                std::vector<ArcSpan>& ring_spans) const;

    const WallCluster& cluster_;
    WallOptions options_;
    const StopRequest& stop_;
    WallGraph graph_;
    WallDrawing drawing_;
    SegmentGrid::Arcs arcs_;
    std::vector<std::vector<ArcSpan>> spans_;  // of an arc; `ring` is not used
    std::vector<double> deviations_;           // of an arc
    std::vector<Int128> areas_;                // of an arc and the origin, twice, in fine squares
    std::vector<Ring> rings_;                  // exterior and interiors of one contour after the other
    std::vector<std::uint32_t> first_ring_;    // of a contour
    std::vector<std::uint32_t> rings_of_;      // arcs: those of one after the other
    std::vector<std::uint32_t> first_of_arc_;
    std::vector<std::uint32_t> waiting_rings_;
    std::vector<bool> in_conflict_;  // parts, this round
    WallMarks gathered_;             // walls of the ring that is corrected
    WallMarks moved_;                // walls, this round
    DrawnChain drawn_;
    WallCheck check_;
    int round_ = 0;
};

}  // namespace d2b
