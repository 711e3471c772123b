#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contours/components.hpp"
#include "contours/open_chains.hpp"
#include "contours/runs.hpp"

namespace d2b::contours {

/// A part of an outline that leaves its band: the chain between two crossings of the borders of the band.
struct OutlinePiece {
    std::size_t first = 0;  ///< index of its first corner
    std::size_t corners = 0;
    /// Lowest outside elevations along the vertical edges to its first and from its last corner, within the
    /// band.
    double outside_begin = nothing_outside;
    double outside_end = nothing_outside;
};

/// Contours and outlines that continue beyond a band of rows, because they cross its first or last row. In
/// runs, `component`, `head` and `tail` are indices into the lists below.
struct OpenBand {
    RunRow top;     ///< a piece starts downwards at the head of a run, and one ends at its tail
    RunRow bottom;  ///< a piece ends at the head of a run, and one starts upwards at its tail
    std::int32_t last_line = 0;
    std::vector<Component> components;  ///< sorted so that `below` refers to an earlier one
    std::vector<OutlinePiece> pieces;
    std::vector<Corner> corners;
};

/// Elevations outside the contours of level 1 in the rows next to the sweep line: those of valid points below
/// the threshold, +infinity elsewhere. Spans are empty if there is no such row.
struct OutsideRows {
    std::span<const double> above;  ///< row above the line, excluding points on it
    std::span<const double> on;     ///< -trace points: points on the line; otherwise empty
    std::span<const double> below;  ///< row below the line, excluding points on it
    bool of_points = false;
};

/// The tracing engine. A line sweeps over the lattice between two rows of squares, and all levels are linked,
/// traced and finished in one pass. The state consists of one row of runs, the open outlines and the open
/// components. O(squares + length of all outlines).
class SweepLine {
  public:
    /// @param levels including the root @param first_col first column of the window in the whole raster
    SweepLine(std::int32_t levels, std::int32_t first_col, const ElevationRange& range);

    /// Links the row of squares below the line (`current`) to the row above.
    /// @param line row number of the line, equal to that of the squares below it
    void link(std::int32_t line, const OutsideRows& outside);
    /// Hands out the contours that ended above the line, highest levels first. The row below becomes the row
    /// above.
    void finish_ended(ContourSink& sink);

    /// Starts at a row of squares whose rows above are not known yet, instead of the first link(). Contours
    /// in this row are not handed out.
    void begin_band(std::int32_t line, const RunRow& squares);
    /// Returns the open contours and outlines of a band started by begin_band().
    [[nodiscard]] OpenBand take_open();
    /// Attaches the contours found below the first row of a band. Call after link() for that row and before
    /// finish_band().
    /// @param first_name name that the sink gives to the first contour of the band
    void join(OpenBand& band, std::int64_t first_name);
    /// Hands out the contours that ended above the last row of a band, which becomes the row above.
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
    void link_runs(std::size_t i, std::size_t level, const OutsideRows& outside);
    void join_left_sides(Run& upper, Run& lower, const OutsideRows& outside);
    void join_right_sides(Run& upper, Run& lower, const OutsideRows& outside);
    void start(Run& run, std::size_t level, const OutsideRows& outside);
    void close_gap(Run& head_run, Run& tail_run, std::int32_t from, std::int32_t to, std::uint32_t component,
                   std::span<const double> outside);
    void add_side_outside(Run& run, const OutsideRows& outside);
    void add_outline(std::uint32_t component, std::span<const Corner> outline);
    void add_ring(Component& c, std::span<const Corner> corners);
    [[nodiscard]] Corner corner(std::int32_t col, double outside = nothing_outside) const;
    [[nodiscard]] double lowest(std::span<const double> row, std::int32_t from, std::int32_t to) const;
    void finish_row(std::vector<Run>& runs, std::int32_t line, ContourSink& sink);
    void finish(std::uint32_t root, ContourSink& sink);
    void list_components(OpenBand& band, RunRow& row);
    std::uint32_t add_piece(std::uint32_t tail, const std::vector<bool>& at_top, OpenBand& band) const;

    std::int32_t first_col_;
    std::int32_t line_ = 0;
    bool with_outside_ = false;  ///< level 1 is being linked
    bool of_points_ = false;
    RunRow previous_;
    RunRow current_;
    std::vector<Link> links_;
    std::vector<std::int32_t> non_manifold_cols_;  ///< columns at which squares may share just a corner
    OpenChains chains_;
    Components components_;
    RunRow top_;        ///< first row of a band; heads and tails are chain ends in that row
    LatticeRing ring_;  ///< scratch buffer
};

}  // namespace d2b::contours
