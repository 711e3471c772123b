#pragma once

#include <deque>
#include <vector>

#include "tiles/traced_tile.hpp"
#include "trace/tracer.hpp"

namespace d2b {

/// The lines of a tile, as merge joins them to those beside it: squares as runs, what lies beside contours of
/// level 1, and what the points of each contour add up to as far as the tile holds it.
class TileLines : private ContourSink {
  public:
    /// @param seen what is known of the tile and around it @param own of its cells
    TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own);

    /// The next lines of what is seen, from the top.
    void add(std::vector<TraceLine>&& lines);
    /// After the last.
    [[nodiscard]] std::vector<PackedLine> finish();

  private:
    /// A line that waits until the squares around what lies beside its contours are known.
    struct Waiting {
        std::int32_t row = 0;
        std::size_t line = 0;  ///< place
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
    std::int32_t next_row_;  ///< of cells or points
    std::deque<Waiting> waiting_;
    std::deque<Runs> footprints_;  ///< runs of level 1 in the newest rows of squares, the newest last
    std::vector<PackedLine> lines_;
    std::vector<std::uint8_t> wanted_;  ///< what is kept of what lies outside, a byte a column that is seen
    std::int64_t taken_ = 0;            ///< contours
};

}  // namespace d2b
