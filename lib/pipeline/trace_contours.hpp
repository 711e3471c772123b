#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "elevations/elevation_reader.hpp"
#include "filter/contour_store.hpp"
#include "levels/clean_rows.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"
#include "trace/tracer.hpp"

namespace d2b {

/// Level of each point of a DEM.
struct TierImage {
    const LevelPlan& plan;
    const FoundBuildings* found;  ///< buildings that the labels refer to; null if all points bear one label
    const CleanRows* clean;       ///< simplified elevations of the buildings' points; null to use their own
};

/// Parameters for splitting bands into runs.
struct BandTracing {
    const TraceFrame& frame;
    const TierImage& image;
    TraceMode mode;
    ColSpan summed = {};  ///< see take_apart()
};
using UseLines = std::function<void(const BandShape& band, std::vector<TraceLine>&& lines)>;

/// Splits all bands into runs on all threads and passes the lines to `use` in order, on the calling thread.
/// @throws InputError, and any exception of `use`
void take_bands_apart(ElevationReader& reader, const BandTracing& tracing, const UseLines& use);

/// Creates the store of finished contours. @param found null if all points bear one label @param metres per
/// vertical unit
[[nodiscard]] ContourStore contour_store(const TraceFrame& frame, const FoundBuildings* found,
                                         const RunPlan& plan, const SquareArea& area, double metres,
                                         Context& context);

/// Band traced as far as possible without the bands above it.
struct TracedBand {
    PiledContours contours;  ///< contours that lie entirely in the band
    LinkedBand linked;
};
/// Thread-safe. @param lines of the band @param tally counts dropped contours
[[nodiscard]] TracedBand trace_band(const TraceFrame& frame, TraceMode mode, std::vector<TraceLine>&& lines,
                                    const ContourStore& store, Tally& tally);
/// Joins bands in order, from the first row to the last. @param tracer its sink is the store
void join_band(TracedBand&& band, Tracer& tracer, ContourStore& store);

/// Traces and filters the contours of all levels in one pass over the DEM.
/// @param metres per vertical unit
/// @throws InputError, Cancelled, and spool errors
[[nodiscard]] std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                                             const TierImage& image, const RunPlan& plan,
                                                             const SquareArea& area, double metres,
                                                             Context& context);

}  // namespace d2b
