#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contours/level_plan.hpp"
#include "contours/runs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::contours {

/// Properties of the whole DEM required before tracing its first row.
struct TraceFrame {
    Window window;
    std::int32_t levels = 1;  ///< including the root
    FixedPoint fixed;         ///< used for sums of elevations
    ElevationRange range;     ///< used for percentiles
};

/// Rows of points with their elevations, labels and levels.
/// @tparam Count type of the level counts
template <typename Count>
struct PointRows {
    std::shared_ptr<const ElevationBand> elevations = std::make_shared<ElevationBand>();
    LabelBand labels;
    LevelBand<Count> levels;

    [[nodiscard]] const BandShape& shape() const { return elevations->shape; }
    [[nodiscard]] std::int32_t end_row() const { return shape().first_row + shape().rows; }
};

/// Consecutive points of a line that belong to the same contour, the highest around them.
struct PointRun {
    bool above = false;         ///< true if the square of the contour lies above the line
    std::uint32_t top_run = 0;  ///< index in that row of squares
    std::int32_t begin = 0;     ///< columns
    std::int32_t end = 0;
    PointStats stats;
};

/// One position of the sweep line, with everything that can be computed without the lines before it.
struct TraceLine {
    static constexpr std::int32_t none = -1;

    std::int32_t line = none;  ///< `none`: first row of points, which no line has reached yet
    RunRow squares;            ///< below the line
    std::vector<PointRun> point_runs;
    std::span<const double> elevations;          ///< elevations of points on the line
    std::vector<std::int32_t> spires;            ///< columns of spires, which are not part of a roof
    std::shared_ptr<const ElevationBand> owner;  ///< owner of `elevations` unless that is the band itself
    /// Elevations of valid points below the threshold in the row below the line, +infinity elsewhere.
    std::vector<double> outside;
};

/// Number of rows above a band needed for splitting it into runs: a line between points has a row of squares
/// on either side, and each of those needs two rows of points.
[[nodiscard]] constexpr std::int32_t rows_above(TraceMode mode) {
    return mode == TraceMode::points ? 2 : 0;
}

/// Splits rows into runs and sums up their points. This is the part of tracing that depends on at most two
/// rows above, so bands can be processed in parallel.
/// @param before the last rows_above() rows above the band, or fewer at the top; others are ignored
/// @param band its elevations must outlive the lines
/// @return the lines that the rows of the band complete, top down, and after the last row of the window the
/// line below it
template <typename Count>
[[nodiscard]] std::vector<TraceLine> split_into_runs(const TraceFrame& frame, TraceMode mode,
                                                     const PointRows<Count>& before,
                                                     const PointRows<Count>& band);

extern template std::vector<TraceLine> split_into_runs(const TraceFrame&, TraceMode,
                                                       const PointRows<std::uint8_t>&,
                                                       const PointRows<std::uint8_t>&);
extern template std::vector<TraceLine> split_into_runs(const TraceFrame&, TraceMode,
                                                       const PointRows<std::uint16_t>&,
                                                       const PointRows<std::uint16_t>&);

}  // namespace d2b::contours
