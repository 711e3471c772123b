#pragma once

#include <deque>
#include <vector>

#include "tiles/traced_tile.hpp"
#include "trace/tracer.hpp"

namespace d2b {

/// Compresses the lines of a tile for the merge step: runs of squares, elevations just outside of contours
/// of level 1, and the sums over the points of each contour within the tile.
class TileLines : private ContourSink {
  public:
    /// @param seen the tile with its halo @param own the tile's own cells
    TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own);

    /// Adds the next lines of the extent, from top to bottom.
    void add(std::vector<TraceLine>&& lines);
    /// Returns the packed lines. Call once, after the last add().
    [[nodiscard]] std::vector<PackedLine> finish();

  private:
    /// Line held back until the squares around its outside elevations are known.
    struct Waiting {
        std::int32_t row = 0;
        std::size_t line = 0;  ///< index
        std::vector<TileSquares> squares;
        std::vector<double> outside;
    };
    using Runs = std::vector<Run>;

    std::int64_t take(FinishedContour&& finished) override;
    void add(TraceLine&& line);
    void keep(const Waiting& waiting, bool all);
    [[nodiscard]] std::vector<TileOutside> beside(std::span<const double> outside, bool all);

    TraceFrame frame_;
    Window seen_;
    Window own_;
    Tracer tracer_;
    std::int32_t next_row_;  ///< next row of cells or points
    std::deque<Waiting> waiting_;
    std::deque<Runs> footprints_;  ///< runs of level 1 in the latest rows of squares, latest last
    std::vector<PackedLine> lines_;
    std::vector<std::uint8_t> wanted_;  ///< columns of the extent to keep, one byte per column
    std::int64_t taken_ = 0;            ///< number of contours
};

}  // namespace d2b
