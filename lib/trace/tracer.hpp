#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "trace/sweep_line.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// The lines of a band, linked as far as can be without those above it.
struct LinkedBand {
    std::vector<TraceLine> first;  ///< that are linked when those above are; the last also to what is open
    std::optional<OpenBand> open;  ///< none: there are too few lines
    std::vector<std::vector<double>> outside;  ///< of the last of the others
};

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

    /// Links a band of lines by itself, on any thread.
    /// @param sink gets the contours that lie in the band
    [[nodiscard]] static LinkedBand link(const TraceFrame& frame, TraceMode mode,
                                         std::vector<TraceLine>&& lines, ContourSink& sink);
    /// The next band, in the place of trace() of its lines: the same contours are handed out.
    /// @param first_name what the sink of this calls the first contour that lies in the band; it has got
    /// those before
    void join(LinkedBand&& band, std::int64_t first_name);

  private:
    void pass(std::vector<double>&& outside);
    void link(const TraceLine& line);
    void add(TraceLine& line);
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
