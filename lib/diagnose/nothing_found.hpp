#pragma once

#include <optional>
#include <string>

#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/ground_slope.hpp"
#include "diagnose/side_doubt.hpp"
#include "diagnose/valid_islands.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Facts about a completed search for buildings.
struct Search {
    const DemInfo& dem;
    const RunPlan& plan;
    const Tally& tally;  ///< counts of rejected objects
    const GroundFit& fit;
    SidesKnown sides;
    CellSize cell;
    bool has_crs = true;
    GroundSlope slope = {};
    std::optional<ParcelReport> parcels = {};
    std::optional<SamplingReport> sampling = {};
    ValidIslands islands = {};
    double terrain_outside = 0;  ///< share of the window
};

/// Returns the reason why the ground of a search cannot be right: only buildings have elevations, or see
/// ground_doubt(). A clause without a full stop; "" if the ground is plausible.
[[nodiscard]] std::string search_ground_doubt(const Search& search);

/// Returns the most probable reason why no building was found, and possible remedies. A clause without a full
/// stop.
[[nodiscard]] std::string why_nothing_was_found(const Search& search);

}  // namespace d2b
