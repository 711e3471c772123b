#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "contours/split_into_runs.hpp"
#include "contours/sweep_line.hpp"

namespace d2b::contours {

/// Lines of a band, linked as far as possible without the lines above it.
struct LinkedBand {
    std::vector<TraceLine> first;  ///< linked once the lines above are; the last one is also linked to `open`
    std::optional<OpenBand> open;  ///< nullopt if there are too few lines
    std::vector<std::vector<double>> outside;  ///< outside elevations of the last lines
};

/// Collapsed contouring (Chittineni 2003, 4.2) of all levels in one pass over the lines that
/// split_into_runs() produces from bands of rows. At each level, the region is the union of qualifying unit
/// squares (-trace points) or cells (-trace cells); squares that share an edge belong to one contour. The
/// state consists of the row of runs above, outside elevations of two rows, and the open outlines and
/// components, so memory depends only on the contours that are still open:
///
///     Tracer tracer(frame, mode, sink);
///     for (each band, top down)
///         tracer.trace(split_into_runs(frame, mode, rows_before, band));
///
/// Only trace() and join() depend on the order of bands. Use split_into_runs() and link() on other threads
/// for the expensive part of the work.
class Tracer {
  public:
    Tracer(const TraceFrame& frame, TraceMode mode, ContourSink& sink);

    /// Traces the next lines, which must be contiguous. After the last line, all contours have been handed
    /// out.
    void trace(std::vector<TraceLine>&& lines);

    /// Links a band of lines independently; thread-safe.
    /// @param sink receives the contours inside the band
    [[nodiscard]] static LinkedBand link(const TraceFrame& frame, TraceMode mode,
                                         std::vector<TraceLine>&& lines, ContourSink& sink);
    /// Appends a linked band instead of tracing its lines; hands out the same contours.
    /// @param first_name name of the first contour inside the band, which this tracer's sink has already
    /// received
    void join(LinkedBand&& band, std::int64_t first_name);

  private:
    void push_outside(std::vector<double>&& outside);
    void link(const TraceLine& line);
    void add_points(const TraceLine& line);
    void add_roof(const TraceLine& line, const PointRun& share, ElevationSample& sample) const;

    bool points_;
    ElevationRange range_;
    ContourSink& sink_;
    SweepLine sweep_line_;
    std::array<std::vector<double>, 3> outside_;  ///< latest rows of points, newest first
};

}  // namespace d2b::contours
