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
    [[nodiscard]] std::vector<TileLine> finish();

  private:
    struct Sum {
        LatticePoint first;  ///< square of what the tile has seen of the contour
        ContourSum sum;
    };
    /// A row of elevations beside contours that waits until the squares around it are known.
    struct Beside {
        std::int32_t row = 0;
        std::size_t line = 0;  ///< that it belongs to
        std::vector<double> outside;
    };
    using Runs = std::vector<Run>;

    std::int64_t take(FinishedContour&& finished) override;
    void add(TraceLine&& line);
    void keep_beside(const Beside& beside, bool all);
    void place(Sum&& sum);

    TraceFrame frame_;
    Window seen_;
    Window own_;
    Tracer tracer_;
    std::int32_t next_row_;  ///< of cells or points
    std::deque<Beside> beside_;
    std::deque<Runs> footprints_;  ///< runs of level 1 in the newest rows of squares, the newest last
    std::vector<TileLine> lines_;
    std::vector<Sum> sums_;
    std::int64_t taken_ = 0;  ///< contours
};

}  // namespace d2b
