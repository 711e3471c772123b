#pragma once

#include <memory>

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

/// Traces and filters the contours of all levels, in one pass over the DEM.
/// @param metres in one vertical unit
/// @throws InputError, Cancelled, and what the spool throws
[[nodiscard]] std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                                             const TierImage& image, const RunPlan& plan,
                                                             const SquareArea& area, double metres,
                                                             Context& context);

}  // namespace d2b
