#pragma once

#include <memory>

#include "core/options.hpp"
#include "pipeline/contour_store.hpp"
#include "pipeline/elevation_reader.hpp"
#include "pipeline/find_buildings.hpp"
#include "trace/tracer.hpp"

namespace d2b {

/// Traces and filters the contours of all levels, in one pass over the DEM.
/// @param found what the labels belong to; null: all points bear one label
/// @throws InputError, Cancelled, and what the spool throws
[[nodiscard]] std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                                             const LevelPlan& plan,
                                                             const FoundBuildings* found,
                                                             const Options& options, const SquareArea& area,
                                                             Context& context);

}  // namespace d2b
