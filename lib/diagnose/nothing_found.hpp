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

/// What is known of a search for buildings when it is over.
struct Search {
    const DemInfo& dem;
    const RunPlan& plan;
    const Tally& tally;  ///< of what was left out
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

/// Why the ground of a search cannot be right: what has elevations is buildings alone, or see ground_doubt().
/// Without a full stop; "" where it may be right.
[[nodiscard]] std::string search_ground_doubt(const Search& search);

/// What is most probably the reason why no building was found, and what may help. Without a full stop.
[[nodiscard]] std::string why_nothing_was_found(const Search& search);

}  // namespace d2b
