#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "levels/quantise.hpp"
#include "trace/runs.hpp"

namespace d2b {

/// What the tracer needs to know of the whole DEM before its first row.
struct TraceFrame {
    Window window;
    std::int32_t levels = 1;  ///< root included
    FixedPoint fixed;         ///< for sums of elevations
    ElevationRange range;     ///< for percentiles
};

/// Rows of points with all that tracing asks of them.
/// @tparam Count as the levels are kept
template <typename Count>
struct PointRows {
    std::shared_ptr<const ElevationBand> elevations = std::make_shared<ElevationBand>();
    LabelBand labels;
    LevelBand<Count> levels;

    [[nodiscard]] const BandShape& shape() const { return elevations->shape; }
    [[nodiscard]] std::int32_t end_row() const { return shape().first_row + shape().rows; }
};

/// Points of a line, side by side, that belong to one contour: to the highest around them.
struct PointShare {
    bool above = false;         ///< the contour's square lies above the line, else below
    std::uint32_t top_run = 0;  ///< of that row of squares
    std::int32_t begin = 0;     ///< columns
    std::int32_t end = 0;
    PointStats stats;
};

/// What points of a contour add up to that were looked at elsewhere, in a part of the window.
struct ContourSum {
    bool above = false;      ///< a square of the contour's lies above the line, else below
    std::int32_t level = 0;  ///< of the contour
    std::int32_t col = 0;    ///< of the square
    PointStats stats;
    ElevationSample roof;  ///< level 1 alone: of all points but spires
};

/// A stop of the sweep line with what can be known of it without what came before.
struct TraceLine {
    static constexpr std::int32_t none = -1;

    std::int32_t line = none;  ///< `none`: a first row of points alone, which no line has reached yet
    RunRow squares;            ///< below the line
    std::vector<PointShare> shares;
    std::span<const double> elevations;          ///< of the points on the line
    std::vector<std::int32_t> spires;            ///< columns of those that are no roof
    std::shared_ptr<const ElevationBand> owner;  ///< of these, where it is not the band that was taken apart
    /// Of the row of points below the line: the elevation where a point is valid and does not qualify, else
    /// +infinity.
    std::vector<double> outside;
    std::vector<ContourSum> sums;  ///< in place of shares
};

/// Columns side by side.
struct ColSpan {
    std::int32_t begin = 0;
    std::int32_t end = std::numeric_limits<std::int32_t>::max();
};

/// So many rows above a band are needed to take it apart: a line between points has a row of squares on
/// either side, each between two rows of points.
[[nodiscard]] constexpr std::int32_t rows_above(TraceMode mode) {
    return mode == TraceMode::points ? 2 : 0;
}

/// Cuts rows into runs and sums up their points: all of tracing that does not depend on what lies more than
/// two rows above, so that bands can be taken apart side by side.
/// @param before the last rows_above() rows above the band, or as many as there are; more are not looked at
/// @param band its elevations must outlive the lines
/// @return the lines that the band's rows complete, from the top; after the window's last row also the line
///         under it
/// @param summed columns of the points that are summed up: others are known for the sake of squares
template <typename Count>
[[nodiscard]] std::vector<TraceLine> take_apart(const TraceFrame& frame, TraceMode mode,
                                                const PointRows<Count>& before, const PointRows<Count>& band,
                                                const ColSpan& summed = {});

extern template std::vector<TraceLine> take_apart(const TraceFrame&, TraceMode,
                                                  const PointRows<std::uint8_t>&,
                                                  const PointRows<std::uint8_t>&, const ColSpan&);
extern template std::vector<TraceLine> take_apart(const TraceFrame&, TraceMode,
                                                  const PointRows<std::uint16_t>&,
                                                  const PointRows<std::uint16_t>&, const ColSpan&);

}  // namespace d2b
