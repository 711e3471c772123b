#pragma once

#include <memory>
#include <optional>

#include "contours/clean_tiers.hpp"
#include "contours/contour_archive.hpp"
#include "contours/level_plan.hpp"
#include "contours/tracer.hpp"
#include "core/context.hpp"
#include "core/statistics.hpp"
#include "elevations/elevation_reader.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b::pipeline {

/// Levels of the buildings' points.
struct Tiers {
    contours::LevelPlan plan;
    std::optional<contours::CleanRows> clean;  ///< simplified elevations of the points; empty if detail is 0
};

/// Derives the levels of each building from its elevations, simplified first if detail is asked for.
/// @param found in the reader's window, which may be a part of the run's @param fixed covers all elevations
/// of the run
/// @param global levels of the whole DEM @throws OptionError, InputError, OutputError, Cancelled
[[nodiscard]] Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                               const features::RunSetup& setup, const FixedPoint& fixed,
                               const contours::LevelPlan& global, Context& context);

/// Traces and filters the contours of all levels in one pass over the DEM.
/// @param found buildings that the tiers refer to; null if all points bear one label
/// @throws InputError, Cancelled, and spool errors
[[nodiscard]] std::unique_ptr<contours::StoredContours> trace_contours(
    ElevationReader& reader, const contours::TraceFrame& frame, const Tiers& tiers,
    const FoundBuildings* found, const features::RunSetup& setup, Context& context);

}  // namespace d2b::pipeline
