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

/// What of a DEM belongs to which level.
struct TierImage {
    const LevelPlan& plan;
    const FoundBuildings* found;  ///< what the labels belong to; null: all points bear one label
    const CleanRows* clean;  ///< elevations that stand for those of the buildings' points; null: their own
};

/// How bands are taken apart.
struct BandTracing {
    const TraceFrame& frame;
    const TierImage& image;
    TraceMode mode;
    ColSpan summed = {};  ///< see take_apart()
};
using UseLines = std::function<void(const BandShape& band, std::vector<TraceLine>&& lines)>;

/// Takes all bands apart, on all threads, and hands the lines to `use` in their order, on this one.
/// @throws InputError, and what `use` throws
void take_bands_apart(ElevationReader& reader, const BandTracing& tracing, const UseLines& use);

/// Where contours wait. @param found null: all points bear one label @param metres in one vertical unit
[[nodiscard]] ContourStore contour_store(const TraceFrame& frame, const FoundBuildings* found,
                                         const RunPlan& plan, const SquareArea& area, double metres,
                                         Context& context);

/// A band of which is known what can be known without those above it.
struct TracedBand {
    PiledContours contours;  ///< that lie in it
    LinkedBand linked;
};
/// On any thread. @param lines of the band @param tally counts what is dropped
[[nodiscard]] TracedBand trace_band(const TraceFrame& frame, TraceMode mode, std::vector<TraceLine>&& lines,
                                    const ContourStore& store, Tally& tally);
/// From the first row to the last. @param tracer whose sink is the store
void join_band(TracedBand&& band, Tracer& tracer, ContourStore& store);

/// Traces and filters the contours of all levels, in one pass over the DEM.
/// @param metres in one vertical unit
/// @throws InputError, Cancelled, and what the spool throws
[[nodiscard]] std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                                             const TierImage& image, const RunPlan& plan,
                                                             const SquareArea& area, double metres,
                                                             Context& context);

}  // namespace d2b
