#pragma once

#include <array>
#include <vector>

#include "trace/sweep_line.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// Collapsed contouring (Chittineni 2003, 4.2) of all levels in one pass over the lines that take_apart()
/// makes of bands of rows. At each level the region is the union of the unit squares (-trace points) or cells
/// (-trace cells) that qualify; squares that share an edge belong to one contour. Carried from line to line:
/// the row of runs above, what lies beside outlines two rows above, open outlines and components.
class Tracer {
  public:
    /// @param outlines none: contours are handed out without rings, and `outside` of lines counts for nothing
    Tracer(const TraceFrame& frame, TraceMode mode, ContourSink& sink, Outlines outlines = Outlines::traced);

    /// The next lines, without gap or overlap. After the last all contours have been handed out.
    /// @throws BrokenRecord where a sum is of no contour
    void trace(std::vector<TraceLine>&& lines);

  private:
    void add_points(const TraceLine& line);
    void add_sums(TraceLine& line);
    void add_roof(const TraceLine& line, const PointShare& share, ElevationSample& sample) const;

    bool points_;
    ElevationRange range_;
    ContourSink& sink_;
    SweepLine sweep_line_;
    std::array<std::vector<double>, 3> outside_;  ///< of the newest rows of points, the newest first
};

}  // namespace d2b
