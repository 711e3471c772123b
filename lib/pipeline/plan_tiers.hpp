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

/// What of the buildings' points belongs to which level.
struct Tiers {
    LevelPlan plan;
    std::optional<CleanRows> clean;  ///< elevations that stand for those of the points, where there are such
};

/// The levels of each building from the elevations in it, cleaned where that is asked for.
/// @param found in the reader's window, which need not be the run's @param fixed of all elevations of the run
/// @param global levels of the whole DEM @throws OptionError, InputError, OutputError, Cancelled
[[nodiscard]] Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                               const RunSetup& setup, const FixedPoint& fixed, const LevelPlan& global,
                               Context& context);

}  // namespace d2b
