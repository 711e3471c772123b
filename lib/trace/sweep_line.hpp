#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/arms.hpp"
#include "trace/components.hpp"
#include "trace/open_band.hpp"
#include "trace/runs.hpp"

namespace d2b {

/// The lowest elevations beside outlines of level 1, by the rows next to the line that is being swept: points
/// that are valid and do not qualify, +infinity elsewhere. Empty spans stand for rows that are not there.
struct OutsideRows {
    std::span<const double> above;  ///< the row above the line that is not on it
    std::span<const double> on;     ///< -trace points: the row of points on the line; else empty
    std::span<const double> below;  ///< the row below the line that is not on it
    bool of_points = false;
};

/// Whether contours get their outlines, or what their points add up to is all that is asked for.
enum class Outlines { traced, none };

/// The engine: a line sweeps over the lattice, between the row of squares above it and the one below. All
/// levels are linked, traced and finished in one pass; carried are one row of runs, the open outlines and
/// the open components. O(squares + length of all outlines).
class SweepLine {
  public:
    /// @param levels root included @param first_col of the window in the whole raster
    SweepLine(std::int32_t levels, std::int32_t first_col, const ElevationRange& range, Outlines outlines);

    /// Links the row of squares below the line (given as `current`) to the one above.
    /// @param line row number of the line, which is that of the squares below it
    void link(std::int32_t line, const OutsideRows& outside);
    /// Hands out what ended above the line, the highest levels first; then the row below becomes the row
    /// above.
    void finish_ended(ContourSink& sink);

    /// Begins with a row of squares under a line, where rows above are not known yet, in the place of the
    /// first link(). What the row passes is not handed out.
    void begin_below(std::int32_t line, const RunRow& squares);
    /// What is left of a band that was begun so: it goes on beyond it.
    [[nodiscard]] OpenBand take_open();
    /// After link() to the first row of a band: takes what was found below that row. Before finish_band().
    /// @param first_name what the sink calls the first contour that the band has handed out
    void join(OpenBand& band, std::int64_t first_name);
    /// Hands out what ended above a band's last row, which then becomes the row above.
    void finish_band(OpenBand&& band, ContourSink& sink);

    [[nodiscard]] RunRow& current() { return current_; }
    [[nodiscard]] const RunRow& previous() const { return previous_; }
    Components& components() { return components_; }

  private:
    struct Link {
        std::uint32_t upper;
        std::uint32_t lower;
    };
    using Runs = std::vector<Run>;

    void find_links(const Runs& upper, const Runs& lower);
    void link_level(std::size_t level, const OutsideRows& outside);
    void follow(std::size_t i, std::size_t level, const OutsideRows& outside);
    void left_sides_meet(Run& upper, Run& lower, const OutsideRows& outside);
    void right_sides_meet(Run& upper, Run& lower, const OutsideRows& outside);
    void start(Run& run, std::size_t level, const OutsideRows& outside);
    void close_gap(Run& head_run, Run& tail_run, std::int32_t from, std::int32_t to, std::uint32_t component,
                   std::span<const double> outside);
    void pass_sides(Run& run, const OutsideRows& outside);
    void add_outline(std::uint32_t component, std::span<const Corner> outline);
    void add_ring(Component& c, std::span<const Corner> corners);
    [[nodiscard]] Corner corner(std::int32_t col, double outside = nothing_outside) const;
    [[nodiscard]] double lowest(std::span<const double> row, std::int32_t from, std::int32_t to) const;
    void finish_row(std::vector<Run>& runs, std::int32_t line, ContourSink& sink);
    void finish(std::uint32_t root, ContourSink& sink);
    void place_components(OpenBand& band, RunRow& row);
    std::uint32_t add_piece(std::uint32_t tail, const std::vector<bool>& at_top, OpenBand& band) const;

    bool traces_;  ///< outlines
    std::int32_t first_col_;
    std::int32_t line_ = 0;
    bool with_outside_ = false;  ///< level 1 is being linked
    bool of_points_ = false;
    RunRow previous_;
    RunRow current_;
    std::vector<Link> links_;
    std::vector<std::int32_t>
        pinches_;  ///< columns of this line and level where squares may meet in a corner
    Arms arms_;
    Components components_;
    RunRow top_;        ///< what a band began in; the heads and tails are arms in the row
    LatticeRing ring_;  ///< room to work in
};

}  // namespace d2b
