#pragma once

#include <optional>

#include "core/context.hpp"
#include "core/point_stats.hpp"
#include "elevations/elevation_reader.hpp"
#include "levels/clean_rows.hpp"
#include "levels/level_plan.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Levels of the buildings' points.
struct Tiers {
    LevelPlan plan;
    std::optional<CleanRows> clean;  ///< simplified elevations of the points; empty if detail is 0
};

/// Derives the levels of each building from its elevations, simplified first if detail is asked for.
/// @param found in the reader's window, which may be a part of the run's @param fixed covers all elevations
/// of the run
/// @param global levels of the whole DEM @throws OptionError, InputError, OutputError, Cancelled
[[nodiscard]] Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                               const RunSetup& setup, const FixedPoint& fixed, const LevelPlan& global,
                               Context& context);

}  // namespace d2b
